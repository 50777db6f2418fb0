// SPDX-License-Identifier: BSD-3-Clause
#include "remap/gradients.hpp"

#include <doctest/doctest.h>

#include "support/sample_fields.hpp"

using namespace delos;

TEST_CASE("gradients of a linear function are its slope in the tangent plane, to the curvature") {
  const Ellipsoid surface(Vec3(1.0, 0.95, 0.9), Vec3::Zero());
  const Grid a = samples::grid_of(surface, samples::shaken(surface, 4, 0.1, 1));
  const Grid b = samples::grid_of(surface, samples::bisected_icosahedron(surface, 4));
  parallel::Executor exec(1);
  const remap::Overlaps overlaps = samples::overlaps_of(a, b);
  const auto stencils = remap::gradient_stencils(exec, remap::Tiling::cells(exec, a), overlaps);
  const Vec3 slope(0.3, -0.4, 0.5);
  std::vector<double> field(a.cell_area_m2.size());
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = slope.dot(overlaps.source_middle[i]);
  const auto found = remap::gradients(exec, stencils, field);
  double worst = 0.0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const Vec3 up = surface.normal(surface.project(overlaps.source_middle[i]));
    const Vec3 expected = slope - up * up.dot(slope);
    worst = std::max(worst, (found[i] - expected).norm());
  }
  CHECK(worst < 0.15);  // spacing 0.07, planes of the sphere on a flatter body
}

TEST_CASE("the gradient of a constant is nothing to the last bit") {
  const Grid a = samples::grid_of(Ellipsoid(), samples::shaken(Ellipsoid(), 3, 0.2, 1));
  const Grid b = samples::grid_of(Ellipsoid(), samples::bisected_icosahedron(Ellipsoid(), 3));
  parallel::Executor exec(1);
  const auto stencils =
      remap::gradient_stencils(exec, remap::Tiling::cells(exec, a), samples::overlaps_of(a, b));
  const std::vector<double> field(a.cell_area_m2.size(), 0.1);
  for (const Vec3& gradient : remap::gradients(exec, stencils, field)) {
    CHECK(gradient == Vec3(0, 0, 0));
  }
}
