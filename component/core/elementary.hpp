// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Elementary functions from + - * / and sqrt alone, so that their bits do not depend on the C
// library: these, never <cmath>, on the path from configuration to grid. Accuracy: within
// 2 units in the last place of the true value over the ranges given (a test checks it against
// long double libm). NaN in, NaN out.

namespace delos::elementary {

/// Angle of (x, y) in (-pi, pi]; atan2(0, 0) = 0. Small angles keep full relative accuracy.
double atan2(double y, double x);
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
