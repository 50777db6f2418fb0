// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <exception>
#include <new>

#include "app/arguments.hpp"
#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/interrupt.hpp"

namespace {

using delos::app::Arguments;
using delos::app::Command;

int run(const Arguments& arguments) {
  const std::atomic<bool>& cancel = delos::app::watch_for_interrupt();
  switch (arguments.command) {
    case Command::mesh:
      return run_mesh(arguments, cancel);
    case Command::check:
      return run_check(arguments, cancel);
    case Command::info:
      return run_info(arguments);
    case Command::convert:
      return run_convert(arguments, cancel);
    case Command::partition:
      return run_partition(arguments, cancel);
    case Command::remap:
      return run_remap(arguments, cancel);
    case Command::plot:
      return run_plot(arguments, cancel);
  }
  return delos::app::kUsage;
}

int fail(int status, const char* message) {
  std::fprintf(stderr, "delos: error: %s\n", message);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Arguments arguments;
    const auto parsed = delos::app::parse_arguments(argc, argv, arguments);
    return parsed.go_on ? run(arguments) : parsed.status;
  } catch (const delos::Error& error) {
    return fail(delos::app::exit_status(error.kind()), error.what());
  } catch (const std::bad_alloc&) {
    return fail(delos::app::exit_status(delos::ErrorKind::resource),
                "out of memory. Use a larger spacing or fewer cells.");
  } catch (const std::exception& error) {
    return fail(delos::app::exit_status(delos::ErrorKind::internal), error.what());
  }
}
