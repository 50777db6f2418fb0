// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/colour_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace delos::pictures;

namespace {

double linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Lightness of Oklab, by the inverse of the transform that the map uses.
double lightness(const Colour& c) {
  const double r = linear(c.r), g = linear(c.g), b = linear(c.b);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
}

}  // namespace

TEST_CASE("lightness rises in even steps along the colour map: no colour is clipped") {
  const ColourMap map;
  const double first = lightness(map(0.0)), last = lightness(map(1.0));
  CHECK(last - first > 0.5);
  for (int i = 1; i <= 100; ++i) {
    const double step = lightness(map(0.01 * i)) - lightness(map(0.01 * (i - 1)));
    CHECK(step == doctest::Approx((last - first) / 100).epsilon(0.02));
  }
}

TEST_CASE("positions off the ends of the colour map take the end's colour") {
  const ColourMap map;
  CHECK(map(-3.0).r == map(0.0).r);
  CHECK(map(7.0).g == map(1.0).g);
}

TEST_CASE("a scale keeps the order of sizes and covers all but the outliers") {
  std::vector<double> sizes;
  for (int i = 0; i <= 1000; ++i) sizes.push_back(30.0 * std::pow(8.0, i / 1000.0));
  sizes.push_back(0.001);  // one outlier must not stretch the scale
  const SizeScale scale(sizes);
  CHECK(scale.is_logarithmic());
  CHECK(scale.low_km() > 25.0);
  CHECK(scale.low_km() <= 30.1);
  CHECK(scale.high_km() >= 238.0);
  CHECK(scale.high_km() < 250.0);
  double before = -1.0;
  for (double size = 31.0; size < 239.0; size += 1.0) {
    CHECK(scale.fraction(size) > before);
    before = scale.fraction(size);
  }
  CHECK(scale.fraction(scale.low_km()) == 0.0);
  CHECK(scale.fraction(scale.high_km()) == 1.0);
}

TEST_CASE("a uniform grid looks uniform: its scale is no narrower than a tenth to either side") {
  const std::vector<double> sizes{59.9, 60.0, 60.0, 60.1};
  const SizeScale scale(sizes);
  CHECK_FALSE(scale.is_logarithmic());
  CHECK(scale.low_km() <= 54.0);
  CHECK(scale.high_km() >= 66.0);
  CHECK(std::abs(scale.fraction(59.9) - scale.fraction(60.1)) < 0.02);
}

TEST_CASE("ticks are round, ascending, inside the scale and neither too few nor too many") {
  for (const auto& range : {std::pair{54.0, 66.0}, {30.0, 240.0}, {1.0, 1000.0}, {0.2, 0.3}}) {
    const double low = range.first;  // clang++ 14 lets no lambda, as in CAPTURE, use a binding
    const double high = range.second;
    const SizeScale scale(std::vector<double>{low, std::sqrt(low * high), high});
    const auto ticks = scale.ticks_km();
    CAPTURE(low);
    CHECK(ticks.size() >= 3);
    CHECK(ticks.size() <= 25);
    CHECK(std::is_sorted(ticks.begin(), ticks.end()));
    CHECK(ticks.front() >= scale.low_km() * 0.998);
    CHECK(ticks.back() <= scale.high_km() * 1.002);
  }
  CHECK(round_ticks(0.0, 10.0, 5) == std::vector<double>{0, 2, 4, 6, 8, 10});
  CHECK(round_ticks(-1.0, 1.0, 4) == std::vector<double>{-1, -0.5, 0, 0.5, 1});
}

TEST_CASE("numbers are written short, counts in groups of three") {
  CHECK(short_number(60.0) == "60");
  CHECK(short_number(2.5) == "2.5");
  CHECK(grouped(7) == "7");
  CHECK(grouped(1234) == "1 234");
  CHECK(grouped(163842) == "163 842");
  CHECK(grouped(1000000) == "1 000 000");
}
