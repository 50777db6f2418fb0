// SPDX-License-Identifier: BSD-3-Clause
#include "delos/error.hpp"

#include "core/error.hpp"

namespace delos::api {

const char* to_string(ErrorKind kind) {
  return delos::to_string(static_cast<delos::ErrorKind>(kind));
}

Error::Error(ErrorKind kind, const std::string& message)
    : std::runtime_error(message), kind_(kind) {}

// Out of line, so that the type's identity lives in the library alone.
Error::~Error() = default;

}  // namespace delos::api
