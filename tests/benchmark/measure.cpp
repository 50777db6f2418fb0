// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/measure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <thread>
#include <vector>

#include "benchmark/system_times.hpp"
#include "benchmark/yardstick.hpp"
#include "lifecycle/generate.hpp"
#include "lifecycle/inputs.hpp"
#include "lifecycle/outputs.hpp"
#include "lifecycle/settings_tree.hpp"
#include "lifecycle/version.hpp"
#include "sizing/gradient_limit.hpp"
#include "triangulation/delaunay.hpp"

namespace delos::benchmark {
namespace {

constexpr double kBytesPerMib = 1024.0 * 1024.0;
/// Phases of a line in their order; what a case lacks is null.
constexpr const char* kPhases[] = {"read",    "spacing", "limit",  "refine", "relax",    "polish",
                                   "quality", "dual",    "digest", "write",  "delaunay", "cgal"};
/// Phases at whose end the peak of memory is told; it never falls from one to the next.
constexpr const char* kPeaks[] = {"refine", "relax", "polish", "dual"};

/// Six digits: more would be noise.
double rounded(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.6g", value);
  return std::strtod(digits, nullptr);
}

/// A size of the process from the kernel, e.g. "VmHWM", in MiB. Not getrusage(): its peak begins
/// with the parent's.
double process_mib(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word == key + ":") {
      double kib = 0.0;
      status >> kib;
      return kib / 1024.0;
    }
  }
  return 0.0;
}

std::string first_value(const char* path, const std::string& key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(':');
    if (line.compare(0, key.size(), key) != 0 || colon == std::string::npos) continue;
    const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
    if (begin != std::string::npos) return line.substr(begin);
  }
  return "unknown";
}

void add_quality(const Quality& quality, Json& line) {
  line["area_length_min"] = rounded(quality.area_length_min.value);
  line["area_length_p01"] = rounded(quality.area_length_p01);
  line["area_length_mean"] = rounded(quality.area_length_mean);
  line["angle_min_deg"] = rounded(quality.angle_min_deg.value);
  line["angle_max_deg"] = rounded(quality.angle_max_deg.value);
  line["angle_mad_deg"] = rounded(quality.angle_mad_deg);
  line["degree_6"] = rounded(quality.degree_6);
  line["relative_edge_std"] = rounded(quality.relative_edge_std);
  line["relative_edge_min"] = rounded(quality.relative_edge_min.value);
  line["relative_edge_max"] = rounded(quality.relative_edge_max.value);
  line["dual_ratio_min"] = rounded(quality.dual_ratio_min.value);
  line["stagger_mean"] = rounded(quality.stagger_mean);
  line["stagger_max"] = rounded(quality.stagger_max.value);
  line["obtuse"] = quality.n_obtuse;
}

/// The gradient limiter alone, on the table that the phase "spacing" gave it.
void time_limiter(Context& context, const Settings& settings) {
  Monitor unheard;
  Context aside{context.exec, unheard};
  SpacingRecipe recipe = read_inputs(aside, settings).recipe;
  const double slope = recipe.gradient_limit;
  if (slope <= 0.0) return;
  recipe.gradient_limit = 0.0;
  LatLonField table_m = build_spacing_table(aside, settings.surface, recipe);
  const Phase phase(context.monitor, "limit", static_cast<std::int64_t>(table_m.values.size()));
  limit_gradient(aside, settings.surface, recipe.latitude, slope, table_m);
  context.monitor.advance(static_cast<std::int64_t>(table_m.values.size()));
}

/// Building alone, from the finished grid's vertices: ours and, on one thread, the yardstick's.
void time_building(Context& context, const Mesh& mesh) {
  std::vector<Vec3> points;
  points.reserve(mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) points.push_back(vertex.position());
  {
    const Phase phase(context.monitor, "delaunay", mesh.n_vertices());
    const Mesh built = delaunay(context.exec, points);
    context.monitor.advance(built.n_vertices());
  }
  if (context.exec.n_threads() == 1) run_yardstick(context.monitor, points);
}

void add_times(const Monitor& monitor, const SystemTimes& system_times, Json& line) {
  for (const char* name : kPhases) {
    const std::string key = name;
    line[key + "_s"] = nullptr;
    line[key + "_cpu_s"] = nullptr;
    line[key + "_user_s"] = nullptr;
    for (const PhaseTime& phase : monitor.phases()) {
      if (phase.phase != name) continue;
      line[key + "_s"] = rounded(phase.wall_s);
      line[key + "_cpu_s"] = rounded(phase.cpu_s);
      line[key + "_user_s"] = rounded(system_times.user_s(phase));
      if (key == "limit") line["limit_nodes"] = phase.items;
    }
  }
  if (!line.contains("limit_nodes")) line["limit_nodes"] = nullptr;
}

bool ends_with(const std::string& text, const std::string& ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

/// `count` a second of the phases together, of the program's own seconds on one thread and of wall
/// time on more; null when one of them was not measured.
Json rate(const Json& line, double count, const std::vector<std::string>& phases) {
  double seconds = 0.0;
  for (const std::string& phase : phases) {
    const Json& time = line.at(phase + (line.at("threads") == 1 ? "_user_s" : "_s"));
    if (time.is_null()) return nullptr;
    seconds += time.get<double>();
  }
  return seconds > 0.0 ? Json(rounded(count / seconds)) : Json(nullptr);
}

}  // namespace

Json measure(const Case& benchmark_case, int threads, const std::string& folder) {
  if (benchmark_case.prepare) benchmark_case.prepare(folder);
  const std::string formats = benchmark_case.writes_files ? "[mpas]" : "[]";
  const std::string yaml = text(benchmark_case.yaml, "\noutput: {directory: ", folder,
                                ", name: grid, formats: ", formats,
                                ", graph: ", benchmark_case.writes_files ? "true" : "false", "}");
  const Settings settings = read_settings(parse_config(yaml, benchmark_case.name), folder);
  const double start_mib = process_mib("VmRSS");
  std::map<std::string, double> peak_mib;
  double whole_mib = 0.0;
  // The kernel's count is not exact and may fall a little; a peak may not.
  bool runs = true;
  const auto note_peak = [&] {
    if (runs) whole_mib = std::max(whole_mib, process_mib("VmHWM"));
    return whole_mib;
  };
  parallel::Executor exec(threads);
  SystemTimes system_times;
  const auto note = [&](const Progress& progress) {
    peak_mib[progress.phase] = note_peak();
    system_times.note(progress);
  };
  Monitor monitor(note, {}, nullptr);
  Context context{exec, monitor};
  const Product product = generate(context, settings, {true, folder});
  if (benchmark_case.writes_files) {
    write_outputs(context, output_content(product, "delos_benchmark"), folder);
  }
  note_peak();
  // What follows is measured beside the run and takes memory of its own.
  runs = false;
  time_limiter(context, settings);
  if (settings.surface.is_sphere()) time_building(context, product.mesh);

  Json line;
  line["case"] = benchmark_case.name;
  line["threads"] = threads;
  line["repeats"] = 1;
  line["surface"] = settings.shape;
  line["vertices"] = product.mesh.n_vertices();
  add_times(monitor, system_times, line);
  line["start_mib"] = rounded(start_mib);
  for (const char* phase : kPeaks)
    line[std::string(phase) + "_peak_mib"] = rounded(peak_mib[phase]);
  line["peak_mib"] = rounded(whole_mib);
  add_quality(product.report.quality, line);
  line["digest"] = product.report.digest;
  return line;
}

void join(const Json& other, Json& line) {
  DELOS_CHECK(other.at("digest") == line.at("digest"), ErrorKind::internal,
              line.at("case").get<std::string>(), ": two runs on ", line.at("threads").get<int>(),
              " threads made different grids");
  for (const char* phase : kPhases) {
    const std::string key = std::string(phase) + "_cpu_s";
    if (line.at(key).is_null() || other.at(key).is_null() || line.at(key) <= other.at(key))
      continue;
    // The program's own seconds belong to the whole of the same run.
    for (const char* part : {"_cpu_s", "_user_s"})
      line[phase + std::string(part)] = other.at(phase + std::string(part));
  }
  for (auto& [key, value] : line.items()) {
    const Json& second = other.at(key);
    if (!value.is_number_float() || !second.is_number_float()) continue;
    if (ends_with(key, "_cpu_s") || ends_with(key, "_user_s")) continue;
    if (ends_with(key, "_s")) value = std::min(value.get<double>(), second.get<double>());
    if (ends_with(key, "_mib")) value = std::max(value.get<double>(), second.get<double>());
  }
  line["repeats"] = line.at("repeats").get<int>() + other.at("repeats").get<int>();
}

void add_rates(Json& line) {
  const auto n = line.at("vertices").get<double>();
  const auto bytes_per_vertex = [&](const char* key) {
    const double mib = line.at(key).get<double>() - line.at("start_mib").get<double>();
    return rounded(mib * kBytesPerMib / n);
  };
  line["refine_vertices_per_s"] = rate(line, n, {"refine"});
  line["mesh_vertices_per_s"] = rate(line, n, {"refine", "relax", "polish"});
  line["dual_cells_per_s"] = rate(line, n, {"dual"});
  line["limit_nodes_per_s"] = line.at("limit_nodes").is_null()
                                  ? Json(nullptr)
                                  : rate(line, line.at("limit_nodes").get<double>(), {"limit"});
  line["mesh_bytes_per_vertex"] = bytes_per_vertex("polish_peak_mib");
  line["bytes_per_vertex"] = bytes_per_vertex("peak_mib");
}

Json machine() {
  double memory_kib = 0.0;
  std::sscanf(first_value("/proc/meminfo", "MemTotal").c_str(), "%lf", &memory_kib);
  return {{"processor", first_value("/proc/cpuinfo", "model name")},
          {"cores", static_cast<int>(std::thread::hardware_concurrency())},
          {"memory_gib", rounded(std::round(memory_kib / kBytesPerMib * 10.0) / 10.0)},
#ifdef __clang__
          {"compiler", __VERSION__},
#else
          {"compiler", "GCC " __VERSION__},
#endif
          {"build", DELOS_BENCHMARK_BUILD},
          {"delos", library_version()}};
}

}  // namespace delos::benchmark
