// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "lifecycle/grid_file.hpp"

namespace delos::app {
namespace {

void print(const char* name, const std::string& value) {
  std::printf("%-18s%s\n", name, value.empty() ? "(not in the file)" : value.c_str());
}

std::string counts(const GridFile& file) {
  if (file.grid) {
    return text(file.grid->n_cells(), " cells, ", file.grid->n_edges(), " edges, ",
                file.grid->n_vertices(), " vertices");
  }
  if (file.triangles) {
    return text(file.triangles->position.size(), " points, ", file.triangles->corners.size(),
                " triangles with a border");
  }
  if (!file.mesh) return "faces that do not close to a surface";
  const auto n_triangles = static_cast<std::int64_t>(file.mesh->triangles.size());
  return text(file.mesh->n_vertices(), " cells, ", n_triangles / 2 * 3, " edges, ", n_triangles,
              " vertices");
}

std::string surface_of(const GridFile& file) {
  const Vec3 radii_m = file.surface.scale_m() * file.surface.radii();
  return text(radii_m.x(), " x ", radii_m.y(), " x ", radii_m.z(), " m");
}

void print_certificate(const std::optional<Certificate>& certificate) {
  if (!certificate) {
    print("certificate", "");
    return;
  }
  const char* name = "certificate";
  for (const std::string& line : certificate_text(*certificate)) {
    print(name, line);
    name = "";
  }
  const auto worst = [](const char* measure, const Extreme& extreme, const char* unit = "") {
    print(measure, text(extreme.value, unit, ", at ", describe(extreme)));
  };
  print("well centred", text(100.0 * certificate->well_centred, " % of the triangles, ",
                             certificate->n_obtuse, " are obtuse"));
  worst("largest angle", certificate->angle_max_deg, " deg");
  if (certificate->relative_edge_min) {
    worst("least edge/wanted", *certificate->relative_edge_min);
  }
  worst("least dual/edge", certificate->dual_ratio_min);
  worst("largest stagger", certificate->stagger_max);
}

void print_info(const GridFile& file) {
  const FileOrigin& origin = file.origin;
  print("file", file.path);
  print("format", origin.format);
  print("counts", counts(file));
  print("radii", surface_of(file));
  print("digest", origin.digest);
  print("delos version", origin.version);
  print_certificate(origin.certificate);
  for (const InputRecord& input : origin.inputs) print("input", input.sha256 + "  " + input.path);
  print("history", origin.history);
  if (!origin.config.empty()) std::printf("configuration:\n%s\n", origin.config.c_str());
  std::printf("\n");
}

}  // namespace

int run_info(const Arguments& arguments) {
  parallel::Executor exec(arguments.threads);
  Monitor monitor;
  Context context{exec, monitor};
  for (const std::string& path : grid_files(arguments.file)) {
    print_info(read_grid_file(context, path));
  }
  return kSuccess;
}

}  // namespace delos::app
