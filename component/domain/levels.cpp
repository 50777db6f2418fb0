// SPDX-License-Identifier: BSD-3-Clause
#include "domain/levels.hpp"

#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"
#include "core/error.hpp"

namespace delos::domain {
namespace {

constexpr double kWidth = 0.2;  // of the transition: most of it within two fifths of the layers
constexpr double kFirstCentre = -0.5, kLastCentre = 1.5;  // beyond them S hardly changes

double rise(double x, double centre) {
  const double at_top = elementary::tanh(centre / kWidth);
  return (elementary::tanh((x - centre) / kWidth) + at_top) /
         (elementary::tanh((1.0 - centre) / kWidth) + at_top);
}

std::vector<double> interfaces(const Stretching& shape, double centre) {
  std::vector<double> out{0.0};
  for (std::int64_t k = 0; k < shape.n_levels; ++k) {
    const double x = static_cast<double>(k) / static_cast<double>(shape.n_levels - 1);
    out.push_back(out.back() + shape.top_m + (shape.bottom_m - shape.top_m) * rise(x, centre));
  }
  return out;
}

}  // namespace

Stretching ocean_60() { return {60, 5500.0, 10.0, 250.0}; }
Stretching ocean_80() { return {80, 6000.0, 10.0, 200.0}; }

Levels listed_levels(std::span<const double> interface_m) {
  Levels out;
  if (interface_m.empty() || interface_m[0] != 0.0) out.interface_m.push_back(0.0);
  for (const double depth_m : interface_m) {
    DELOS_CHECK(out.interface_m.empty() || depth_m > out.interface_m.back(), ErrorKind::config,
                "the interface at ", depth_m, " m follows one at ", out.interface_m.back(),
                " m: give depths below the surface in metres, each larger than the one before.");
    out.interface_m.push_back(depth_m);
  }
  DELOS_CHECK(out.n_levels() >= 1, ErrorKind::config,
              "there is no interface below the surface: give one depth at least.");
  return out;
}

Levels uniform_levels(std::int64_t n_levels, double depth_m) {
  DELOS_CHECK(n_levels >= 1 && depth_m > 0.0, ErrorKind::config, n_levels, " levels of ", depth_m,
              " m: there must be one at least, and the depth > 0 m.");
  Levels out;
  for (std::int64_t k = 0; k <= n_levels; ++k) {
    out.interface_m.push_back(depth_m * static_cast<double>(k) / static_cast<double>(n_levels));
  }
  return out;
}

Levels stretched_levels(const Stretching& shape) {
  DELOS_CHECK(shape.n_levels >= 2 && shape.top_m > 0.0 && shape.bottom_m > 0.0, ErrorKind::config,
              shape.n_levels, " levels from ", shape.top_m, " to ", shape.bottom_m,
              " m: there must be two at least, and thicknesses > 0 m.");
  const auto depth_of = [&](double centre) { return interfaces(shape, centre).back(); };
  // The later the rise, the nearer the layers stay to the first.
  double low = kFirstCentre, high = kLastCentre;
  if (shape.bottom_m < shape.top_m) std::swap(low, high);
  const double deepest_m = depth_of(low), shallowest_m = depth_of(high);
  constexpr double kRounding = 1e-9;
  DELOS_CHECK(shape.depth_m <= deepest_m * (1.0 + kRounding) &&
                  shape.depth_m >= shallowest_m * (1.0 - kRounding),
              ErrorKind::config, shape.n_levels, " layers of ", shape.top_m, " to ", shape.bottom_m,
              " m reach ", std::round(shallowest_m), " to ", std::round(deepest_m), " m, not ",
              shape.depth_m, " m: change their number or a thickness.");
  constexpr int kHalvings = 60;  // to the last bits of the centre
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (depth_of(middle) > shape.depth_m ? low : high) = middle;
  }
  Levels out{interfaces(shape, 0.5 * (low + high))};
  const double scale = shape.depth_m / out.depth_m();
  for (double& depth_m : out.interface_m) depth_m *= scale;
  out.interface_m.back() = shape.depth_m;
  return out;
}

}  // namespace delos::domain
