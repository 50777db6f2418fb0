// SPDX-License-Identifier: BSD-3-Clause
#include "relax/score.hpp"

#include <Eigen/Geometry>

namespace delos {
namespace {

constexpr double kShortSide = 1.18;  // 0.79 h scores 0.93
constexpr double kLongSide = 1.18;   // 1.27 h scores 0.93

}  // namespace

double area_length(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const Vec3 normal = ab.cross(ac);
  return quality_of(normal.dot(a), std::sqrt(normal.squaredNorm()),
                    ab.squaredNorm() + ac.squaredNorm() + (c - b).squaredNorm());
}

double lengths_score(double least_relative_square, double most_relative_square) {
  return std::min(kShortSide * std::sqrt(least_relative_square),
                  kLongSide / std::sqrt(most_relative_square));
}

double triangle_score(const Vertex& a, const Vertex& b, const Vertex& c) {
  const Vec3 pa = a.position(), pb = b.position(), pc = c.position();
  const double ab = relative_square((pb - pa).squaredNorm(), a.spacing + b.spacing);
  const double bc = relative_square((pc - pb).squaredNorm(), b.spacing + c.spacing);
  const double ca = relative_square((pa - pc).squaredNorm(), c.spacing + a.spacing);
  return std::min(area_length(pa, pb, pc),
                  lengths_score(std::min({ab, bc, ca}), std::max({ab, bc, ca})));
}

Cotangents cotangents(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, bc = c - b;
  const double twice_area = std::sqrt(ab.cross(ac).squaredNorm());
  return {ab.dot(ac) / twice_area, -ab.dot(bc) / twice_area, ac.dot(bc) / twice_area};
}

double cotangent(const Vertex& a, const Vertex& b, const Vertex& c) {
  const Vec3 ab = b.position() - a.position(), ac = c.position() - a.position();
  return ab.dot(ac) / std::sqrt(ab.cross(ac).squaredNorm());
}

ClearlyGood::ClearlyGood(double target) {
  const double shortest = target / (2.0 * kShortSide), longest = kLongSide / (2.0 * target);
  // Angles so near to 60 degrees that no side of theirs can be staggered too much.
  const double room = (1.0 - target) / (2.0 * kSideWeight);
  const double low = kEquilateralCotangent - room, high = kEquilateralCotangent + room;
  quality2_ = target * target;
  shortest2_ = shortest * shortest;
  longest2_ = longest * longest;
  low2_ = low * low;
  high2_ = high * high;
  is_low_ = low <= 0.0;
}

}  // namespace delos
