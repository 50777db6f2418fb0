// SPDX-License-Identifier: BSD-3-Clause
#include "core/elementary.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

// Each function reduces its argument exactly or in two parts, sums a short Taylor series of the
// reduced argument, and adds the largest part last, so that only the final rounding counts
// (Muller, Elementary Functions, 3rd ed. 2016, chapters 6 and 11).

namespace delos::elementary {
namespace {

/// An unevaluated sum of two doubles.
struct HiLo {
  double hi, lo;
};

/// small - k / 32 large, rounded once, for whole k from 0 to 32, k / 32 being small / large to
/// within 1 / 64. `large` is split in two (Dekker 1971), so that both products are exact; so is the
/// first difference, of two numbers of about the same size.
double remainder(double small, double k, double large) {
  constexpr double kSplitter = 134217729.0;  // 2^27 + 1
  const double c = kSplitter * large;
  const double high = c - (c - large);
  const double low = large - high;
  return (small - k / 32 * high) - k / 32 * low;
}

/// 2^k for -1022 <= k <= 1023.
double power_of_two(int k) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

/// Nearest integer of |x| < 2^51, ties to even.
double nearest(double x) {
  constexpr double kShift = 6755399441055744.0;  // 1.5 * 2^52
  return (x + kShift) - kShift;
}

constexpr HiLo kPiParts = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr HiLo kHalfPi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/// atan(k / 32) in two parts.
constexpr std::array<HiLo, 33> kAtan = {{
    {0x0.0p+0, 0x0.0p+0},
    {0x1.ffd55bba97625p-6, -0x1.5ec431444912cp-60},
    {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
    {0x1.7ee182602f10fp-4, -0x1.cfb654c0c3d98p-58},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.3d6eee8c6626cp-3, 0x1.61a3b0ce9281bp-57},
    {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
    {0x1.b90d7529260a2p-3, 0x1.17b10d2e0e5abp-61},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.18bf5a30bf178p-2, 0x1.30ca4748b1bf9p-57},
    {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
    {0x1.530ad9951cd4ap-2, -0x1.2566480884082p-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.8b24d394a1b25p-2, 0x1.b6d0ba3748fa8p-56},
    {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
    {0x1.c0db4c94ec9f0p-2, -0x1.cc1ce70934c34p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.f40dd0b541418p-2, -0x1.a3992dc382a23p-57},
    {0x1.0657e94db30d0p-1, -0x1.d5b495f6349e6p-56},
    {0x1.1255d9bfbd2a9p-1, -0x1.2bdaee1c0ee35p-58},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.2958e59308e31p-1, -0x1.09e73b0c6c087p-56},
    {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
    {0x1.3f13fb89e96f4p-1, 0x1.ecf8b492644f0p-56},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.538f57b89061fp-1, -0x1.1bb74abda520cp-55},
    {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
    {0x1.66d663923e087p-1, -0x1.6ea6febe8bbbap-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.78f6bbd5d315ep-1, 0x1.406a089803740p-55},
    {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
    {0x1.89ff5ff57f1f8p-1, -0x1.55b9a5e177a1bp-55},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
}};

using detail::atan_tail;

/// atan(small / large) for 0 <= small <= large, large > 0, as a sum of two parts.
HiLo atan_ratio(double small, double large) {
  const double ratio = small / large;
  const double k = nearest(32 * ratio);
  if (k == 0) return {ratio, atan_tail(ratio)};
  // tan(x - y) = (tan x - tan y) / (1 + tan x tan y); the numerator is exact up to one rounding.
  if (large > 0x1p500 || large < 0x1p-500) {
    const double scale = large > 1 ? 0x1p-600 : 0x1p600;
    small *= scale;
    large *= scale;
  }
  const double r = remainder(small, k, large) / (large + k / 32 * small);
  const HiLo& base = kAtan[static_cast<std::size_t>(k)];
  return {base.hi, r + (base.lo + atan_tail(r))};
}

/// c - a, rounded once or little more; |c.hi| >= |a.hi|.
double subtract(const HiLo& c, const HiLo& a) {
  const double hi = c.hi - a.hi;
  const double rest = (c.hi - hi) - a.hi;
  return hi + (rest + (c.lo - a.lo));
}

/// sin(r + low) for |r| <= pi/4 (+ an ulp), low below half an ulp of r.
double sin_reduced(double r, double low) {
  const double z = r * r;
  const double p =
      -1.0 / 6 +
      z * (1.0 / 120 + z * (-1.0 / 5040 +
                            z * (1.0 / 362880 + z * (-1.0 / 39916800 +
                                                     z * (1.0 / 6227020800.0 +
                                                          z * (-1.0 / 1307674368000.0 +
                                                               z * (1.0 / 355687428096000.0)))))));
  return r + (low * (1 - 0.5 * z) + r * z * p);
}

/// cos(r + low), same ranges.
double cos_reduced(double r, double low) {
  const double z = r * r;
  const double p =
      1.0 / 24 +
      z * (-1.0 / 720 +
           z * (1.0 / 40320 +
                z * (-1.0 / 3628800 +
                     z * (1.0 / 479001600 +
                          z * (-1.0 / 87178291200.0 +
                               z * (1.0 / 20922789888000.0 + z * (-1.0 / 6402373705728000.0)))))));
  const double half = 0.5 * z;
  const double head = 1 - half;
  return head + (((1 - head) - half) + (z * z * p - r * low));
}

/// exp(x) = (1 + m) 2^k, m of either sign and |m| < 0.5; -1100 <= x <= 1100.
struct Exponential {
  double m;
  int k;
};
Exponential exponential(double x) {
  constexpr double kInverseLn2 = 0x1.71547652b82fep+0;
  constexpr double kLn2Hi = 0x1.62e42fef00000p-1;  // 33 bits: k * kLn2Hi is exact
  constexpr double kLn2Lo = 0x1.473de6af278edp-34;
  const double k = nearest(x * kInverseLn2);
  const double hi = x - k * kLn2Hi;
  const double lo = k * kLn2Lo;
  const double r = hi - lo;
  const double rest = (hi - r) - lo;
  double p = 1.0 / 87178291200.0;
  for (const double factorial : {6227020800.0, 479001600.0, 39916800.0, 3628800.0, 362880.0,
                                 40320.0, 5040.0, 720.0, 120.0, 24.0, 6.0, 2.0}) {
    p = 1.0 / factorial + r * p;
  }
  return {r + (r * r * p + rest * (1 + r)), static_cast<int>(k)};
}

}  // namespace

double detail::any_atan2(double y, double x) {
  if (x != x || y != y) return x + y;
  double ax = std::abs(x);
  double ay = std::abs(y);
  if (ax == 0 && ay == 0) return 0;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (ax == kInfinity || ay == kInfinity) {
    ax = ax == kInfinity ? 1 : 0;
    ay = ay == kInfinity ? 1 : 0;
  }
  double angle;
  if (ay > ax) {
    HiLo a = atan_ratio(ax, ay);
    if (x < 0) a = {-a.hi, -a.lo};
    angle = subtract(kHalfPi, a);
  } else {
    const HiLo a = atan_ratio(ay, ax);
    angle = x < 0 ? subtract(kPiParts, a) : a.hi + a.lo;
  }
  return y < 0 ? -angle : angle;
}

namespace {

// Angles at a time: the arrays between the steps stay in the nearest cache.
constexpr std::size_t kBatch = 64;

/// What atan2 of a batch knows between its steps.
struct AngleBatch {
  std::array<double, kBatch> small, large, k, hi, lo;
};

/// atan2 of n <= kBatch finite arguments, about 2^-500 to 2^500 in size. Without
/// a branch, so that compilers use vectors; every step is that of atan2 above or changes no bit.
void ordinary_atan2(const double* y, const double* x, double* angle, std::size_t n) {
  AngleBatch b;
  for (std::size_t i = 0; i < n; ++i) {
    const double ax = std::abs(x[i]);
    const double ay = std::abs(y[i]);
    b.small[i] = ax < ay ? ax : ay;
    b.large[i] = ax < ay ? ay : ax;
    b.k[i] = nearest(32 * (b.small[i] / b.large[i]));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const HiLo& base = kAtan[static_cast<std::size_t>(static_cast<int>(b.k[i]))];
    b.hi[i] = base.hi;
    b.lo[i] = base.lo;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double k = b.k[i], small = b.small[i], large = b.large[i];
    const double r = remainder(small, k, large) / (large + k / 32 * small);
    const double tail = atan_tail(r);
    // Small angles are all remainder: (r, tail) then, else (base.hi, r + (base.lo + tail)).
    const double small_angle = (k == 0 ? 1.0 : 0.0) * r;
    b.hi[i] += small_angle;
    b.lo[i] = (r - small_angle) + (b.lo[i] + tail);
  }
  for (std::size_t i = 0; i < n; ++i) {
    // The angle is one of pi/2, pi and 0, less or more that.
    const bool is_steep = std::abs(x[i]) < std::abs(y[i]);
    const double flat_hi = x[i] < 0 ? kPiParts.hi : 0;
    const double flat_lo = x[i] < 0 ? kPiParts.lo : 0;
    const double hi = is_steep ? kHalfPi.hi : flat_hi;
    const double lo = is_steep ? kHalfPi.lo : flat_lo;
    const double steep_sign = x[i] < 0 ? -1 : 1;
    const double sign = is_steep ? steep_sign : -steep_sign;
    const double upper = subtract({hi, lo}, {sign * b.hi[i], sign * b.lo[i]});
    angle[i] = y[i] < 0 ? -upper : upper;
  }
}

bool is_ordinary(double y, double x) {
  const double sum = std::abs(x) + std::abs(y);
  return sum >= 0x1p-500 && sum <= 0x1p500;
}

}  // namespace

void atan2(std::span<const double> y, std::span<const double> x, std::span<double> angle) {
  for (std::size_t begin = 0; begin < angle.size(); begin += kBatch) {
    const std::size_t end = std::min(begin + kBatch, angle.size());
    std::size_t i = begin;
    while (i < end && is_ordinary(y[i], x[i])) ++i;
    if (i == end) {
      ordinary_atan2(y.data() + begin, x.data() + begin, angle.data() + begin, end - begin);
    } else {
      for (i = begin; i < end; ++i) angle[i] = atan2(y[i], x[i]);
    }
  }
}

double asin(double x) {
  if (x != x) return x;
  const double sine = std::clamp(x, -1.0, 1.0);
  return atan2(sine, std::sqrt((1 - sine) * (1 + sine)));
}

double acos(double x) {
  if (x != x) return x;
  const double cosine = std::clamp(x, -1.0, 1.0);
  return atan2(std::sqrt((1 - cosine) * (1 + cosine)), cosine);
}

SinCos sincos(double x) {
  if (!(std::abs(x) < 0x1p1000)) return {x - x, x - x};
  // Cody & Waite 1980: pi/2 in parts of 33, 33 and 53 bits; n has at most 13 bits.
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  constexpr double kPart1 = 0x1.921fb54400000p+0;
  constexpr double kPart2 = 0x1.0b4611a600000p-34;
  constexpr double kPart3 = 0x1.3198a2e037073p-69;
  const double n = nearest(x * kTwoOverPi);
  const double first = x - n * kPart1;
  const double second = n * kPart2;
  // Two-sum: next to a multiple of pi/2 either of the two may be the larger.
  const double hi = first - second;
  const double back = hi - first;
  const double rest = ((first - (hi - back)) - (second + back)) - n * kPart3;
  const double r = hi + rest;
  const double tail = (hi - r) + rest;
  const double s = sin_reduced(r, tail);
  const double c = cos_reduced(r, tail);
  switch (static_cast<int>(static_cast<std::int64_t>(n) & 3)) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double exp(double x) {
  if (x != x) return x;
  if (x > 710) return std::numeric_limits<double>::infinity();
  if (x < -746) return 0;
  const Exponential e = exponential(x);
  // Two factors, so that neither overflows on its own and the result may be subnormal.
  const int half = e.k / 2;
  return (1 + e.m) * power_of_two(half) * power_of_two(e.k - half);
}

double log(double x) {
  if (!(x > 0) || x == std::numeric_limits<double>::infinity()) {
    if (x == 0) return -std::numeric_limits<double>::infinity();
    return x > 0 ? x : std::numeric_limits<double>::quiet_NaN();
  }
  int k = 0;
  if (x < 0x1p-1022) {
    x *= 0x1p54;
    k = -54;
  }
  // x = (1 + f) 2^k with 1 + f in [sqrt(1/2), sqrt(2)); log(1 + f) = 2 artanh(f / (2 + f)),
  // arranged as in fdlibm's e_log.c (Sun Microsystems 1993).
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  constexpr std::uint64_t kSqrtHalf = 0x3FE6A09E667F3BCDULL;
  const std::uint64_t shifted = bits - kSqrtHalf;
  const int exponent = static_cast<int>(static_cast<std::int64_t>(shifted) >> 52);
  const double m = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(exponent) << 52));
  k += exponent;
  const double f = m - 1;
  const double s = f / (2 + f);
  const double z = s * s;
  double series = 0;
  for (int odd = 25; odd >= 3; odd -= 2) series = z * (2.0 / odd + series);
  constexpr double kLn2Hi = 0x1.62e42fef00000p-1;
  constexpr double kLn2Lo = 0x1.473de6af278edp-34;
  const double half_square = 0.5 * f * f;
  return k * kLn2Hi - ((half_square - (s * (half_square + series) + k * kLn2Lo)) - f);
}

double tanh(double x) {
  if (x != x) return x;
  const double ax = std::abs(x);
  if (ax < 0.45) {
    const double z = x * x;
    const double sinh_tail =
        z * (1.0 / 6 +
             z * (1.0 / 120 +
                  z * (1.0 / 5040 + z * (1.0 / 362880 + z * (1.0 / 39916800 + z / 6227020800.0)))));
    const double cosh_tail =
        z * (0.5 + z * (1.0 / 24 +
                        z * (1.0 / 720 +
                             z * (1.0 / 40320 + z * (1.0 / 3628800 +
                                                     z * (1.0 / 479001600 + z / 87178291200.0))))));
    // sinh / cosh - 1 = (sinh_tail - cosh_tail) / (1 + cosh_tail) is small: x is added last.
    return x + x * ((sinh_tail - cosh_tail) / (1 + cosh_tail));
  }
  double t = 1;
  if (ax < 0.55) {
    const Exponential e = exponential(2 * ax);
    const double scale = power_of_two(e.k);
    const double expm1 = scale * e.m + (scale - 1);
    t = expm1 / (expm1 + 2);
  } else if (ax < 20) {
    t = 1 - 2 / (exp(2 * ax) + 1);
  }
  return x < 0 ? -t : t;
}

}  // namespace delos::elementary
