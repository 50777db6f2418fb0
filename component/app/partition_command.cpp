// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/loaded_grid.hpp"
#include "io/atomic_file.hpp"
#include "io/mpas.hpp"
#include "io/part_file.hpp"
#include "lifecycle/partitions.hpp"

namespace delos::app {
namespace {

namespace fs = std::filesystem;

/// What goes before ".graph.info.part.N": the name without what tells the kind of the file.
std::string name_of(fs::path grid) {
  if (!grid.has_filename()) grid = grid.parent_path();  // a folder written with a last slash
  const std::string name = grid.filename().string();
  for (const std::string& kind : file_endings()) {
    const std::string ending = "." + kind;
    if (name.size() > ending.size() && name.ends_with(ending)) {
      return name.substr(0, name.size() - ending.size());
    }
  }
  return grid.stem().string();
}

/// The layers of each cell where the file has them, else nothing.
std::vector<double> weights_of(const GridFile& file) {
  if (file.origin.format != "MPAS") return {};
  const std::vector<Index> n_layers = read_mpas_layers(file.path);
  return {n_layers.begin(), n_layers.end()};
}

}  // namespace

int run_partition(const Arguments& arguments, const std::atomic<bool>& cancel) {
  PartitionWishes wishes = arguments.partitions;
  std::sort(wishes.n_parts.begin(), wishes.n_parts.end());
  wishes.n_parts.erase(std::unique(wishes.n_parts.begin(), wishes.n_parts.end()),
                       wishes.n_parts.end());
  parallel::Executor exec(arguments.threads);
  Monitor monitor({}, {}, &cancel);
  Context context{exec, monitor};
  const LoadedGrid loaded = load_grid(context, arguments.file);
  const std::vector<double> weight = weights_of(loaded.file);
  const auto partitions = make_partitions(context, loaded.grid, wishes, weight);
  const fs::path folder = arguments.directory.empty() ? fs::path(arguments.file).parent_path()
                                                      : fs::path(arguments.directory);
  OutputSet files;
  std::string summary;
  for (const GridPartition& made : partitions) {
    const fs::path path =
        folder / text(name_of(arguments.file), ".", part_file_ending(made.n_parts));
    files.add(path, 0, [&](const std::string& out) { write_parts(out, made.part_of_cell); });
    summary += text("wrote ", path.string(), "\n  ", describe(made), "\n");
  }
  files.commit();
  std::printf("%s", summary.c_str());
  return kSuccess;
}

}  // namespace delos::app
