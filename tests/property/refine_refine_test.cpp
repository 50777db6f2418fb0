// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refine.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/sample_spacings.hpp"
#include "triangulation/validate.hpp"

using namespace delos;

TEST_CASE("refined meshes are sound, Delaunay, meet both bounds and the expected count") {
  for (const auto& sample : sample_spacings()) {
    CAPTURE(sample.name);
    TestRun run(2);
    RefineReport report;
    const Mesh mesh = refine(run.context, sample.surface, sample.spacing, {}, report);
    CHECK(summary(validate(mesh, sample.surface)) == "");
    CHECK(report.n_over_size == 0);
    CHECK(report.n_over_radius_edge == 0);
    CHECK(report.n_skeleton_vertices + report.n_inserted == mesh.n_vertices());
    // Within 3 % of the integral of 2 / (sqrt 3 h^2).
    const double expected = expected_vertices(run.exec, sample.surface, sample.spacing);
    if (sample.is_smooth) CHECK(mesh.n_vertices() == doctest::Approx(expected).epsilon(0.03));
  }
}

TEST_CASE("1, 2, 5 and 8 threads refine to the same bits") {
  check_same_bits_for_any_threads(sample_spacings(), [](Context& context, const auto& sample) {
    RefineReport report;
    return digest(refine(context, sample.surface, sample.spacing, {}, report));
  });
}

TEST_CASE("tighter bounds are met as well") {
  const Ellipsoid sphere;
  const SpacingField spacing = SpacingField::constant(sphere, 0.08);
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  RefineReport report;
  RefineOptions options;
  options.radius_edge = 1.0;
  options.size_ratio = 1.1;
  const Mesh mesh = refine(context, sphere, spacing, options, report);
  CHECK(report.n_over_size == 0);
  CHECK(report.n_over_radius_edge == 0);
  CHECK(summary(validate(mesh, sphere)) == "");
}

TEST_CASE("a request to stop ends refinement with an error of its own kind") {
  const Ellipsoid sphere;
  const std::atomic<bool> cancel{true};
  parallel::Executor exec(2);
  Monitor monitor(nullptr, nullptr, &cancel);
  Context context{exec, monitor};
  RefineReport report;
  try {
    refine(context, sphere, SpacingField::constant(sphere, 0.05), {}, report);
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::cancelled);
  }
}
