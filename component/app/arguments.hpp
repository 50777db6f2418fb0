// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the command line asks for.
#include <string>
#include <utility>
#include <vector>

#include "lifecycle/partitions.hpp"

namespace delos::app {

enum class Command { mesh, check, convert, partition, remap, info, plot };

/// Of `remap` beside a grid file and the new file.
struct RemapArguments {
  std::string to, fields;  ///< the other grid file; the fields, or empty
  std::string out;         ///< the new file, or empty
  std::string weights;     ///< a file of weights to write, or empty
  std::string dimension = "nCells";
  std::string limiter = "gradient";    ///< or none, assured_sum
  std::string normalize = "fracarea";  ///< or destarea
  int order = 2;
};

struct Arguments {
  Command command = Command::mesh;
  std::string file;            ///< configuration (mesh) or grid (remap: of the fields)
  std::string directory;       ///< -o; empty: what the configuration says; convert: the new file
  std::string to;              ///< convert: the kind of the new file; empty: by its ending
  PartitionWishes partitions;  ///< partition
  RemapArguments remap;
  int threads = 0;  ///< 0: what the configuration says
  bool quiet = false;
  std::vector<std::pair<std::string, std::string>> overrides;  ///< --set key=value
  std::vector<std::pair<std::string, std::string>> require;    ///< --require key=value
  std::string command_line;                                    ///< for the files' history
};

/// Outcome of parsing: go on, or end with this status (help was printed, or the words were wrong).
struct ParseResult {
  bool go_on = false;
  int status = 0;
};

ParseResult parse_arguments(int argc, const char* const* argv, Arguments& out);

}  // namespace delos::app
