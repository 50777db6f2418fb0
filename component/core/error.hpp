// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How delos says that something is wrong: Error (the user's or the machine's fault, thrown by
// DELOS_CHECK) and DELOS_ASSERT (our own fault, on in debug and CI builds).
#include <sstream>
#include <stdexcept>
#include <string>

namespace delos {

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
const char* to_string(ErrorKind kind);

/// What went wrong (value and unit), where (file, YAML path, id, lon/lat), what to do.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

/// Joins the parts into one string; numbers with up to 10 significant digits.
template <class... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  out.precision(10);
  (out << ... << parts);
  return out.str();
}

[[noreturn]] void assertion_failed(const char* condition, const char* file, int line);

}  // namespace delos

/// Throws Error(kind, text(...)) unless the condition holds. Always on.
#define DELOS_CHECK(condition, kind, ...)                                     \
  do {                                                                        \
    if (!(condition)) throw ::delos::Error(kind, ::delos::text(__VA_ARGS__)); \
  } while (false)

/// Throws Error(internal) when an invariant of ours is broken; compiled out of release builds.
#ifdef DELOS_ENABLE_ASSERTS
#define DELOS_ASSERT(condition)                                                  \
  do {                                                                           \
    if (!(condition)) ::delos::assertion_failed(#condition, __FILE__, __LINE__); \
  } while (false)
#else
#define DELOS_ASSERT(condition) static_cast<void>(0)
#endif
