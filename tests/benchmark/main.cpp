// SPDX-License-Identifier: BSD-3-Clause
// Fixed cases, one JSON line each on standard output: wall time of every phase, vertices a second,
// peak memory, quality columns, and the yardstick on the same points.
//   delos_benchmark [--threads N] [CASE...]     default: all cases, one thread
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "benchmark/yardstick.hpp"
#include "lifecycle/generate.hpp"
#include "lifecycle/outputs.hpp"
#include "lifecycle/settings_tree.hpp"
#include "triangulation/delaunay.hpp"

namespace delos::benchmark {
namespace {

struct Case {
  const char* name;
  const char* yaml;
};

// The names are those under which other generators' figures are known: uniform spacing in km, V1
// the 150-to-15 km patch, E an ellipsoid of the Earth, T a triaxial body.
constexpr Case kCases[] = {
    {"U120", "sizing: {sources: [{type: constant, spacing: 120 km}]}"},
    {"U60", "sizing: {sources: [{type: constant, spacing: 60 km}]}"},
    {"U30", "sizing: {sources: [{type: constant, spacing: 30 km}]}"},
    {"E60", "surface: {shape: wgs84}\nsizing: {sources: [{type: constant, spacing: 60 km}]}"},
    {"T60",
     "surface: {shape: ellipsoid, radii: [7645.464 km, 6371.22 km, 5096.976 km]}\n"
     "sizing: {sources: [{type: constant, spacing: 60 km}]}"},
    {"V1",
     "sizing:\n  resolution: 0.25 deg\n  sources:\n"
     "    - {type: disc, centre: [-40 deg, 35 deg], radius: 0 deg, spacing: 15 km,\n"
     "       outside: 150 km, transition: gaussian, width: 14.142135623730951 deg}"},
};

/// Most memory that the process has held so far; grows from case to case, so large cases come last.
double peak_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void print_number(const char* key, double value) { std::printf(", \"%s\": %.6g", key, value); }

void print_quality(const Quality& quality) {
  print_number("area_length_min", quality.area_length_min.value);
  print_number("area_length_p01", quality.area_length_p01);
  print_number("area_length_mean", quality.area_length_mean);
  print_number("angle_min_deg", quality.angle_min_deg.value);
  print_number("angle_max_deg", quality.angle_max_deg.value);
  print_number("angle_mad_deg", quality.angle_mad_deg);
  print_number("degree_6", quality.degree_6);
  print_number("relative_edge_min", quality.relative_edge_min.value);
  print_number("relative_edge_max", quality.relative_edge_max.value);
  print_number("relative_edge_std", quality.relative_edge_std);
  print_number("dual_ratio_min", quality.dual_ratio_min.value);
  print_number("stagger_max", quality.stagger_max.value);
  print_number("obtuse", static_cast<double>(quality.n_obtuse));
}

/// Building alone, from the finished grid's vertices: ours and the yardstick's.
void print_building(parallel::Executor& exec, const Mesh& mesh) {
  std::vector<Vec3> points;
  points.reserve(mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) points.push_back(vertex.position());
  const auto start = std::chrono::steady_clock::now();
  const Mesh built = delaunay(exec, points);
  print_number("delaunay_s", seconds_since(start));
  if (const auto other_s = yardstick_s(points)) print_number("cgal_s", *other_s);
}

void run(const Case& benchmark_case, int threads) {
  const std::string folder =
      (std::filesystem::temp_directory_path() / "delos_benchmark_XXXXXX").string();
  std::string name = folder;
  if (mkdtemp(name.data()) == nullptr) throw Error(ErrorKind::output, "no temporary folder");
  const std::string yaml = std::string(benchmark_case.yaml) + "\noutput: {directory: " + name +
                           ", name: grid, formats: [mpas]}";
  parallel::Executor exec(threads);
  Monitor monitor;
  Context context{exec, monitor};
  const Settings settings = read_settings(parse_config(yaml, benchmark_case.name), name);
  const Product product = generate(context, settings, {true, name});
  write_outputs(context, output_content(product, "delos_benchmark"), name);
  std::filesystem::remove_all(name);

  const auto n = static_cast<double>(product.mesh.n_vertices());
  std::printf("{\"case\": \"%s\", \"threads\": %d", benchmark_case.name, threads);
  print_number("vertices", n);
  double grid_s = 0.0;
  for (const PhaseTime& phase : monitor.phases()) {
    print_number((phase.phase + "_s").c_str(), phase.wall_s);
    if (phase.phase == "refine") print_number("refine_vertices_per_s", n / phase.wall_s);
    if (phase.phase == "refine" || phase.phase == "relax") grid_s += phase.wall_s;
  }
  print_number("vertices_per_s", n / grid_s);
  print_number("peak_mib", peak_mib());
  print_quality(product.report.quality);
  if (product.mesh.n_vertices() > 0 && settings.surface.is_sphere()) {
    print_building(exec, product.mesh);
  }
  std::printf(", \"digest\": \"%s\"}\n", product.report.digest.c_str());
  std::fflush(stdout);
}

int run_all(int argc, char** argv) {
  int threads = 1;
  std::vector<std::string> names;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--threads" && i + 1 < argc) {
      threads = std::atoi(argv[++i]);
    } else {
      names.emplace_back(argv[i]);
    }
  }
  int n_run = 0;
  for (const Case& benchmark_case : kCases) {
    if (!names.empty() && std::find(names.begin(), names.end(), benchmark_case.name) == names.end())
      continue;
    run(benchmark_case, threads);
    ++n_run;
  }
  if (n_run == 0) std::fprintf(stderr, "no such case\n");
  return n_run == 0 ? 2 : 0;
}

}  // namespace
}  // namespace delos::benchmark

int main(int argc, char** argv) {
  try {
    return delos::benchmark::run_all(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
