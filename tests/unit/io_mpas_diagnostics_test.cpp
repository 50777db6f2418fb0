// SPDX-License-Identifier: BSD-3-Clause
#include "io/mpas_diagnostics.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/hash.hpp"
#include "support/sample_grids.hpp"
#include "triangulation/delaunay.hpp"

namespace {

constexpr std::uint64_t kSeed = 20;

/// Points without order, so that many triangles are obtuse.
delos::Grid scattered_grid() {
  constexpr std::uint64_t kPoints = 500;
  std::vector<delos::Vec3> points;
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    const double z = 2.0 * delos::uniform01(kSeed, i, 0) - 1.0;
    const double lon_rad = 2.0 * delos::kPi * delos::uniform01(kSeed, i, 1);
    const double r = std::sqrt(1.0 - z * z);
    points.emplace_back(r * std::cos(lon_rad), r * std::sin(lon_rad), z);
  }
  delos::parallel::Executor exec(1);
  return delos::samples::grid_of(delos::Ellipsoid(), delos::delaunay(exec, points));
}

/// By the law of cosines, ascending.
std::array<double, 3> angles_rad(const delos::Grid& grid, std::int64_t vertex) {
  std::array<double, 3> side{}, angle{};
  const auto& cells = grid.cells_on_vertex[delos::at(vertex)];
  for (std::size_t k = 0; k < 3; ++k) {
    side[k] = (grid.cell_position[delos::at(cells[(k + 1) % 3])] -
               grid.cell_position[delos::at(cells[(k + 2) % 3])])
                  .norm();
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = side[k], b = side[(k + 1) % 3], c = side[(k + 2) % 3];
    angle[k] = std::acos((b * b + c * c - a * a) / (2.0 * b * c));
  }
  std::sort(angle.begin(), angle.end());
  return angle;
}

}  // namespace

TEST_CASE(
    "a triangle's quality by angles is the smallest over the largest, above 90 degrees obtuse") {
  CAPTURE(kSeed);
  const delos::Grid grid = scattered_grid();
  std::int64_t n_obtuse = 0;
  for (std::int64_t vertex = 0; vertex < grid.n_vertices(); ++vertex) {
    const auto angle = angles_rad(grid, vertex);
    CHECK(delos::mpas::triangle_angle_quality(grid, vertex) ==
          doctest::Approx(angle.front() / angle.back()).epsilon(1e-9));
    CHECK(delos::mpas::is_obtuse(grid, vertex) == (angle.back() > 0.5 * delos::kPi));
    n_obtuse += delos::mpas::is_obtuse(grid, vertex) ? 1 : 0;
  }
  CHECK(n_obtuse > 0);
  CHECK(n_obtuse < grid.n_vertices());
}

TEST_CASE("a triangle without a corner has no quality by angles and is not obtuse") {
  delos::Grid grid = scattered_grid();
  grid.cells_on_vertex[0][1] = delos::kNone;
  CHECK(delos::mpas::triangle_angle_quality(grid, 0) == 0.0);
  CHECK_FALSE(delos::mpas::is_obtuse(grid, 0));
}
