// SPDX-License-Identifier: BSD-3-Clause
#include "dual/edge_angles.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "dual/validate.hpp"
#include "support/sample_grids.hpp"

using namespace delos;

namespace {

constexpr double kTolerance = 1e-6;

/// With the angles that the converter of MPAS-Tools writes.
Grid with_angles_by_latitude(Grid grid) {
  for (std::size_t i = 0; i < grid.edge_angle_rad.size(); ++i) {
    const auto [v, w] = grid.vertices_on_edge[i];
    const double rise_rad = grid.vertex_lon_lat[static_cast<std::size_t>(w)].lat_rad -
                            grid.vertex_lon_lat[static_cast<std::size_t>(v)].lat_rad;
    const double length_rad = grid.vertex_distance_m[i] / grid.surface.scale_m();
    const double angle = std::acos(std::clamp(rise_rad / length_rad, -1.0, 1.0));
    grid.edge_angle_rad[i] = std::sin(grid.edge_angle_rad[i]) < 0.0 ? -angle : angle;
  }
  return grid;
}

}  // namespace

TEST_CASE("angles by rise in latitude are known from those of the normal, and from mistakes") {
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  const Ellipsoid sphere = Ellipsoid::sphere(6371220.0);
  const Grid right = samples::grid_of(sphere, samples::shaken(sphere, 3, 0.1, 5));
  CHECK_FALSE(angles_by_latitude(context, right, kTolerance));

  Grid other = with_angles_by_latitude(right);
  const auto broken = check_grid(context, other);
  REQUIRE(broken.size() == 1);
  CHECK(broken[0].rule == kEdgeAngleRule);
  const auto found = angles_by_latitude(context, other, kTolerance);
  REQUIRE(found);
  // 2 sin(a / 2) of the angle a is what the rule measures.
  CHECK(2.0 * std::sin(0.5 * found->worst_rad) == doctest::Approx(broken[0].worst).epsilon(1e-9));
  const auto worst = static_cast<std::size_t>(found->worst_edge);
  CHECK(std::abs(std::remainder(other.edge_angle_rad[worst] - right.edge_angle_rad[worst],
                                2.0 * kPi)) == doctest::Approx(found->worst_rad).epsilon(1e-9));

  const std::size_t some = 100;
  Grid turned = other;
  turned.edge_angle_rad[some] = -turned.edge_angle_rad[some];
  CHECK_FALSE(angles_by_latitude(context, turned, kTolerance));
  other.edge_angle_rad[some] += 1e-4;
  CHECK_FALSE(angles_by_latitude(context, other, kTolerance));
}

TEST_CASE("angles by rise in latitude are a matter of spheres") {
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  const Ellipsoid earth = Ellipsoid::wgs84();
  const Grid grid = samples::grid_of(earth, samples::bisected_icosahedron(earth, 2));
  CHECK_FALSE(angles_by_latitude(context, with_angles_by_latitude(grid), kTolerance));
}
