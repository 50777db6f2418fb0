// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/remap_cases.hpp"

#include <algorithm>

#include "benchmark/fresh_mesh.hpp"
#include "benchmark/system_times.hpp"
#include "core/hash.hpp"
#include "dual/build.hpp"
#include "remap/transfer.hpp"

namespace delos::benchmark {
namespace {

constexpr double kRemapRadius_m = 6371220.0;
constexpr double kCoarse_m = 60e3;
constexpr double kFine_m = 30e3;

struct Pair {
  std::string name;
  Grid source, target;
};

Grid uniform_grid(Context& context, const Ellipsoid& surface, double spacing_m) {
  const Mesh mesh = fresh_mesh(context, surface, SpacingField::constant(surface, spacing_m));
  return build_grid(context, surface, LatitudeKind::geodetic, mesh);
}

std::vector<Pair> pairs(std::span<const std::string> names) {
  const auto is_wanted = [&](const char* name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  };
  parallel::Executor exec;
  Monitor monitor;
  Context context{exec, monitor};
  std::vector<Pair> out;
  const auto add = [&](const char* name, const Ellipsoid& surface, double from_m, double to_m) {
    if (!is_wanted(name)) return;
    out.push_back(
        {name, uniform_grid(context, surface, from_m), uniform_grid(context, surface, to_m)});
  };
  add("coarsen", Ellipsoid::sphere(kRemapRadius_m), kFine_m, kCoarse_m);
  add("refine", Ellipsoid::sphere(kRemapRadius_m), kCoarse_m, kFine_m);
  add("coarsen_wgs84", Ellipsoid::wgs84(), kFine_m, kCoarse_m);
  return out;
}

// What came of one round.
struct Results {
  remap::Weights first, second, transposed;
  std::vector<double> field, by_first, by_second, limited;
};

template <class Body>
void in_phase(Monitor& monitor, const char* phase, Body&& body) {
  const Phase timed(monitor, phase, 0);
  body();
}

void run_phases(parallel::Executor& exec, Monitor& monitor, const Pair& pair, RemapTiming& out) {
  Context context{exec, monitor};
  Results results;
  for (const Vec3& p : pair.source.cell_position) {
    results.field.push_back(2.0 + p.x() * p.y() - p.z());
  }
  for (auto* field : {&results.by_first, &results.by_second, &results.limited}) {
    field->assign(pair.target.cell_position.size(), 0.0);
  }
  monitor.begin("intersect", pair.target.n_cells());
  const remap::Tiling source = remap::Tiling::cells(exec, pair.source);
  const remap::Tiling target = remap::Tiling::cells(exec, pair.target);
  remap::Transfer transfer(context, source, target, remap::Order::first);
  monitor.end();
  in_phase(monitor, "first", [&] { results.first = transfer.weights(exec, remap::Order::first); });
  in_phase(monitor, "gradients", [&] { transfer.add_second_order(exec, source); });
  in_phase(monitor, "second",
           [&] { results.second = transfer.weights(exec, remap::Order::second); });
  in_phase(monitor, "transpose", [&] { results.transposed = transpose(exec, results.first); });
  in_phase(monitor, "apply_first",
           [&] { apply(exec, results.first, results.field, results.by_first); });
  in_phase(monitor, "apply_second",
           [&] { apply(exec, results.second, results.field, results.by_second); });
  in_phase(monitor, "apply_limited", [&] { transfer.apply(exec, results.field, results.limited); });
  out.n_overlaps = transfer.overlaps().size();
  Digest digest;
  digest.add(std::span<const double>(transfer.overlaps().area_m2));
  digest.add(std::span<const Vec3>(transfer.overlaps().middle));
  for (const remap::Weights* weights : {&results.first, &results.second, &results.transposed}) {
    digest.add(std::span<const Index>(weights->column));
    digest.add(std::span<const double>(weights->value));
  }
  for (const auto* field : {&results.by_first, &results.by_second, &results.limited}) {
    digest.add(std::span<const double>(*field));
  }
  out.digest = digest.hex();
}

RemapTiming timed_pair(const Pair& pair, int threads, int rounds) {
  parallel::Executor exec(threads);
  RemapTiming out;
  out.name = pair.name;
  out.threads = threads;
  out.n_sources = pair.source.n_cells();
  out.n_targets = pair.target.n_cells();
  for (int round = 0; round < rounds; ++round) {
    SystemTimes system_times;
    Monitor monitor([&](const Progress& progress) { system_times.note(progress); }, {}, nullptr);
    run_phases(exec, monitor, pair, out);
    if (round == 0) out.phases.resize(monitor.phases().size());
    for (std::size_t k = 0; k < out.phases.size(); ++k) {
      const PhaseTime& now = monitor.phases()[k];
      const RemapTiming::PhaseSeconds seconds{now.phase, now.wall_s, system_times.user_s(now)};
      RemapTiming::PhaseSeconds& least = out.phases[k];
      if (round == 0) least = seconds;
      least.wall_s = std::min(least.wall_s, seconds.wall_s);
      least.user_s = std::min(least.user_s, seconds.user_s);
    }
  }
  return out;
}

}  // namespace

std::vector<RemapTiming> time_remap(std::span<const int> threads, int rounds,
                                    std::span<const std::string> names) {
  std::vector<RemapTiming> out;
  for (const Pair& pair : pairs(names)) {
    for (const int n : threads) out.push_back(timed_pair(pair, n, rounds));
  }
  return out;
}

}  // namespace delos::benchmark
