// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/remesh_cases.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>

#include "adapt/remesh.hpp"
#include "benchmark/fresh_mesh.hpp"
#include "core/elementary.hpp"
#include "sizing/nodes.hpp"
#include "sizing/raster.hpp"

namespace delos::benchmark {
namespace {

constexpr double kRadius = 6371220.0;
constexpr double kSea_m = 24.5e3;  // some million cells
constexpr double kSlope = 0.15;

/// Half the spacing within discs of one radius, growing outwards by kSlope.
SpacingField discs(parallel::Executor& exec, const Ellipsoid& surface,
                   const std::vector<Vec3>& centres, double radius_rad) {
  LatLonField table = make_table(0.25 * kRadPerDeg);
  const NodeDirections nodes(table);
  for_rows(exec, table, [&](Index row, double* values) {
    for (Index i = 0; i < table.n_lon; ++i) {
      const Vec3 p = nodes.direction(row, i);
      double least_rad = kPi;
      for (const Vec3& centre : centres) {
        least_rad = std::min(least_rad, angle_of_chord2((p - centre).squaredNorm()));
      }
      const double beyond_m = std::max(0.0, least_rad - radius_rad) * kRadius;
      values[i] = std::min(kSea_m, 0.5 * kSea_m + kSlope * beyond_m);
    }
  });
  return SpacingField::table(exec, surface, LatitudeKind::geodetic, table);
}

std::vector<Vec3> specks(double lon_deg) {
  std::vector<Vec3> out;
  for (int k = 0; k < 60; ++k) out.push_back(unit_vector(lon_deg + 47.0 * k, -60.0 + 2.0 * k));
  return out;
}

struct Scene {
  const char* name;
  std::vector<Vec3> before, after;
  double radius_deg;
};

std::vector<Scene> scenes() {
  return {{"crescents", {unit_vector(0.0, 20.0)}, {unit_vector(11.0, 20.0)}, 14.0},
          {"patch",
           {unit_vector(0.0, 20.0)},
           {unit_vector(0.0, 20.0), unit_vector(120.0, -10.0)},
           12.6},
          {"specks", specks(0.0), specks(4.0), 0.8}};
}

double seconds_of(const std::function<void()>& body) {
  const auto begin = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

RemeshTiming timed(const Scene& scene, int threads, int rounds) {
  parallel::Executor exec(threads);
  const Ellipsoid surface = Ellipsoid::sphere(kRadius);
  const double radius_rad = scene.radius_deg * kRadPerDeg;
  const SpacingField before = discs(exec, surface, scene.before, radius_rad);
  const SpacingField after = discs(exec, surface, scene.after, radius_rad);
  RemeshTiming out;
  out.name = scene.name;
  out.threads = threads;
  out.fresh_s = out.remesh_s = std::numeric_limits<double>::infinity();
  Monitor quiet;
  Context context{exec, quiet};
  const Mesh old = fresh_mesh(context, surface, before);
  out.n_before = old.n_vertices();
  for (int round = 0; round < rounds; ++round) {
    out.fresh_s = std::min(out.fresh_s, seconds_of([&] { fresh_mesh(context, surface, after); }));
    Monitor monitor;
    Context watched{exec, monitor};
    RemeshReport report;
    Remeshed found;
    out.remesh_s = std::min(out.remesh_s, seconds_of([&] {
                              found = remesh(watched, {surface, after, old, {}}, {}, report);
                            }));
    out.n_after = found.mesh.n_vertices();
    out.n_removed = report.n_removed;
    out.n_inserted = report.n_inserted;
    out.phases = monitor.phases();
    out.digest = digest(found.mesh);
  }
  return out;
}

}  // namespace

std::vector<RemeshTiming> time_remesh(std::span<const int> threads, int rounds,
                                      std::span<const std::string> names) {
  std::vector<RemeshTiming> out;
  for (const Scene& scene : scenes()) {
    if (!names.empty() && std::find(names.begin(), names.end(), scene.name) == names.end()) {
      continue;
    }
    for (const int n : threads) out.push_back(timed(scene, n, rounds));
  }
  return out;
}

}  // namespace delos::benchmark
