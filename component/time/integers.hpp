// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Arithmetic of 64-bit integers that says so when it overflows, and rounds down instead of to zero.
#include <cstdint>
#include <string>

namespace delos {

/// a + b; Error(config) when it does not fit 64 bits.
std::int64_t checked_add(std::int64_t a, std::int64_t b);
/// a b; Error(config) when it does not fit 64 bits.
std::int64_t checked_multiply(std::int64_t a, std::int64_t b);

/// The largest integer not above a / b; b > 0.
constexpr std::int64_t floor_divide(std::int64_t a, std::int64_t b) {
  return a / b - (a % b < 0 ? 1 : 0);
}
/// a - b floor_divide(a, b), in [0, b); b > 0.
constexpr std::int64_t floor_modulo(std::int64_t a, std::int64_t b) {
  return a % b + (a % b < 0 ? b : 0);
}

/// Decimal digits, with zeros in front up to this many; the same in every locale.
std::string digits(std::int64_t not_negative, int least);

}  // namespace delos
