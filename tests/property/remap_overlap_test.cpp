// SPDX-License-Identifier: BSD-3-Clause
#include "remap/overlap.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "remap/weights.hpp"
#include "support/sample_fields.hpp"

using namespace delos;

namespace {

const std::vector<Ellipsoid> kSurfaces{Ellipsoid::sphere(6371220.0), Ellipsoid::wgs84(),
                                       Ellipsoid(Vec3(1.2, 1.0, 0.8) * 6e6, Vec3(10, 20, 30))};

struct Sums {
  double worst_source = 0.0, worst_target = 0.0;
};

// Largest relative misfit of the sums over rows and columns.
Sums misfit(const remap::Overlaps& overlaps) {
  std::vector<double> of_source(at(overlaps.n_sources), 0.0);
  Sums sums;
  for (std::int64_t i = 0; i < overlaps.n_targets; ++i) {
    double of_target = 0.0;
    for (auto k = overlaps.offsets[at(i)]; k < overlaps.offsets[at(i) + 1]; ++k) {
      of_target += overlaps.area_m2[at(k)];
      of_source[at(overlaps.source[at(k)])] += overlaps.area_m2[at(k)];
    }
    sums.worst_target =
        std::max(sums.worst_target, std::abs(of_target / overlaps.target_area_m2[at(i)] - 1.0));
  }
  for (std::size_t j = 0; j < of_source.size(); ++j) {
    sums.worst_source =
        std::max(sums.worst_source, std::abs(of_source[j] / overlaps.source_area_m2[j] - 1.0));
  }
  return sums;
}

void check_transfer(const Grid& source, const Grid& target) {
  const remap::Overlaps overlaps = samples::overlaps_of(source, target);
  CAPTURE(overlaps.size());
  CHECK(overlaps.largest_gap < 1e-9);
  const Sums sums = misfit(overlaps);
  CHECK(sums.worst_source < 1e-14);
  CHECK(sums.worst_target < 1e-14);
  parallel::Executor exec(2);
  const remap::Weights weights = remap::first_order_weights(exec, overlaps);
  std::vector<double> result(target.cell_area_m2.size());
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CAPTURE(seed);
    const auto field = samples::rough_field(source.n_cells(), seed);
    remap::apply(exec, weights, field, result);
    const double before = samples::mass(field, source.cell_area_m2);
    const double after = samples::mass(result, target.cell_area_m2);
    CHECK(std::abs(after / before - 1.0) < 1e-14);
  }
  const std::vector<double> constant(source.cell_area_m2.size(), 0.1);
  remap::apply(exec, weights, constant, result);
  CHECK(std::all_of(result.begin(), result.end(), [](double value) { return value == 0.1; }));
}

}  // namespace

TEST_CASE("transfer between turned grids keeps mass and constants on every surface") {
  for (const Ellipsoid& surface : kSurfaces) {
    CAPTURE(surface.radii().transpose());
    const Mesh mesh = samples::make_delaunay(samples::bisected_icosahedron(surface, 4));
    const Grid a = samples::grid_of(surface, mesh);
    const Grid b = samples::grid_of(
        surface, samples::turned(surface, samples::bisected_icosahedron(surface, 3)));
    check_transfer(a, b);
    check_transfer(b, a);
  }
}

TEST_CASE("transfer keeps mass and constants between grids with obtuse triangles") {
  for (const Ellipsoid& surface : kSurfaces) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      CAPTURE(surface.radii().transpose());
      CAPTURE(seed);
      check_transfer(samples::grid_of(surface, samples::shaken(surface, 4, 0.2, seed)),
                     samples::grid_of(surface, samples::shaken(surface, 4, 0.2, seed + 10)));
    }
  }
}

TEST_CASE("overlaps have the same bits for any number of threads") {
  const Ellipsoid surface = Ellipsoid::wgs84();
  const Grid a = samples::grid_of(surface, samples::bisected_icosahedron(surface, 4));
  const Grid b = samples::grid_of(surface, samples::shaken(surface, 4, 0.2, 1));
  const remap::Overlaps one = samples::overlaps_of(a, b, 1);
  for (const int threads : {2, 5, 8}) {
    const remap::Overlaps many = samples::overlaps_of(a, b, threads);
    CHECK(many.offsets == one.offsets);
    CHECK(many.source == one.source);
    CHECK(many.area_m2 == one.area_m2);
    CHECK(many.middle == one.middle);
    CHECK(many.source_middle == one.source_middle);
  }
}

TEST_CASE("a fold in a grid costs its own area, nothing more") {
  // Shaken so far that the mesh is Delaunay by its angles, but not by its balls.
  const Ellipsoid surface(Vec3(1.2, 1.0, 0.8), Vec3::Zero());
  const Grid a = samples::grid_of(surface, samples::shaken(surface, 4, 0.25, 1));
  const Grid b = samples::grid_of(surface, samples::shaken(surface, 4, 0.25, 11));
  const remap::Overlaps overlaps = samples::overlaps_of(a, b);
  CHECK(overlaps.largest_gap > 1e-10);
  CHECK(overlaps.largest_gap < 1e-6);
  CHECK(misfit(overlaps).worst_source < 1e-9);
  CHECK(misfit(overlaps).worst_target < 1e-14);
}

TEST_CASE("fine cells under coarse ones are all found") {
  const Ellipsoid sphere;
  const Grid coarse = samples::grid_of(sphere, samples::bisected_icosahedron(sphere, 0));
  const Grid fine =
      samples::grid_of(sphere, samples::turned(sphere, samples::bisected_icosahedron(sphere, 5)));
  check_transfer(fine, coarse);
  check_transfer(coarse, fine);
}
