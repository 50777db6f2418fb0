// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "lifecycle/convert.hpp"

namespace delos::app {

int run_convert(const Arguments& arguments, const std::atomic<bool>& cancel) {
  const FileKind kind = file_kind_of(arguments.directory, arguments.to);
  parallel::Executor exec(arguments.threads);
  Monitor monitor({}, {}, &cancel);
  Context context{exec, monitor};
  const std::vector<std::string> left_out = convert_grid_file(
      context, {arguments.file, arguments.directory, kind, arguments.command_line});
  std::printf("wrote %s\n", arguments.directory.c_str());
  for (const std::string& what : left_out) {
    std::printf("left out, %s has no place for it: %s\n",
                file_kind_names()[static_cast<std::size_t>(kind)].c_str(), what.c_str());
  }
  return kSuccess;
}

}  // namespace delos::app
