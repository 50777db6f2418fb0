// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/pictures.hpp"
#include "app/progress_bar.hpp"
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
  content.draw = [&](const std::string& picture, const std::string& path) {
    draw_picture({product.report.title, *product.grid, product.report.quality,
                  product.elevation_m.get(), settings.output.view},
                 picture, path);
  };
  const std::vector<std::string> paths = write_outputs(context, content, directory);
  bar.clear();
  if (!arguments.quiet) print_summary(product, paths);
  return kSuccess;
}

}  // namespace delos::app
