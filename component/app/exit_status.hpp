// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/error.hpp"

namespace delos::app {

inline constexpr int kSuccess = 0;
inline constexpr int kDefects = 1;  ///< `check` found defects
inline constexpr int kUsage = 2;    ///< the command line is wrong
inline constexpr int kCancelled = 130;

inline constexpr char kStatusHelp[] =
    "Exit status: 0 done, 1 check found defects, 2 wrong command line, 3 configuration, 4 input "
    "file, 5 output, 6 too large for memory, disk or 32-bit ids, 7 a `require:` is not met, 8 "
    "wrong "
    "order of calls, 70 a bug in delos, 130 stopped by Ctrl-C.";

constexpr int exit_status(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::config:
      return 3;
    case ErrorKind::input:
      return 4;
    case ErrorKind::output:
      return 5;
    case ErrorKind::resource:
      return 6;
    case ErrorKind::quality:
      return 7;
    case ErrorKind::state:
      return 8;
    case ErrorKind::cancelled:
      return kCancelled;
    case ErrorKind::internal:
      break;
  }
  return 70;
}

}  // namespace delos::app
