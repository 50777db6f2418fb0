// SPDX-License-Identifier: BSD-3-Clause
#include "app/arguments.hpp"

#include <CLI/CLI.hpp>

#include "app/exit_status.hpp"
#include "lifecycle/version.hpp"

namespace delos::app {
namespace {

void add_mesh(CLI::App& app, Arguments& out, std::vector<std::string>& overrides) {
  CLI::App* const mesh = app.add_subcommand("mesh", "make a grid from a YAML configuration");
  mesh->add_option("CONFIG", out.file, "configuration, e.g. config/world_ocean.yaml")->required();
  mesh->add_option("-o,--output", out.directory, "folder for the files (output.directory)");
  mesh->add_option("--threads", out.threads, "threads; the grid does not depend on it")
      ->check(CLI::Range(0, 4096));
  mesh->add_option("--set", overrides,
                   "key=value in place of the configuration's, e.g. --set 'sizing.clamp.min=60 km'")
      ->allow_extra_args(false);
  mesh->add_flag("--quiet", out.quiet, "print nothing but errors");
  mesh->callback([&out] { out.command = Command::mesh; });
}

void add_reader(CLI::App& app, Arguments& out, Command command, const char* name,
                const char* help) {
  CLI::App* const reader = app.add_subcommand(name, help);
  reader->add_option("FILE", out.file, "an MPAS or UGRID file, or a folder with such files")
      ->required();
  reader->add_option("--threads", out.threads, "threads")->check(CLI::Range(0, 4096));
  if (command == Command::plot) {
    reader->add_option("-o,--output", out.directory, "folder for the pictures")->default_val(".");
  }
  reader->callback([&out, command] { out.command = command; });
}

void split_overrides(const std::vector<std::string>& words, Arguments& out) {
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw CLI::ValidationError("--set", "'" + word +
                                              "' is not key=value, e.g. --set "
                                              "'sizing.clamp.min=60 km'");
    }
    out.overrides.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
}

std::string command_line(int argc, const char* const* argv) {
  std::string out = "delos";
  for (int i = 1; i < argc; ++i) out += std::string(" ") + argv[i];
  return out;
}

}  // namespace

ParseResult parse_arguments(int argc, const char* const* argv, Arguments& out) {
  CLI::App app("delos: variable-resolution Delaunay/Voronoi grids of the sphere and the ellipsoid",
               "delos");
  app.footer(kStatusHelp);
  app.set_version_flag("--version", std::string("delos ") + library_version());
  app.require_subcommand(1);
  std::vector<std::string> overrides;
  add_mesh(app, out, overrides);
  add_reader(app, out, Command::check, "check", "read a grid back and check every identity");
  add_reader(app, out, Command::info, "info", "counts, digest, certificate and origin of a grid");
  add_reader(app, out, Command::plot, "plot", "pictures of a grid");
  out.command_line = command_line(argc, argv);
  try {
    app.parse(argc, argv);
    split_overrides(overrides, out);
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return {false, status == 0 ? kSuccess : kUsage};
  }
  return {true, kSuccess};
}

}  // namespace delos::app
