// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/remesh.hpp"

#include <doctest/doctest.h>

#include <cstring>

#include "metrics/quality.hpp"
#include "refine/refine.hpp"
#include "support/sample_spacings.hpp"
#include "triangulation/validate.hpp"

using namespace delos;

namespace {

/// A fine disc at (lon, lat) in a coarse sea, three degrees of transition.
SpacingField disc(const Ellipsoid& surface, double lon_deg, double lat_deg) {
  const auto direction = [](double lon, double lat) {
    const double a = lon * kRadPerDeg, b = lat * kRadPerDeg;
    return Vec3(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b));
  };
  const Vec3 centre = direction(lon_deg, lat_deg);
  return sample_table(surface, [&](double lon, double lat, Index, Index) {
    const double angle_deg = std::acos(std::min(1.0, centre.dot(direction(lon, lat)))) * kDegPerRad;
    return 1e3 * std::clamp(120.0 + 12.0 * (angle_deg - 12.0), 120.0, 300.0);
  });
}

struct Scene {
  std::string name;
  Ellipsoid surface;
  SpacingField before, after;
};

std::vector<Scene> scenes() {
  const Ellipsoid earth = Ellipsoid::sphere(6371220.0), wgs84 = Ellipsoid::wgs84();
  const Ellipsoid triaxial(Vec3(1.2, 1.0, 0.8) * 6371220.0, Vec3(1e6, -2e6, 3e6));
  const Ellipsoid flat(Vec3(1.0, 0.7, 0.4) * 6371220.0, Vec3(0, 0, 0));
  return {
      {"by half its width on the sphere", earth, disc(earth, 0.0, 20.0), disc(earth, 12.0, 20.0)},
      {"across the date line, WGS84", wgs84, disc(wgs84, 176.0, -40.0), disc(wgs84, -172.0, -40.0)},
      {"across the pole", earth, disc(earth, 30.0, 84.0), disc(earth, 210.0, 84.0)},
      {"triaxial", triaxial, disc(triaxial, 80.0, 10.0), disc(triaxial, 80.0, 25.0)},
      {"flat", flat, disc(flat, 80.0, 10.0), disc(flat, 80.0, 25.0)}};
}

Mesh fresh(Context& context, const Ellipsoid& surface, const SpacingField& spacing) {
  RefineReport report;
  Mesh mesh = refine(context, surface, spacing, {}, report);
  relax(context, surface, spacing, {}, mesh);
  return mesh;
}

/// Kept vertices have the same bits, in the same order.
void check_kept(const Mesh& before, const Remeshed& after, const RemeshReport& report) {
  std::int64_t n_kept = 0;
  Index last = kNone;
  REQUIRE(after.new_id.size() == before.vertices.size());
  for (std::size_t v = 0; v < after.new_id.size(); ++v) {
    const Index id = after.new_id[v];
    if (id == kNone) continue;
    ++n_kept;
    REQUIRE(id > last);
    last = id;
    REQUIRE(std::memcmp(&before.vertices[v], &after.mesh.vertices[static_cast<std::size_t>(id)],
                        sizeof(Vertex)) == 0);
  }
  CHECK(n_kept == report.n_kept);
}

}  // namespace

TEST_CASE("a remesh is as good as a fresh grid and keeps what lies outside bit for bit") {
  for (const Scene& scene : scenes()) {
    CAPTURE(scene.name);
    TestRun run(2);
    const Mesh before = fresh(run.context, scene.surface, scene.before);
    RemeshReport report;
    const Remeshed after =
        remesh(run.context, {scene.surface, scene.after, before, {}}, {}, report);
    CHECK(report.kind == RemeshKind::local);
    CHECK(summary(validate(after.mesh, scene.surface)) == "");
    check_kept(before, after, report);
    CHECK(report.n_kept > before.n_vertices() / 2);
    const Quality quality = measure_quality(run.context, scene.surface, scene.after, after.mesh);
    MESSAGE(scene.name << " n " << before.n_vertices() << " -> " << after.mesh.n_vertices()
                       << " kept " << report.n_kept << " regions " << report.n_regions
                       << " releases " << report.release_rounds << " below "
                       << report.relax.n_below_target << " amin " << quality.area_length_min.value
                       << " mean " << quality.area_length_mean << " rel "
                       << quality.relative_edge_min.value << " std " << quality.relative_edge_std
                       << " area " << report.changed_area);
    CHECK(quality.euler == 2);
    CHECK(quality.n_non_delaunay == 0);
    CHECK(quality.n_obtuse == 0);
    CHECK(quality.relative_edge_min.value >= 0.65);
    CHECK(quality.dual_ratio_min.value > 0.0);
  }
}
