// SPDX-License-Identifier: BSD-3-Clause
#include "refine/tiles.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "core/error.hpp"
#include "refine/skeleton.hpp"
#include "triangulation/validate.hpp"

using namespace delos;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);
constexpr double kNoLimit = 1e12;

Tiling tiles_at(double spacing_m, double tile_vertices) {
  parallel::Executor exec(1);
  return make_tiles(exec, kEarth, SpacingField::constant(kEarth, spacing_m), tile_vertices,
                    kNoLimit);
}

}  // namespace

TEST_CASE("a coarse spacing keeps the twenty faces of the icosahedron") {
  const Tiling tiling = tiles_at(500e3, 12000.0);
  CHECK(tiling.tiles.size() == 20);
  CHECK(tiling.corners.size() == 12);
}

TEST_CASE("tiles are split until each expects at most the wanted number of vertices") {
  const Tiling tiling = tiles_at(60e3, 1000.0);
  double total = 0.0;
  for (const Tile& tile : tiling.tiles) {
    CHECK(tile.expected_vertices <= 1000.0);
    total += tile.expected_vertices;
  }
  const double integral = 2.0 / std::sqrt(3.0) / (60.0 * 60.0) * 4.0 * kPi * 6371.22 * 6371.22;
  CHECK(total == doctest::Approx(integral).epsilon(0.002));
}

TEST_CASE("an absurd spacing is refused before anything is split") {
  parallel::Executor exec(1);
  try {
    make_tiles(exec, kEarth, SpacingField::constant(kEarth, 1.0), 12000.0, 7e8);
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::resource);
    CHECK(std::string(error.what()).find("coarser") != std::string::npos);
  }
}

TEST_CASE("a fine patch inside a large face is seen and split") {
  LatLonField field{360, 720, {}};
  field.values.assign(361 * 720, 500e3);
  // 3 by 3 degrees of 10 km near the middle of a face.
  for (Index j = 220; j < 226; ++j) {
    for (Index i = 100; i < 106; ++i) field.values[field.at(j, i)] = 10e3;
  }
  parallel::Executor exec(1);
  const Tiling tiling = make_tiles(
      exec, kEarth, SpacingField::table(kEarth, LatitudeKind::geodetic, field), 500.0, kNoLimit);
  CHECK(tiling.tiles.size() > 20);
}

TEST_CASE("the skeleton is a sound Delaunay mesh that holds every side as edges") {
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  const SpacingField spacing = SpacingField::constant(kEarth, 120e3);
  const Tiling tiling = make_tiles(exec, kEarth, spacing, 600.0, kNoLimit);
  const Skeleton skeleton = make_skeleton(context, kEarth, spacing, {tiling, {}});
  CHECK(summary(validate(skeleton.mesh, kEarth)) == "");
  // Every half-segment lies on the border of exactly one tile, every triangle in exactly one tile.
  std::vector<int> n_borders(2 * skeleton.segments.size(), 0);
  std::vector<int> n_tiles(skeleton.mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < tiling.tiles.size(); ++t) {
    for (const Index half : skeleton.tile_half_segments[t])
      ++n_borders[static_cast<std::size_t>(half)];
    for (const Index tri : skeleton.tile_triangles[t]) ++n_tiles[static_cast<std::size_t>(tri)];
  }
  CHECK(std::count(n_borders.begin(), n_borders.end(), 1) ==
        static_cast<std::ptrdiff_t>(n_borders.size()));
  CHECK(std::count(n_tiles.begin(), n_tiles.end(), 1) ==
        static_cast<std::ptrdiff_t>(n_tiles.size()));
}
