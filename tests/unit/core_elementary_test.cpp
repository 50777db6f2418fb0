// SPDX-License-Identifier: BSD-3-Clause
#include "core/elementary.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/hash.hpp"
#include "core/types.hpp"

using namespace delos;

namespace {

/// |got - want| in units of the last place of want.
double ulps(double got, long double want) {
  if (static_cast<long double>(got) == want) return 0;
  const double rounded = static_cast<double>(want);
  const double next = std::nextafter(std::abs(rounded), std::numeric_limits<double>::infinity());
  const long double ulp = static_cast<long double>(next) - std::abs(rounded);
  return static_cast<double>(std::abs(static_cast<long double>(got) - want) / ulp);
}

// The x87 long double functions of the C library carry 11 more bits.
using Function = double (*)(double);
using Reference = long double (*)(long double);

/// Largest error over n points spread evenly, n random ones, and powers of ten down to tiny ones.
double worst(Function function, Reference reference, double low, double high, int n) {
  double worst = 0;
  const auto look = [&](double x) {
    if (x < low || x > high) return;
    worst = std::max(worst, ulps(function(x), reference(static_cast<long double>(x))));
  };
  for (int i = 0; i <= n; ++i) {
    look(low + (high - low) * i / n);
    look(low + (high - low) * uniform01(7, static_cast<std::uint64_t>(i)));
    const double tiny = std::pow(10.0, -300.0 * uniform01(8, static_cast<std::uint64_t>(i)));
    look(tiny);
    look(-tiny);
  }
  return worst;
}

}  // namespace

TEST_CASE("atan2 is within two ulps for ordinary, tiny and huge ratios in all quadrants") {
  double error = 0;
  for (std::uint64_t i = 0; i < 400000; ++i) {
    const double range = i % 3 == 0 ? 2.0 : (i % 3 == 1 ? 40.0 : 600.0);
    const double x = (uniform01(1, i) - 0.5) * std::exp2(range * (uniform01(2, i) - 0.5));
    const double y = (uniform01(3, i) - 0.5) * std::exp2(range * (uniform01(4, i) - 0.5));
    const long double want = atan2l(static_cast<long double>(y), static_cast<long double>(x));
    error = std::max(error, ulps(elementary::atan2(y, x), want));
  }
  for (int i = -5000; i <= 5000; ++i) {
    const double t = i / 5000.0;
    for (const double sign : {1.0, -1.0}) {
      error = std::max(error, ulps(elementary::atan2(t, sign), atan2l(t, sign)));
      error = std::max(error, ulps(elementary::atan2(sign, t), atan2l(sign, t)));
    }
  }
  CHECK(error <= 1.5);
}

TEST_CASE("atan2 keeps its range at the axes, at zero and at the largest doubles") {
  CHECK(elementary::atan2(0, 0) == 0);
  CHECK(elementary::atan2(0, 1) == 0);
  CHECK(elementary::atan2(0, -1) == kPi);
  CHECK(elementary::atan2(-0.0, -1) == kPi);
  CHECK(elementary::atan2(1, 0) == kPi / 2);
  CHECK(elementary::atan2(-1, 0) == -kPi / 2);
  CHECK(elementary::atan2(1e308, 1e308) == kPi / 4);
  CHECK(elementary::atan2(5e-324, 5e-324) == kPi / 4);
  CHECK(elementary::atan2(5e-324, -1e308) == kPi);
  CHECK(elementary::atan2(std::numeric_limits<double>::infinity(), 1) == kPi / 2);
  CHECK(std::isnan(elementary::atan2(std::nan(""), 1)));
}

TEST_CASE("atan2 of many arguments has the bits of one at a time") {
  constexpr std::size_t kLength = 64 * 50 + 13;     // no whole number of batches
  for (const double range : {2.0, 40.0, 2000.0}) {  // the last one leaves the ordinary numbers
    std::vector<double> y(kLength), x(kLength), angle(kLength);
    for (std::size_t i = 0; i < kLength; ++i) {
      x[i] = (uniform01(1, i) - 0.5) * std::exp2(range * (uniform01(2, i) - 0.5));
      y[i] = (uniform01(3, i) - 0.5) * std::exp2(range * (uniform01(4, i) - 0.5));
      if (i % 17 == 3) x[i] = 0.0;
      if (i % 19 == 5) y[i] = -0.0;
      if (i % 23 == 7) x[i] = -std::abs(y[i]);
    }
    elementary::atan2(y, x, angle);
    std::size_t n_different = 0;
    for (std::size_t i = 0; i < kLength; ++i) {
      n_different += std::bit_cast<std::uint64_t>(angle[i]) !=
                     std::bit_cast<std::uint64_t>(elementary::atan2(y[i], x[i]));
    }
    CAPTURE(range);
    CHECK(n_different == 0);
  }
}

TEST_CASE("asin and acos are within two ulps and clamp their argument") {
  CHECK(worst(elementary::asin, asinl, -1, 1, 100000) <= 2.0);
  CHECK(worst(elementary::acos, acosl, -1, 1, 100000) <= 2.0);
  CHECK(elementary::acos(1 + 1e-15) == 0);
  CHECK(elementary::asin(-2) == -kPi / 2);
}

TEST_CASE("sine and cosine are within one ulp, also next to multiples of pi/2") {
  CHECK(worst(elementary::sin, sinl, -7, 7, 200000) <= 1.0);
  CHECK(worst(elementary::cos, cosl, -7, 7, 200000) <= 1.0);
  CHECK(worst(elementary::sin, sinl, -1e4, 1e4, 200000) <= 1.0);
  CHECK(worst(elementary::cos, cosl, -1e4, 1e4, 200000) <= 1.0);
  double error = 0;
  for (int n = -6000; n <= 6000; ++n) {
    double x = n * (kPi / 2);
    for (int step = 0; step < 3; ++step, x = std::nextafter(x, 1e5)) {
      // long double argument reduction of the x87 libm is exact here.
      error = std::max(error, ulps(elementary::sin(x), sinl(static_cast<long double>(x))));
      error = std::max(error, ulps(elementary::cos(x), cosl(static_cast<long double>(x))));
    }
  }
  CHECK(error <= 1.0);
}

TEST_CASE("exp is within two ulps from overflow to underflow") {
  CHECK(worst(elementary::exp, expl, -1, 1, 100000) <= 1.0);
  CHECK(worst(elementary::exp, expl, -708, 709, 200000) <= 1.0);
  CHECK(elementary::exp(0) == 1);
  CHECK(std::isinf(elementary::exp(709.8)));
  CHECK(elementary::exp(-745) == 5e-324);
  CHECK(elementary::exp(-800) == 0);
}

TEST_CASE("log is within two ulps, also next to 1 and for subnormal arguments") {
  CHECK(worst(elementary::log, logl, 0.5, 2, 200000) <= 1.0);
  CHECK(worst(elementary::log, logl, 1 - 1e-6, 1 + 1e-6, 100000) <= 1.0);
  CHECK(worst(elementary::log, logl, 1e-300, 1e9, 100000) <= 1.0);
  CHECK(ulps(elementary::log(5e-324), logl(static_cast<long double>(5e-324))) <= 1.0);
  CHECK(elementary::log(1) == 0);
  CHECK(std::isinf(elementary::log(0)));
  CHECK(std::isnan(elementary::log(-1)));
}

TEST_CASE("tanh is within two ulps and saturates at one") {
  CHECK(worst(elementary::tanh, tanhl, -1, 1, 200000) <= 2.0);
  CHECK(worst(elementary::tanh, tanhl, -30, 30, 200000) <= 2.0);
  CHECK(elementary::tanh(1000) == 1);
  CHECK(elementary::tanh(-1000) == -1);
}
