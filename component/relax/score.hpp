// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What repair and polish raise: the score of a triangle, 1 for an equilateral one of the wanted
// size among others like it.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/types.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// Area-length quality a_f of a triangle (DESIGN section 6): 1 = equilateral, negative when
/// clockwise seen from outside. Above sqrt(3)/2 = 0.866 a triangle has no angle of 90 degrees.
double area_length(const Vec3& a, const Vec3& b, const Vec3& c);

/// Score of a triangle by itself: the least of area_length, and of the shortest and the longest
/// side over the spacing, scaled so that 0.93 stands for sides of 0.79 h and 1.27 h.
double triangle_score(const Vertex& a, const Vertex& b, const Vertex& c);

using Cotangents = std::array<double, 3>;
/// Of the angles at a, b and c.
Cotangents cotangents(const Vec3& a, const Vec3& b, const Vec3& c);
/// Of the angle at a.
double cotangent(const Vertex& a, const Vertex& b, const Vertex& c);

/// Score of a side from the cotangents of the two angles opposite to it. Their difference is four
/// times the side's stagger, the distance between its middle and that of the dual edge over its
/// length (circumcentres lie at half the side times the cotangent). 0.93 stands for 0.1.
inline constexpr double kSideWeight = 0.175;
inline double side_score(double cot, double other) {
  return 1.0 - kSideWeight * std::abs(cot - other);
}

/// area_length() of a triangle at `a` from the product of its normal and a, twice its area and the
/// sum of its squared sides.
inline double quality_of(double outwards, double twice_area, double squares) {
  constexpr double kScale = 2.3094010767585034;  // 4 sqrt(3) / 3, with the mean of the squares
  return (outwards > 0.0 ? kScale : -kScale) * (0.5 * twice_area) / (squares / 3.0);
}
/// A squared side over the squared spacing, which is the mean of its ends'.
inline double relative_square(double square, double sum_of_spacings) {
  return square / (0.25 * sum_of_spacings * sum_of_spacings);
}
/// Score of a shortest and a longest side by these.
double lengths_score(double least_relative_square, double most_relative_square);

/// Bounds within which a triangle's score and those of its sides are all at least a target, that
/// need no root and no division; beyond them nothing is known. Almost all triangles of a relaxed
/// mesh keep them.
class ClearlyGood {
 public:
  explicit ClearlyGood(double target);
  /// Of an angle, by the product of its sides and the square of twice the triangle's area.
  bool has_angle(double product, double cross) const {
    return product > 0.0 && product * product <= high2_ * cross &&
           (is_low_ || product * product >= low2_ * cross);
  }
  /// Of a side, by its square and the sum of its ends' spacings.
  bool has_length(double square, double sum_of_spacings) const {
    return square >= shortest2_ * sum_of_spacings * sum_of_spacings &&
           square <= longest2_ * sum_of_spacings * sum_of_spacings;
  }
  /// Of the triangle at `a`, by its sides to b and c; sums_of_spacings: of ab, ac and bc.
  bool holds(const Vec3& a, const Vec3& ab, const Vec3& ac,
             const std::array<double, 3>& sums_of_spacings) const {
    const Vec3 normal = ab.cross(ac);
    const double cross = normal.squaredNorm();  // (twice the area)^2
    const double bb = ab.squaredNorm(), cc = ac.squaredNorm(), dot_a = ab.dot(ac);
    const double dot_b = bb - dot_a, dot_c = cc - dot_a, aa = dot_b + dot_c;
    // area_length = 2 sqrt(3) |normal| / (aa + bb + cc).
    const double squares = aa + bb + cc;
    return normal.dot(a) > 0.0 && 12.0 * cross >= quality2_ * squares * squares &&
           has_length(bb, sums_of_spacings[0]) && has_length(cc, sums_of_spacings[1]) &&
           has_length(aa, sums_of_spacings[2]) && has_angle(dot_a, cross) &&
           has_angle(dot_b, cross) && has_angle(dot_c, cross);
  }

 private:
  double quality2_, shortest2_, longest2_, low2_, high2_;
  bool is_low_;  // no cotangent is too low
};

/// Lowers `least` to the scores of those sides of a triangle that are its own: a side belongs to
/// the triangle whose angle there is farther from 60 degrees. across(k): the cotangent on the other
/// side of side k.
inline constexpr double kEquilateralCotangent = 0.57735026918962576;  // of 60 degrees
template <class Across>
double with_own_sides(double least, const Cotangents& cot, const Across& across) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double deviation = std::abs(cot[k] - kEquilateralCotangent);
    // Twice the deviation is the most that the cotangents can differ by.
    if (1.0 - 2.0 * kSideWeight * deviation >= least) continue;
    const double other = across(k);
    if (std::abs(other - kEquilateralCotangent) <= deviation)
      least = std::min(least, side_score(cot[k], other));
  }
  return least;
}

}  // namespace delos
