// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/point_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace delos {
namespace {

constexpr int kAxisBits = 16;
constexpr std::uint32_t kAxisCells = 1U << kAxisBits;
constexpr int kKeyBits = 2 * kAxisBits + 3;

/// Position along the Hilbert curve over the 2^16 x 2^16 grid; starts at (0, 0), ends at
/// (2^16 - 1, 0). Two bits a step from the top; `state` is the orientation of the curve in the
/// cell: the usual four, as a table from (state, x bit, y bit) to (next state, two digits).
std::uint32_t hilbert_index(std::uint32_t x, std::uint32_t y) {
  // Row: state. Column: 2 * x bit + y bit. Value: 4 * next state + digit.
  // States: 0 identity, 1 transposed, 2 anti-transposed, 3 turned by 180 degrees.
  static constexpr std::array<std::array<std::uint8_t, 4>, 4> kStep = {{
      {{4 * 1 + 0, 4 * 0 + 1, 4 * 2 + 3, 4 * 0 + 2}},
      {{4 * 0 + 0, 4 * 3 + 3, 4 * 1 + 1, 4 * 1 + 2}},
      {{4 * 2 + 2, 4 * 2 + 1, 4 * 0 + 3, 4 * 3 + 0}},
      {{4 * 3 + 2, 4 * 1 + 3, 4 * 3 + 1, 4 * 2 + 0}},
  }};
  std::uint32_t state = 0;
  std::uint32_t index = 0;
  for (int bit = kAxisBits - 1; bit >= 0; --bit) {
    const std::uint32_t column = 2 * ((x >> bit) & 1U) + ((y >> bit) & 1U);
    const std::uint8_t step = kStep[state][column];
    index = (index << 2) | (step & 3U);
    state = step >> 2;
  }
  return index;
}

/// Cell of t in [-1, 1], stretched so that cells have about equal angles (within 10 %).
std::uint32_t axis_cell(double t) {
  constexpr double kStretch = 1.2732;  // 4 / pi: the slope of 4/pi atan(t) at 0
  const double angle = t * (kStretch - (kStretch - 1) * std::abs(t));
  const double cell = (angle + 1) * (0.5 * kAxisCells);
  return static_cast<std::uint32_t>(std::clamp(cell, 0.0, kAxisCells - 1.0));
}

struct Keyed {
  std::uint64_t key;
  Index id;
};

/// Stable sort by the key, least significant digits first.
void radix_sort(std::vector<Keyed>& items) {
  constexpr int kDigitBits = 12;
  constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
  std::vector<Keyed> other(items.size());
  std::vector<std::size_t> start(kDigits);
  for (int shift = 0; shift < kKeyBits; shift += kDigitBits) {
    std::fill(start.begin(), start.end(), 0);
    const auto digit = [&](const Keyed& item) { return (item.key >> shift) & (kDigits - 1); };
    for (const Keyed& item : items) ++start[digit(item)];
    std::size_t sum = 0;
    for (std::size_t& value : start) sum += std::exchange(value, sum);
    for (const Keyed& item : items) other[start[digit(item)]++] = item;
    items.swap(other);
  }
}

}  // namespace

std::uint64_t hilbert_key(const Vec3& p) {
  const double ax = std::abs(p.x());
  const double ay = std::abs(p.y());
  const double az = std::abs(p.z());
  // Each face's curve starts at the corner where the one before ended, and the last returns to
  // the first: (-,-,-) (+,-,-) (+,-,+) (+,+,+) (-,+,+) (-,+,-).
  std::uint64_t face = 0;
  double u = 0;
  double v = 0;
  if (az >= ax && az >= ay) {
    if (az == 0) return 0;
    face = p.z() > 0 ? 2 : 5;
    u = (p.z() > 0 ? p.y() : -p.y()) / az;
    v = (p.z() > 0 ? -p.x() : p.x()) / az;
  } else if (ax >= ay) {
    face = p.x() > 0 ? 1 : 4;
    u = (p.x() > 0 ? p.z() : -p.z()) / ax;
    v = (p.x() > 0 ? p.y() : -p.y()) / ax;
  } else {
    face = p.y() > 0 ? 3 : 0;
    u = (p.y() > 0 ? -p.x() : p.x()) / ay;
    v = (p.y() > 0 ? -p.z() : p.z()) / ay;
  }
  return face << (2 * kAxisBits) | hilbert_index(axis_cell(u), axis_cell(v));
}

std::vector<Index> hilbert_order(parallel::Executor& exec, std::span<const Vec3> points) {
  constexpr std::int64_t kGrain = 16384;  // keys cost 40 ns: tasks of about a millisecond
  const auto n = static_cast<std::int64_t>(points.size());
  std::vector<Keyed> items(points.size());
  parallel::for_index(exec, n, kGrain, [&](std::int64_t i) {
    const auto slot = static_cast<std::size_t>(i);
    items[slot] = {hilbert_key(points[slot]), static_cast<Index>(i)};
  });
  radix_sort(items);
  std::vector<Index> order(points.size());
  parallel::for_index(exec, n, kGrain, [&](std::int64_t i) {
    order[static_cast<std::size_t>(i)] = items[static_cast<std::size_t>(i)].id;
  });
  return order;
}

}  // namespace delos
