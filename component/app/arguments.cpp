// SPDX-License-Identifier: BSD-3-Clause
#include "app/arguments.hpp"

#include <CLI/CLI.hpp>
#include <map>

#include "app/exit_status.hpp"
#include "lifecycle/version.hpp"

namespace delos::app {
namespace {

using Words = std::vector<std::string>;
using Pairs = std::vector<std::pair<std::string, std::string>>;

void add_mesh(CLI::App& app, Arguments& out, Words& overrides) {
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

CLI::App* add_reader(CLI::App& app, Arguments& out, Command command, const char* name,
                     const char* help) {
  CLI::App* const reader = app.add_subcommand(name, help);
  reader->add_option("FILE", out.file, "a grid file of any kind, or a folder with such files")
      ->required();
  reader->add_option("--threads", out.threads, "threads")->check(CLI::Range(0, 4096));
  if (command == Command::plot) {
    // A default_val would be the folder of every command.
    reader->add_option("-o,--output", out.directory, "folder for the pictures (default .)");
  }
  reader->callback([&out, command] { out.command = command; });
  return reader;
}

void add_check(CLI::App& app, Arguments& out, Words& require) {
  add_reader(app, out, Command::check, "check",
             "read a grid back, check every identity and its certificate")
      ->add_option("--require", require,
                   "key=value beside or in place of what the file's configuration requires, e.g. "
                   "--require 'angle_max=85 deg'")
      ->allow_extra_args(false);
}

void add_convert(CLI::App& app, Arguments& out) {
  CLI::App* const convert = app.add_subcommand("convert", "make a grid file of another kind");
  convert->add_option("IN", out.file, "a grid file of any kind")->required();
  convert->add_option("OUT", out.directory, "the new file; a folder for FESOM2")->required();
  convert->add_option(
      "--to", out.to,
      "mpas, ugrid_triangles, ugrid_cells, scrip, esmf, vtu, gmsh, jigsaw or fesom; "
      "else by the ending, e.g. .scrip.nc");
  convert->add_option("--threads", out.threads, "threads")->check(CLI::Range(0, 4096));
  convert->callback([&out] { out.command = Command::convert; });
}

void add_partition(CLI::App& app, Arguments& out) {
  CLI::App* const partition =
      app.add_subcommand("partition", "cut a grid into parts for the processes of a model");
  partition->add_option("GRID", out.file, "a grid file of any kind")->required();
  constexpr std::int64_t kMostParts = 100'000'000;
  partition
      ->add_option("N", out.partitions.n_parts,
                   "numbers of parts; each becomes NAME.graph.info.part.N")
      ->required()
      ->check(CLI::Range(std::int64_t{2}, kMostParts));
  const std::map<std::string, PartitionMethod> methods{{"automatic", PartitionMethod::automatic},
                                                       {"kway", PartitionMethod::kway},
                                                       {"curve", PartitionMethod::curve}};
  partition
      ->add_option("--method", out.partitions.method,
                   "kway (METIS: short borders), curve (pieces of a Hilbert curve), or automatic: "
                   "kway where delos was built with METIS")
      ->transform(CLI::CheckedTransformer(methods));
  partition->add_option("-o,--output", out.directory, "folder for the files (the grid's own)");
  partition->add_option("--threads", out.threads, "threads")->check(CLI::Range(0, 4096));
  partition->callback([&out] { out.command = Command::partition; });
}

void add_remap(CLI::App& app, Arguments& out) {
  CLI::App* const remap =
      app.add_subcommand("remap", "carry fields from the cells of one grid to another's");
  remap->add_option("GRID_FROM", out.file, "the grid file of the fields, of any kind")->required();
  remap->add_option("GRID_TO", out.remap.to, "the grid file to carry them to")->required();
  CLI::Option* const fields =
      remap->add_option("FIELDS", out.remap.fields, "netCDF with float or double on the cells");
  CLI::Option* const made = remap->add_option("OUT", out.remap.out, "the new netCDF file");
  fields->needs(made);
  remap->add_option("--order", out.remap.order, "1: mass kept, bounded; 2: accurate, too (default)")
      ->check(CLI::Range(1, 2));
  remap
      ->add_option("--limiter", out.remap.limiter,
                   "of order 2: gradient (default), assured_sum or none")
      ->check(CLI::IsMember({"gradient", "assured_sum", "none"}));
  remap
      ->add_option(
          "--normalize", out.remap.normalize,
          "of cells covered in part: fracarea (default), the mean of that part, or destarea")
      ->check(CLI::IsMember({"fracarea", "destarea"}));
  remap->add_option("--weights", out.remap.weights,
                    "write the weights, without limiter, as ESMF does");
  remap->add_option("--dimension", out.remap.dimension, "of the cells in FIELDS (default nCells)");
  remap->add_option("--threads", out.threads, "threads; the values do not depend on it")
      ->check(CLI::Range(0, 4096));
  remap->callback([&out] { out.command = Command::remap; });
}

Pairs split(const Words& words, const char* option, const char* example) {
  Pairs out;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw CLI::ValidationError(
          option, "'" + word + "' is not key=value, e.g. " + option + " '" + example + "'");
    }
    out.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return out;
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
  Words overrides, require;
  add_mesh(app, out, overrides);
  add_check(app, out, require);
  add_convert(app, out);
  add_partition(app, out);
  add_remap(app, out);
  add_reader(app, out, Command::info, "info", "counts, digest, certificate and origin of a grid");
  add_reader(app, out, Command::plot, "plot", "pictures of a grid");
  out.command_line = command_line(argc, argv);
  try {
    app.parse(argc, argv);
    out.overrides = split(overrides, "--set", "sizing.clamp.min=60 km");
    out.require = split(require, "--require", "angle_max=85 deg");
  } catch (const CLI::ParseError& error) {
    const int status = app.exit(error);
    return {false, status == 0 ? kSuccess : kUsage};
  }
  return {true, kSuccess};
}

}  // namespace delos::app
