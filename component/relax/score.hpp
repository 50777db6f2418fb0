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

/// Whether a triangle's score and those of its sides are all at least `target`, found without a
/// root or a division; false says nothing. Almost all triangles of a relaxed mesh pass.
bool is_clearly_good(const Vertex& a, const Vertex& b, const Vertex& c, double target);

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
