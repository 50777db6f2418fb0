// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What public functions throw.
#include <stdexcept>
#include <string>

#include "delos/export.hpp"

namespace delos::api {

enum class ErrorKind {
  config,     ///< a setting is missing, unknown, of the wrong type or out of range
  input,      ///< an input file or field is missing, damaged or holds unusable values
  output,     ///< an output can't be written
  resource,   ///< the request does not fit memory, disk or 32-bit ids
  state,      ///< a call in the wrong order, or a stale handle
  quality,    ///< a certificate that `require:` asks for is not met
  cancelled,  ///< the caller asked to stop
  internal    ///< a bug in delos
};

/// Name of the kind in lower case, e.g. "config".
DELOS_API const char* to_string(ErrorKind kind);

/// what() says what went wrong (value and unit), where (file, key, id, lon/lat) and what to do.
/// The only exception that leaves a public function, but for std::bad_alloc and what a callback of
/// the host's threw.
class DELOS_API Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message);  ///< of the library, or of a host's callback
  ~Error() override;
  ErrorKind kind() const noexcept { return kind_; }

 private:
  ErrorKind kind_;
};

}  // namespace delos::api

#ifndef DELOS_BUILDING_LIBRARY
namespace delos {
using api::Error;
using api::ErrorKind;
using api::to_string;
}  // namespace delos
#endif
