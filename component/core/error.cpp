// SPDX-License-Identifier: BSD-3-Clause
#include "core/error.hpp"

namespace delos {

const char* to_string(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::config:
      return "config";
    case ErrorKind::input:
      return "input";
    case ErrorKind::output:
      return "output";
    case ErrorKind::resource:
      return "resource";
    case ErrorKind::state:
      return "state";
    case ErrorKind::quality:
      return "quality";
    case ErrorKind::cancelled:
      return "cancelled";
    case ErrorKind::internal:
      return "internal";
  }
  return "unknown";
}

void assertion_failed(const char* condition, const char* file, int line) {
  throw Error(ErrorKind::internal,
              text("delos has a bug: ", condition, " does not hold at ", file, ":", line,
                   ". Please report it with the configuration that led here."));
}

}  // namespace delos
