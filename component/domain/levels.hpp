// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where the layers of a deep enough ocean lie.
#include <cstdint>
#include <span>
#include <vector>

namespace delos::domain {

/// Interfaces in metres below the surface: [n_levels + 1], 0 first, strictly ascending.
struct Levels {
  std::vector<double> interface_m;

  std::int64_t n_levels() const { return static_cast<std::int64_t>(interface_m.size()) - 1; }
  double top_m(std::int64_t k) const { return interface_m[static_cast<std::size_t>(k)]; }
  double bottom_m(std::int64_t k) const { return interface_m[static_cast<std::size_t>(k) + 1]; }
  double thickness_m(std::int64_t k) const { return bottom_m(k) - top_m(k); }
  double middle_m(std::int64_t k) const { return 0.5 * (top_m(k) + bottom_m(k)); }
  double depth_m() const { return interface_m.back(); }
};

/// Layers that grow from thin ones below the surface to thick ones above the floor.
struct Stretching {
  std::int64_t n_levels = 60;
  double depth_m = 5500.0;  ///< of the lowest interface
  double top_m = 10.0;      ///< thickness of the first layer
  double bottom_m = 250.0;  ///< of the last
};

/// 60 layers of 10 to 250 m over 5500 m, and 80 of 10 to 200 m over 6000 m: the shapes of many
/// global ocean models.
Stretching ocean_60();
Stretching ocean_80();

/// The interfaces as given, 0 first or left out. Error(config) unless there is one below 0 and each
/// is deeper than the one before.
Levels listed_levels(std::span<const double> interface_m);

/// Layers of one thickness. Error(config) unless there is at least one and the depth is > 0.
Levels uniform_levels(std::int64_t n_levels, double depth_m);

/// Layer k of n has the thickness top + (bottom - top) S(k / (n - 1)), where
///   S(x) = (tanh((x - c) / w) + tanh(c / w)) / (tanh((1 - c) / w) + tanh(c / w)), w = 1/5,
/// goes from 0 to 1, steepest at x = c, and c is such that the layers sum to the depth (by
/// bisection; the rest, a rounding, is shared out in proportion). Increasing when bottom > top.
/// Error(config), with the depths that can be had, when no c in [-1/2, 3/2] does.
Levels stretched_levels(const Stretching& shape);

}  // namespace delos::domain
