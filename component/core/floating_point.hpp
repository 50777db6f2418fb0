// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The floating-point environment that all results are promised for, whatever the host's is.
#include <cfenv>

namespace delos {

/// While it lives the calling thread rounds to nearest, keeps subnormal numbers and traps nothing,
/// as a fresh process does; then the host has its own environment back, its exception flags too.
/// Hosts do have another: Fortran models trap (-ffpe-trap) and flush to zero (-Ofast).
class DefaultFloatingPoint {
 public:
  DefaultFloatingPoint() {
    std::fegetenv(&of_host_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatingPoint() { std::fesetenv(&of_host_); }
  DefaultFloatingPoint(const DefaultFloatingPoint&) = delete;
  DefaultFloatingPoint& operator=(const DefaultFloatingPoint&) = delete;

 private:
  std::fenv_t of_host_{};
};

}  // namespace delos
