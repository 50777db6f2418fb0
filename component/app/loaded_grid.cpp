// SPDX-License-Identifier: BSD-3-Clause
#include "app/loaded_grid.hpp"

#include <filesystem>

#include "core/error.hpp"
#include "dual/build.hpp"

namespace delos::app {

LoadedGrid load_grid(Context& context, const std::string& path) {
  return load_grid(context, read_grid_file(context, path));
}

LoadedGrid load_grid(Context& context, GridFile grid_file) {
  LoadedGrid out{std::move(grid_file), {}, {}};
  const GridFile& file = out.file;
  const std::string& path = file.path;
  DELOS_CHECK(file.mesh || file.grid, ErrorKind::input, path,
              ": faces that do not close over the whole surface are no C-grid.");
  out.grid = file.grid ? *file.grid : build_grid(context, file.surface, file.latitude, *file.mesh);
  out.report.title = std::filesystem::path(path).filename().string();
  out.report.version = file.origin.version;
  out.report.surface = file.surface;
  out.report.n_threads = context.exec.n_threads();
  out.report.digest = file.origin.digest;
  if (file.mesh) {
    try {
      out.report.quality =
          measure_quality(context, file.surface, file.spacing, *file.mesh, file.latitude);
    } catch (const Error& error) {
      // Our own meshes can be measured, so the file is to blame.
      if (error.kind() != ErrorKind::internal) throw;
      throw Error(ErrorKind::input, text(path, ": ", error.what()));
    }
  }
  return out;
}

}  // namespace delos::app
