// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Elementary functions from + - * / and sqrt alone, so that their bits do not depend on the C
// library: these, never <cmath>, on the path from configuration to grid. Accuracy: within
// 2 units in the last place of the true value over the ranges given (a test checks it against
// long double libm). NaN in, NaN out.
#include <cmath>
#include <span>

namespace delos::elementary {

namespace detail {
double any_atan2(double y, double x);
/// atan(r) - r for |r| <= 1/62; the first term left out is below 2^-61 r.
inline double atan_tail(double r) {
  const double z = r * r;
  return r * z * (-1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7 + z * (1.0 / 9))));
}
}  // namespace detail

/// Angle of (x, y) in (-pi, pi]; atan2(0, 0) = 0. Small angles keep full relative accuracy.
inline double atan2(double y, double x) {
  // The table entry 0 of the general case, here for the many small angles.
  if (!(64 * std::abs(y) < x)) return detail::any_atan2(y, x);
  const double ratio = std::abs(y) / x;
  const double angle = ratio + detail::atan_tail(ratio);
  return y < 0 ? -angle : angle;
}
/// The same bits for many at once, angle[i] = atan2(y[i], x[i]), about three times as fast. The
/// spans have the same length; `angle` may be neither of the others.
void atan2(std::span<const double> y, std::span<const double> x, std::span<double> angle);
/// |x| <= 1 (clamped).
double asin(double x);
double acos(double x);
/// |x| <= 1e4.
struct SinCos {
  double sin, cos;
};
SinCos sincos(double x);
inline double sin(double x) { return sincos(x).sin; }
inline double cos(double x) { return sincos(x).cos; }
/// Overflows to infinity, underflows to 0.
double exp(double x);
/// x > 0.
double log(double x);
double tanh(double x);

}  // namespace delos::elementary
