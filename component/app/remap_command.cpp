// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "io/names.hpp"
#include "lifecycle/remap_files.hpp"

namespace delos::app {
namespace {

remap::Limiter limiter_named(const std::string& name) {
  if (name == "none") return remap::Limiter::none;
  return name == "assured_sum" ? remap::Limiter::assured_sum : remap::Limiter::gradient;
}

void print_names(const char* what, const std::vector<std::string>& names) {
  if (!names.empty()) std::printf("%-9s %s\n", what, join_names(names).c_str());
}

}  // namespace

int run_remap(const Arguments& arguments, const std::atomic<bool>& cancel) {
  FieldRemap task;
  task.from = arguments.file;
  task.to = arguments.remap.to;
  task.fields = arguments.remap.fields;
  task.out = arguments.remap.out;
  task.weights = arguments.remap.weights;
  task.dimension = arguments.remap.dimension;
  task.options = {arguments.remap.order == 1 ? remap::Order::first : remap::Order::second,
                  limiter_named(arguments.remap.limiter)};
  task.options.normalization = arguments.remap.normalize == "destarea"
                                   ? remap::Normalization::whole
                                   : remap::Normalization::covered;
  task.command = arguments.command_line;
  parallel::Executor exec(arguments.threads);
  Monitor monitor({}, {}, &cancel);
  Context context{exec, monitor};
  const RemapReport report = remap_files(context, task);
  print_names("carried", report.carried);
  print_names("copied", report.copied);
  print_names("left out", report.left_out);
  if (report.n_unmapped > 0) {
    std::printf("unmapped  %lld cells, which no cell of %s covers\n",
                static_cast<long long>(report.n_unmapped), task.from.c_str());
  }
  for (const std::string& path : {task.out, task.weights}) {
    if (!path.empty()) std::printf("wrote %s\n", path.c_str());
  }
  return kSuccess;
}

}  // namespace delos::app
