// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <filesystem>

#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/loaded_grid.hpp"
#include "app/pictures.hpp"
#include "core/error.hpp"
#include "io/embedded_bathymetry.hpp"

namespace delos::app {

int run_plot(const Arguments& arguments, const std::atomic<bool>& cancel) {
  namespace fs = std::filesystem;
  parallel::Executor exec(arguments.threads);
  Monitor monitor({}, {}, &cancel);
  Context context{exec, monitor};
  const LoadedGrid loaded = load_grid(context, grid_files(arguments.file).front());
  const Raster elevation_m = embedded_bathymetry();
  const std::string folder = arguments.directory.empty() ? "." : arguments.directory;
  std::error_code error;
  fs::create_directories(folder, error);
  DELOS_CHECK(!error, ErrorKind::output, "the folder ", folder, " can't be made: ", error.message(),
              ".");
  const PictureSubject subject{loaded.report.title, loaded.grid, loaded.report.quality,
                               &elevation_m};
  const std::string stem = fs::path(loaded.file.path).stem().string();
  for (const char* const picture : {"globe", "map", "histograms"}) {
    monitor.check_cancelled();
    const fs::path path = fs::path(folder) / text(stem, ".", picture, ".png");
    draw_picture(subject, picture, path.string());
    std::printf("wrote %s\n", path.c_str());
  }
  return kSuccess;
}

}  // namespace delos::app
