// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <optional>

#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/pictures.hpp"
#include "app/progress_bar.hpp"
#include "io/embedded_bathymetry.hpp"
#include "lifecycle/config_file.hpp"
#include "lifecycle/generate.hpp"
#include "lifecycle/outputs.hpp"

namespace delos::app {
namespace {

Settings settings_of(const Arguments& arguments) {
  ConfigFile file = read_config_file(arguments.file);
  for (const auto& [key, value] : arguments.overrides) override_config(file.root, key, value);
  return read_settings(file.root, file.folder);
}

/// A part of the Earth is nothing without its coast, even if the grid has no use for one.
std::optional<Raster> coast_to_draw(const Product& product) {
  constexpr double kEarth_m = 6371e3, kNear = 0.01;
  const Settings& settings = product.settings;
  const bool is_earth = std::abs(settings.surface.scale_m() / kEarth_m - 1.0) < kNear;
  if (product.elevation_m != nullptr || !is_earth || settings.output.pictures.empty()) return {};
  if (!settings.region && !settings.domain && settings.output.view_radius_deg == 0.0) return {};
  return embedded_bathymetry();
}

void print_summary(const Product& product, const std::vector<std::string>& paths) {
  std::printf("%s\n", report_text(product.report).c_str());
  for (const std::string& path : paths) std::printf("wrote %s\n", path.c_str());
}

}  // namespace

int run_mesh(const Arguments& arguments, const std::atomic<bool>& cancel) {
  const Settings settings = settings_of(arguments);
  const std::string directory =
      arguments.directory.empty() ? settings.output.directory : arguments.directory;
  parallel::Executor exec(arguments.threads > 0 ? arguments.threads : settings.threads);
  ProgressBar bar(arguments.quiet);
  Monitor monitor([&](const Progress& progress) { bar.show(progress); },
                  [&](LogLevel level, const std::string& message) { bar.log(level, message); },
                  &cancel);
  Context context{exec, monitor};

  const Product product = generate(context, settings, {settings.output.needs_dual(), directory});
  OutputContent content = output_content(product, arguments.command_line);
  const std::optional<Raster> coast = coast_to_draw(product);
  content.draw = [&](const std::string& picture, const std::string& path) {
    draw_picture({product.report.title, *product.grid, product.report.quality,
                  coast ? &*coast : product.elevation_m.get(), &settings.output},
                 picture, path);
  };
  const std::vector<std::string> paths = write_outputs(context, content, directory);
  bar.clear();
  if (!arguments.quiet) print_summary(product, paths);
  return kSuccess;
}

}  // namespace delos::app
