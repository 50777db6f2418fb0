// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which colour a cell size gets, and the bar that says so.
#include <array>
#include <span>
#include <string>
#include <vector>

#include "pictures/canvas.hpp"

namespace delos::pictures {

/// Perceptually even: lightness rises in a straight line from dark violet over blue and green to
/// yellow, in Oklab (B. Ottosson 2020), inside sRGB all the way.
class ColourMap {
 public:
  ColourMap();
  /// `t` in [0, 1], clamped; 0 is dark.
  Colour operator()(double t) const;

 private:
  static constexpr std::size_t kSteps = 256;
  std::array<Colour, kSteps> table_;
};

/// Cell size in km -> position on the colour map; the smallest cells are light. Logarithmic when
/// the largest is more than three times the smallest.
class SizeScale {
 public:
  /// Range from the 0.2 % to the 99.8 % quantile, never narrower than +-10 % of the median (so
  /// that a uniform grid looks uniform), widened to round numbers. `sizes_km` must not be empty.
  explicit SizeScale(std::span<const double> sizes_km);
  double low_km() const { return low_km_; }
  double high_km() const { return high_km_; }
  bool is_logarithmic() const { return is_logarithmic_; }
  /// 0 at low_km, 1 at high_km.
  double fraction(double size_km) const;
  Colour colour(double size_km) const { return map_(1.0 - fraction(size_km)); }
  /// Round sizes inside the range, ascending.
  std::vector<double> ticks_km() const;

 private:
  double low_km_ = 0.0, high_km_ = 0.0;
  bool is_logarithmic_ = false;
  ColourMap map_;
};

/// About `wanted` round numbers (1, 2, 2.5 or 5 times a power of ten) in [low, high].
std::vector<double> round_ticks(double low, double high, int wanted);

/// "60", "2.5": without needless zeros.
std::string short_number(double value);

/// "163 842"
std::string grouped(long long value);

/// The scale as an upright or level bar with ticks and the caption "cell size (km)".
void draw_colour_bar(Canvas& canvas, const SizeScale& scale, const Box& box);

}  // namespace delos::pictures
