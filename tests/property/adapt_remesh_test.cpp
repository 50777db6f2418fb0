// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/remesh.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

#include "adapt/budget.hpp"
#include "dual/build.hpp"
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

/// Waves that go on a little everywhere, and a disc that asks for less than half.
Scene waves(bool is_flat) {
  const Ellipsoid surface = is_flat ? Ellipsoid(Vec3(1.2, 1.0, 0.8) * 6371220.0, Vec3(0, 0, 0))
                                    : Ellipsoid::sphere(6371220.0);
  const auto field = [&](double phase, double depth) {
    return sample_table(surface, [=](double lon, double lat, Index, Index) {
      const double wave = std::cos(lat * kRadPerDeg) * std::sin(3.0 * lon * kRadPerDeg + phase);
      const double away_deg = std::hypot(lat - 10.0, std::cos(lat * kRadPerDeg) * (lon - 40.0));
      const double dip = depth * std::exp(-away_deg * away_deg / 300.0);
      return 280e3 * (1.0 + 0.12 * wave) * (1.0 - dip);
    });
  };
  return {"waves", surface, field(0.0, 0.0), field(0.6, 0.55)};
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

Remeshed remeshed(Context& context, const Scene& scene, const Mesh& before, RemeshReport& report,
                  const std::vector<char>& is_fixed = {}) {
  return remesh(context, {scene.surface, scene.after, before, is_fixed}, {}, report);
}

std::vector<std::vector<Index>> neighbours(const Mesh& mesh) {
  std::vector<std::vector<Index>> out(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      out[static_cast<std::size_t>(t.vertex[k])].push_back(t.vertex[(k + 1) % 3]);
    }
  }
  for (auto& ring : out) std::sort(ring.begin(), ring.end());
  return out;
}

/// A fixed vertex is kept, and its neighbours are the same ones, kept too.
void check_fixed(const Mesh& before, const Remeshed& after, const std::vector<char>& is_fixed) {
  const auto old_rings = neighbours(before), new_rings = neighbours(after.mesh);
  for (std::size_t v = 0; v < is_fixed.size(); ++v) {
    if (is_fixed[v] == 0) continue;
    REQUIRE(after.new_id[v] != kNone);
    std::vector<Index> ring;
    for (const Index n : old_rings[v]) ring.push_back(after.new_id[static_cast<std::size_t>(n)]);
    std::sort(ring.begin(), ring.end());
    REQUIRE(ring == new_rings[static_cast<std::size_t>(after.new_id[v])]);
  }
}

std::vector<char> fixed_where(const Mesh& mesh, const Vec3& towards, double cosine) {
  std::vector<char> is_fixed(mesh.vertices.size());
  for (std::size_t v = 0; v < is_fixed.size(); ++v) {
    is_fixed[v] = mesh.vertices[v].position().normalized().dot(towards) > cosine ? 1 : 0;
  }
  return is_fixed;
}

}  // namespace

TEST_CASE("a remesh is as good as a fresh grid and keeps what lies outside bit for bit") {
  for (const Scene& scene : scenes()) {
    CAPTURE(scene.name);
    TestRun run(2);
    const Mesh before = fresh(run.context, scene.surface, scene.before);
    RemeshReport report;
    const Remeshed after = remeshed(run.context, scene, before, report);
    CHECK(report.kind == RemeshKind::local);
    CHECK(summary(validate(after.mesh, scene.surface)) == "");
    check_kept(before, after, report);
    CHECK(report.n_kept > before.n_vertices() / 2);
    const Quality quality = measure_quality(run.context, scene.surface, scene.after, after.mesh);
    CHECK(quality.euler == 2);
    CHECK(quality.n_non_delaunay == 0);
    CHECK(quality.n_obtuse == 0);
    CHECK(quality.relative_edge_min.value >= 0.65);
    CHECK(quality.dual_ratio_min.value > 0.0);
  }
}

TEST_CASE("1, 2, 5 and 8 threads remesh to the same bits") {
  for (const Scene& scene : scenes()) {
    CAPTURE(scene.name);
    TestRun one(1);
    const Mesh before = fresh(one.context, scene.surface, scene.before);
    RemeshReport report;
    const Remeshed expected = remeshed(one.context, scene, before, report);
    for (const int threads : {2, 5, 8}) {
      CAPTURE(threads);
      TestRun run(threads);
      const Remeshed found = remeshed(run.context, scene, before, report);
      CHECK(digest(found.mesh) == digest(expected.mesh));
      CHECK(found.new_id == expected.new_id);
    }
  }
}

TEST_CASE("where spacings differ everywhere a remesh is local, as good and within tau") {
  for (const bool is_flat : {false, true}) {
    CAPTURE(is_flat);
    const Scene scene = waves(is_flat);
    TestRun run(2);
    const Mesh before = fresh(run.context, scene.surface, scene.before);
    const Grid grid = build_grid(run.context, scene.surface, LatitudeKind::geodetic, before);
    for (const double tau : {1.2, 1.3, 1.5, 1.8}) {
      CAPTURE(tau);
      RemeshOptions options;
      options.region.tolerance = tau;
      options.region.passes = true;
      options.region.rings = 2;
      const RemeshPlan plan =
          plan_remesh(run.context, {scene.surface, scene.after, before, {}}, options);
      const SpacingField followed =
          followed_spacing(run.exec, grid, plan.region, scene.before, scene.after);
      RemeshReport report;
      const Remeshed after =
          remesh(run.context, {scene.surface, followed, before, {}}, options, plan, report);
      CHECK(report.kind == RemeshKind::local);
      CHECK(report.n_kept > before.n_vertices() / 2);
      CHECK(summary(validate(after.mesh, scene.surface)) == "");
      check_kept(before, after, report);
      const Quality quality = measure_quality(run.context, scene.surface, followed, after.mesh);
      CHECK(quality.n_obtuse == 0);
      CHECK(quality.relative_edge_min.value >= 0.65);
      double most = 1.0;
      for (const Vertex& v : after.mesh.vertices) {
        const double ratio = v.spacing / scene.after.at(v.x, v.y, v.z);
        most = std::max({most, ratio, 1.0 / ratio});
      }
      CHECK(most < 1.05 * tau);
    }
  }
}

TEST_CASE("a remesh to the same spacing changes nothing") {
  const Scene scene = scenes().front();
  TestRun run(2);
  const Mesh before = fresh(run.context, scene.surface, scene.before);
  RemeshReport report;
  const Remeshed after = remesh(run.context, {scene.surface, scene.before, before, {}}, {}, report);
  CHECK(report.kind == RemeshKind::nothing);
  CHECK(digest(after.mesh) == digest(before));
  check_kept(before, after, report);
  CHECK(report.n_kept == before.n_vertices());
}

TEST_CASE("a remesh of everything is a fresh grid") {
  const Ellipsoid sphere;
  TestRun run(2);
  const Scene scene{"uniform", sphere, SpacingField::constant(sphere, 0.06),
                    SpacingField::constant(sphere, 0.1)};
  const Mesh before = fresh(run.context, sphere, scene.before);
  RemeshReport report;
  const Remeshed after = remeshed(run.context, scene, before, report);
  CHECK(report.kind == RemeshKind::full);
  CHECK(digest(after.mesh) == digest(fresh(run.context, sphere, scene.after)));
  CHECK(
      std::all_of(after.new_id.begin(), after.new_id.end(), [](Index id) { return id == kNone; }));
}

TEST_CASE("cells of fixed vertices inside a region stay as they are") {
  for (const Scene& scene : scenes()) {
    CAPTURE(scene.name);
    TestRun run(2);
    const Mesh before = fresh(run.context, scene.surface, scene.before);
    RemeshReport report;
    const Remeshed moved = remeshed(run.context, scene, before, report);
    // Around a vertex that goes when none is fixed.
    const auto gone = std::find(moved.new_id.begin(), moved.new_id.end(), kNone);
    REQUIRE(gone != moved.new_id.end());
    const Vec3 towards =
        before.position(static_cast<Index>(gone - moved.new_id.begin())).normalized();
    const std::vector<char> is_fixed = fixed_where(before, towards, 0.99);
    const Remeshed after = remeshed(run.context, scene, before, report, is_fixed);
    CHECK(report.n_held > 0);
    CHECK(summary(validate(after.mesh, scene.surface)) == "");
    check_kept(before, after, report);
    check_fixed(before, after, is_fixed);
  }
}

TEST_CASE("a hole of almost the whole surface is filled around a fixed cap") {
  const Ellipsoid sphere;
  for (const double h : {0.03, 0.05, 0.085, 0.1}) {
    CAPTURE(h);
    TestRun run(2);
    const Scene scene{"uniform", sphere, SpacingField::constant(sphere, 0.06),
                      SpacingField::constant(sphere, h)};
    const Mesh before = fresh(run.context, sphere, scene.before);
    const std::vector<char> is_fixed = fixed_where(before, Vec3(0, 0.6, 0.8), 0.95);
    RemeshReport report;
    const Remeshed after = remeshed(run.context, scene, before, report, is_fixed);
    CHECK(summary(validate(after.mesh, sphere)) == "");
    check_kept(before, after, report);
    check_fixed(before, after, is_fixed);
    const double wanted = expected_vertices(run.context.exec, sphere, scene.after);
    if (report.kind == RemeshKind::local) {
      CHECK(after.mesh.n_vertices() == doctest::Approx(wanted).epsilon(0.15));
    }
  }
}

TEST_CASE("a few vertices of another spacing are no reason to change a mesh") {
  const Ellipsoid sphere;
  const SpacingField spacing = SpacingField::constant(sphere, 0.06);
  TestRun run(1);
  Mesh before = fresh(run.context, sphere, spacing);
  before.vertices[17].spacing *= 2.0;
  RemeshReport report;
  const Remeshed after = remesh(run.context, {sphere, spacing, before, {}}, {}, report);
  CHECK(report.n_wanted == 1);
  CHECK(report.kind == RemeshKind::nothing);
  CHECK(digest(after.mesh) == digest(before));
}

TEST_CASE("a request to stop ends a remesh, and the old mesh is as it was") {
  const Scene scene = scenes().front();
  TestRun run(2);
  const Mesh before = fresh(run.context, scene.surface, scene.before);
  const std::string bits = digest(before);
  std::atomic<bool> cancel = true;
  Monitor monitor({}, {}, &cancel);
  Context context{run.exec, monitor};
  RemeshReport report;
  CHECK_THROWS_AS(remeshed(context, scene, before, report), Error);
  CHECK(digest(before) == bits);
}
