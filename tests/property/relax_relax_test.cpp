// SPDX-License-Identifier: BSD-3-Clause
#include "relax/relax.hpp"

#include <doctest/doctest.h>

#include "metrics/quality.hpp"
#include "refine/refine.hpp"
#include "support/sample_spacings.hpp"
#include "triangulation/validate.hpp"

using namespace delos;

namespace {

Mesh relaxed(Context& context, const SampleSpacing& sample, RelaxReport& report,
             const RelaxOptions& options = {}) {
  RefineReport refine_report;
  Mesh mesh = refine(context, sample.surface, sample.spacing, {}, refine_report);
  report = relax(context, sample.surface, sample.spacing, options, mesh);
  return mesh;
}

}  // namespace

TEST_CASE("relaxed meshes are sound and Delaunay, and no triangle is obtuse where h is smooth") {
  for (const auto& sample : sample_spacings()) {
    CAPTURE(sample.name);
    TestRun run(2);
    RelaxReport report;
    const Mesh mesh = relaxed(run.context, sample, report);
    CHECK(summary(validate(mesh, sample.surface)) == "");
    const Quality quality = measure_quality(run.context, sample.surface, sample.spacing, mesh);
    CHECK(quality.euler == 2);
    CHECK(quality.n_non_delaunay == 0);
    if (sample.is_smooth) {
      CHECK(quality.n_obtuse == 0);
      CHECK(report.n_below_target <= 1);  // near the target not all means are tried
      CHECK(quality.area_length_min.value >= 0.93);
      CHECK(quality.relative_edge_min.value >= 0.65);
      CHECK(quality.dual_ratio_min.value > 0.0);
    }
  }
}

TEST_CASE("a crowd of eddies that few triangles can follow leaves none obtuse") {
  // 250 of them, 3 degrees wide, from 240 down to 40 km: slopes of a third everywhere.
  const Ellipsoid sphere = Ellipsoid::sphere(6371220.0);
  std::vector<Vec3> eddies;
  for (std::uint64_t i = 0; i < 250; ++i) {
    const double lon = 360.0 * kRadPerDeg * uniform01(11, 2 * i);
    const double z = 2.0 * uniform01(11, 2 * i + 1) - 1.0, r = std::sqrt(1.0 - z * z);
    eddies.emplace_back(r * std::cos(lon), r * std::sin(lon), z);
  }
  const double width2 = std::pow(3.0 * kRadPerDeg, 2);
  const auto spacing_m = [&](double lon_deg, double lat_deg, Index, Index) {
    const double lon = lon_deg * kRadPerDeg, lat = lat_deg * kRadPerDeg;
    const Vec3 x(std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat));
    double strongest = 0.0;
    for (const Vec3& eddy : eddies) {
      strongest = std::max(strongest, std::exp(-(x - eddy).squaredNorm() / (2.0 * width2)));
    }
    return 1e3 * (240.0 - 200.0 * strongest);
  };
  const SampleSpacing sample{"eddies", sphere, sample_table(sphere, spacing_m), false};
  TestRun run(2);
  RelaxReport report;
  const Mesh mesh = relaxed(run.context, sample, report);
  CHECK(summary(validate(mesh, sphere)) == "");
  const Quality quality = measure_quality(run.context, sphere, sample.spacing, mesh);
  CHECK(report.n_below_target > 0);  // the spacing is not kept everywhere
  CHECK(quality.n_obtuse == 0);
  CHECK(quality.area_length_min.value >= 0.88);
}

TEST_CASE("centroidal meshes are sound and Delaunay, and none is obtuse where h is smooth") {
  RelaxOptions options;
  options.centroidal_rounds = 20;
  for (const auto& sample : sample_spacings()) {
    CAPTURE(sample.name);
    TestRun run(2);
    RelaxReport report;
    const Mesh mesh = relaxed(run.context, sample, report, options);
    CHECK(report.centroidal_rounds == 20);
    CHECK(summary(validate(mesh, sample.surface)) == "");
    if (!sample.is_smooth) continue;
    const Quality quality = measure_quality(run.context, sample.surface, sample.spacing, mesh);
    CHECK(quality.n_obtuse == 0);
    CHECK(quality.relative_edge_min.value >= 0.65);
  }
}

TEST_CASE("1, 2, 5 and 8 threads make the same bits of a centroidal mesh") {
  RelaxOptions options;
  options.centroidal_rounds = 10;
  check_same_bits_for_any_threads(sample_spacings(), [&](Context& context, const auto& sample) {
    RelaxReport report;
    return digest(relaxed(context, sample, report, options));
  });
}

TEST_CASE("1, 2, 5 and 8 threads relax to the same bits") {
  check_same_bits_for_any_threads(sample_spacings(), [](Context& context, const auto& sample) {
    RelaxReport report;
    return digest(relaxed(context, sample, report));
  });
}

TEST_CASE("relaxation raises the mean quality of a refined mesh") {
  const Ellipsoid sphere;
  const SpacingField spacing = SpacingField::constant(sphere, 0.03);
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  RefineReport refine_report;
  Mesh mesh = refine(context, sphere, spacing, {}, refine_report);
  const Quality before = measure_quality(context, sphere, spacing, mesh);
  const RelaxReport report = relax(context, sphere, spacing, {}, mesh);
  const Quality after = measure_quality(context, sphere, spacing, mesh);
  CHECK(report.spring_rounds > 0);
  CHECK(after.area_length_mean > before.area_length_mean);
  CHECK(after.relative_edge_std < before.relative_edge_std);
}
