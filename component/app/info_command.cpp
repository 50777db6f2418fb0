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
  if (!file.mesh) return "faces that do not close to a surface";
  const auto n_triangles = static_cast<std::int64_t>(file.mesh->triangles.size());
  return text(file.mesh->n_vertices(), " cells, ", n_triangles / 2 * 3, " edges, ", n_triangles,
              " vertices");
}

std::string surface_of(const GridFile& file) {
  const Vec3 radii_m = file.surface.scale_m() * file.surface.radii();
  return text(radii_m.x(), " x ", radii_m.y(), " x ", radii_m.z(), " m");
}

void print_info(const GridFile& file) {
  const FileOrigin& origin = file.origin;
  print("file", file.path);
  print("format", origin.format);
  print("counts", counts(file));
  print("radii", surface_of(file));
  print("digest", origin.digest);
  print("delos version", origin.version);
  if (origin.has_certificate) {
    print("well centred", text(100.0 * origin.well_centred, " % of the triangles"));
    print("min edge / wanted", text(origin.min_relative_edge));
    print("min dual / primal", text(origin.min_dual_ratio));
  } else {
    print("certificate", "");
  }
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
