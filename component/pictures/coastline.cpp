// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/coastline.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace delos::pictures {

namespace {

// Finer than a pixel of a 1600-pixel map (0.23 degrees).
constexpr double kStep_deg = 0.125;
constexpr std::ptrdiff_t kRows = 1441;
constexpr std::ptrdiff_t kColumns = 2880;
constexpr double kSea_m = -1.0;
// Metres of rise over one node step that count as a steep slope.
constexpr double kSteep_m = 900.0;

/// Bracket of x on an ascending axis: values[below], values[below + 1] and the weight of the upper.
struct Bracket {
  std::size_t below = 0, above = 0;
  double weight = 0.0;
  bool inside = false;
};

Bracket bracket(const std::vector<double>& axis, double x, bool periodic) {
  const std::size_t n = axis.size();
  const auto upper = std::upper_bound(axis.begin(), axis.end(), x);
  if (upper != axis.begin() && upper != axis.end()) {
    const auto above = static_cast<std::size_t>(upper - axis.begin());
    return {above - 1, above, (x - axis[above - 1]) / (axis[above] - axis[above - 1]), true};
  }
  if (periodic) {
    const double gap = axis.front() + 360.0 - axis.back();
    const double past = x < axis.front() ? x + 360.0 - axis.back() : x - axis.back();
    return {n - 1, 0, gap > 0.0 ? past / gap : 0.0, true};
  }
  // Half a step beyond the ends still belongs to the first and the last column or row.
  const double half = n > 1 ? 0.51 * std::abs(axis[1] - axis[0]) : 180.0;
  const std::size_t end = upper == axis.begin() ? 0 : n - 1;
  return {end, end, 0.0, std::abs(x - axis[end]) <= half};
}

double wrapped(double lon_deg, double first_deg) {
  return lon_deg - 360.0 * std::floor((lon_deg - first_deg) / 360.0);
}

/// Where the value passes zero between two points.
Point zero_between(const Point& a, const Point& b, double value_a, double value_b) {
  const double t = value_a / (value_a - value_b);
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

}  // namespace

LandMask::LandMask(const Raster& elevation)
    : elevation_m_(static_cast<std::size_t>(kRows * kColumns), static_cast<float>(kSea_m)) {
  std::vector<Bracket> columns;
  for (std::ptrdiff_t column = 0; column < kColumns; ++column) {
    const double lon = -180.0 + kStep_deg * static_cast<double>(column);
    columns.push_back(
        bracket(elevation.lon_deg, wrapped(lon, elevation.lon_deg.front()), elevation.periodic));
  }
  const auto value = [&](std::size_t row, std::size_t column) {
    const double v = elevation.values[row * elevation.n_lon() + column];
    return std::isnan(v) ? kSea_m : v;
  };
  for (std::ptrdiff_t row = 0; row < kRows; ++row) {
    const Bracket lat =
        bracket(elevation.lat_deg, -90.0 + kStep_deg * static_cast<double>(row), false);
    for (std::ptrdiff_t column = 0; column < kColumns; ++column) {
      const Bracket& lon = columns[static_cast<std::size_t>(column)];
      if (!lat.inside || !lon.inside) continue;
      const double south = (1.0 - lon.weight) * value(lat.below, lon.below) +
                           lon.weight * value(lat.below, lon.above);
      const double north = (1.0 - lon.weight) * value(lat.above, lon.below) +
                           lon.weight * value(lat.above, lon.above);
      elevation_m_[static_cast<std::size_t>(row * kColumns + column)] =
          static_cast<float>((1.0 - lat.weight) * south + lat.weight * north);
    }
  }
  trace_coastline();
}

double LandMask::node(std::ptrdiff_t row, std::ptrdiff_t column) const {
  const std::ptrdiff_t r = std::clamp<std::ptrdiff_t>(row, 0, kRows - 1);
  const std::ptrdiff_t c = (column % kColumns + kColumns) % kColumns;
  return static_cast<double>(elevation_m_[static_cast<std::size_t>(r * kColumns + c)]);
}

double LandMask::elevation(double lon_deg, double lat_deg) const {
  const double x = (lon_deg + 180.0) / kStep_deg, y = (lat_deg + 90.0) / kStep_deg;
  const double column = std::floor(x), row = std::floor(y);
  const double u = x - column, v = y - row;
  const auto c = static_cast<std::ptrdiff_t>(column), r = static_cast<std::ptrdiff_t>(row);
  return (1.0 - v) * ((1.0 - u) * node(r, c) + u * node(r, c + 1)) +
         v * ((1.0 - u) * node(r + 1, c) + u * node(r + 1, c + 1));
}

double LandMask::shade(double lon_deg, double lat_deg) const {
  const double rise = elevation(lon_deg - kStep_deg, lat_deg + kStep_deg) -
                      elevation(lon_deg + kStep_deg, lat_deg - kStep_deg);
  return 1.0 - 0.16 * std::tanh(rise / kSteep_m);
}

/// Marching triangles: each square of nodes in two triangles, which leaves no ambiguous case.
void LandMask::trace_coastline() {
  for (std::ptrdiff_t row = 0; row + 1 < kRows; ++row) {
    for (std::ptrdiff_t column = 0; column < kColumns; ++column) {
      const std::array<double, 4> value{node(row, column), node(row, column + 1),
                                        node(row + 1, column + 1), node(row + 1, column)};
      const auto n_land =
          std::count_if(value.begin(), value.end(), [](double v) { return v >= 0; });
      if (n_land == 0 || n_land == 4) continue;
      const double x = -180.0 + kStep_deg * static_cast<double>(column);
      const double y = -90.0 + kStep_deg * static_cast<double>(row);
      const std::array<Point, 4> corner{Point{x, y}, Point{x + kStep_deg, y},
                                        Point{x + kStep_deg, y + kStep_deg},
                                        Point{x, y + kStep_deg}};
      for (const auto& [a, b, c] : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
        std::array<Point, 3> crossings;
        std::size_t n = 0;
        for (const auto& [p, q] : {std::array<std::size_t, 2>{a, b}, {b, c}, {c, a}}) {
          if ((value[p] >= 0.0) == (value[q] >= 0.0)) continue;
          crossings[n++] = zero_between(corner[p], corner[q], value[p], value[q]);
        }
        if (n == 2) coastline_.push_back({crossings[0], crossings[1]});
      }
    }
  }
}

}  // namespace delos::pictures
