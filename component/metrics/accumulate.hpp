// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Running extremes and bins that can be merged in block order.
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "core/types.hpp"

namespace delos::metrics {

/// The lowest (or highest) value so far and whose it is; the first of equals stays.
struct Best {
  double value;
  Index id = kNone;
  Index other = kNone;

  static Best lowest() { return {std::numeric_limits<double>::infinity()}; }
  static Best highest() { return {-std::numeric_limits<double>::infinity()}; }
  void keep_lower(const Best& candidate) {
    if (candidate.value < value) *this = candidate;
  }
  void keep_higher(const Best& candidate) {
    if (candidate.value > value) *this = candidate;
  }
};

/// N bins over [lower, upper); the first and the last also take what lies outside.
template <int N>
struct Bins {
  double lower, upper;
  std::array<std::int64_t, N> counts{};

  void add(double value) {
    const double bin = (value - lower) * (N / (upper - lower));
    ++counts[static_cast<std::size_t>(std::clamp(bin, 0.0, N - 1.0))];
  }
  void merge(const Bins& more) {
    for (std::size_t i = 0; i < N; ++i) counts[i] += more.counts[i];
  }
};

}  // namespace delos::metrics
