// SPDX-License-Identifier: BSD-3-Clause
#include "app/loaded_grid.hpp"

#include <filesystem>

#include "core/error.hpp"
#include "dual/build.hpp"
#include "lifecycle/culled.hpp"

namespace delos::app {

LoadedGrid load_grid(Context& context, const std::string& path) {
  GridFile file = read_grid_file(context, path);
  DELOS_CHECK(file.mesh || file.grid, ErrorKind::input, path,
              ": faces that do not close over the whole surface are no C-grid.");
  return load_grid(context, std::move(file));
}

LoadedGrid load_grid(Context& context, GridFile grid_file) {
  LoadedGrid out{std::move(grid_file), {}, {}};
  const GridFile& file = out.file;
  const std::string& path = file.path;
  if (file.grid) {
    out.grid = *file.grid;
  } else if (file.mesh) {
    out.grid = build_grid(context, file.surface, file.latitude, *file.mesh);
  }
  out.report.title = std::filesystem::path(path).filename().string();
  out.report.version = file.origin.version;
  out.report.surface = file.surface;
  out.report.n_threads = context.exec.n_threads();
  out.report.digest = file.origin.digest;
  try {
    out.report.quality = visit_mesh(
        context, file, [&](const CertifiedMesh& mesh) { return measure_quality(context, mesh); });
  } catch (const Error& error) {
    // Our own meshes can be measured, so the file is to blame.
    if (error.kind() != ErrorKind::internal && error.kind() != ErrorKind::input) throw;
    throw Error(ErrorKind::input, text(path, ": ", error.what()));
  }
  return out;
}

}  // namespace delos::app
