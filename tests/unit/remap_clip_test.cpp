// SPDX-License-Identifier: BSD-3-Clause
#include "remap/clip.hpp"

#include <doctest/doctest.h>

#include "support/sample_grids.hpp"

using namespace delos;

namespace {

double sum_of_parts(const Grid& grid, const Grid& other) {
  parallel::Executor exec(1);
  const auto subject = remap::Tiling::cells(exec, grid),
             clipping = remap::Tiling::cells(exec, other);
  remap::Clipper clipper;
  double sum = 0.0;
  for (std::int64_t i = 0; i < subject.size(); ++i) {
    REQUIRE(clipper.begin(subject, i));
    for (std::int64_t j = 0; j < clipping.size(); ++j) {
      const auto corners = clipper.clip(clipping, j);
      if (corners.size() >= 3) sum += clipper.area(grid.surface, corners);
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("a cell clipped by itself keeps its area, its middle is inside") {
  parallel::Executor exec(1);
  const Grid grid = samples::grid_of(Ellipsoid(), samples::shaken(Ellipsoid(), 2, 0.2, 3));
  const auto cells = remap::Tiling::cells(exec, grid);
  remap::Clipper clipper;
  for (std::int64_t i = 0; i < cells.size(); ++i) {
    REQUIRE(clipper.begin(cells, i));
    const auto corners = clipper.clip(cells, i);
    REQUIRE(corners.size() == cells.corners(i).size());
    const double area = clipper.area(grid.surface, corners);
    CHECK(area == doctest::Approx(cells.area_m2()[static_cast<std::size_t>(i)]).epsilon(1e-12));
    const Vec3 middle = clipper.middle(grid.surface, corners);
    for (const Index beside : cells.neighbours(i)) {
      const Vec3 away = grid.cell_position[static_cast<std::size_t>(beside)] - middle;
      CHECK((grid.cell_position[static_cast<std::size_t>(i)] - middle).norm() < away.norm());
    }
    CHECK(middle.norm() == doctest::Approx(1.0).epsilon(1e-15));
  }
}

TEST_CASE("cells that share a side or a corner have no area in common") {
  parallel::Executor exec(1);
  const Grid grid =
      samples::grid_of(Ellipsoid::wgs84(), samples::shaken(Ellipsoid::wgs84(), 2, 0.2, 5));
  const auto cells = remap::Tiling::cells(exec, grid);
  remap::Clipper clipper;
  for (std::int64_t i = 0; i < cells.size(); ++i) {
    REQUIRE(clipper.begin(cells, i));
    for (const Index beside : cells.neighbours(i)) CHECK(clipper.clip(cells, beside).size() < 3);
  }
}

TEST_CASE("the parts of all cells sum to the surface, cells as large as an octant too") {
  for (const Ellipsoid& surface : {Ellipsoid(), Ellipsoid(Vec3(1.0, 0.8, 0.7), Vec3::Zero())}) {
    const Grid cube = samples::grid_of(surface, samples::split_cube(surface));
    const Grid tetrahedron = samples::grid_of(surface, samples::tetrahedron(surface));
    const Grid fine = samples::grid_of(surface, samples::bisected_icosahedron(surface, 2));
    for (const auto* a : {&cube, &tetrahedron, &fine}) {
      for (const auto* b : {&cube, &tetrahedron, &fine}) {
        CAPTURE(a->n_cells());
        CAPTURE(b->n_cells());
        CHECK(sum_of_parts(*a, *b) == doctest::Approx(surface.area()).epsilon(1e-13));
      }
    }
  }
}

TEST_CASE("slivers keep their relative accuracy") {
  parallel::Executor exec(1);
  // Two octants, one turned about the axis through their common corner, overlap in lunes.
  const Ellipsoid sphere;
  Mesh mesh = samples::split_cube(sphere);
  const Grid cube = samples::grid_of(sphere, mesh);
  const double angle = 1e-9;
  for (Vertex& v : mesh.vertices) {
    v = {v.x - angle * v.y, v.y + angle * v.x, v.z, v.spacing};  // good to angle^2
  }
  const Grid turned = samples::grid_of(sphere, mesh);
  remap::Clipper clipper;
  const auto fixed = remap::Tiling::cells(exec, cube), moved = remap::Tiling::cells(exec, turned);
  REQUIRE(clipper.begin(fixed, 0));
  int n_slivers = 0;
  for (std::int64_t j = 1; j < 4; ++j) {
    const auto corners = clipper.clip(moved, j);
    if (corners.size() < 3) continue;
    ++n_slivers;
    // From pole to equator, `angle` wide.
    CHECK(clipper.area(sphere, corners) == doctest::Approx(angle).epsilon(1e-6));
  }
  CHECK(n_slivers == 1);
}
