// SPDX-License-Identifier: BSD-3-Clause
#include "relax/score.hpp"

#include <Eigen/Geometry>

namespace delos {
namespace {

const double kAreaLength = 4.0 / std::sqrt(3.0);  // 4 sqrt(3) / 3, with the mean of the squares
constexpr double kShortSide = 1.18;               // 0.79 h scores 0.93
constexpr double kLongSide = 1.18;                // 1.27 h scores 0.93

}  // namespace

double area_length(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const Vec3 normal = ab.cross(ac);
  const double area = 0.5 * std::sqrt(normal.squaredNorm());
  const double mean_square = (ab.squaredNorm() + ac.squaredNorm() + (c - b).squaredNorm()) / 3.0;
  return (normal.dot(a) > 0.0 ? kAreaLength : -kAreaLength) * area / mean_square;
}

double triangle_score(const Vertex& a, const Vertex& b, const Vertex& c) {
  const Vec3 pa = a.position(), pb = b.position(), pc = c.position();
  const auto relative_square = [](const Vec3& edge, double h) {
    return edge.squaredNorm() / (0.25 * h * h);
  };
  const double ab = relative_square(pb - pa, a.spacing + b.spacing);
  const double bc = relative_square(pc - pb, b.spacing + c.spacing);
  const double ca = relative_square(pa - pc, c.spacing + a.spacing);
  return std::min({area_length(pa, pb, pc), kShortSide * std::sqrt(std::min({ab, bc, ca})),
                   kLongSide / std::sqrt(std::max({ab, bc, ca}))});
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

bool is_clearly_good(const Vertex& a, const Vertex& b, const Vertex& c, double target) {
  const Vec3 pa = a.position();
  const Vec3 ab = b.position() - pa, ac = c.position() - pa;
  const Vec3 normal = ab.cross(ac);
  const double cross = normal.squaredNorm();  // (twice the area)^2
  const double bb = ab.squaredNorm(), cc = ac.squaredNorm(), dot_a = ab.dot(ac);
  const double dot_b = bb - dot_a, dot_c = cc - dot_a, aa = dot_b + dot_c;
  // area_length = 2 sqrt(3) |normal| / (aa + bb + cc).
  const double squares = aa + bb + cc;
  if (!(normal.dot(pa) > 0.0 && 12.0 * cross >= target * target * squares * squares)) return false;
  const double shortest = target / (2.0 * kShortSide), longest = kLongSide / (2.0 * target);
  const auto has_length = [&](double square, double h) {
    return square >= shortest * shortest * h * h && square <= longest * longest * h * h;
  };
  // Angles so near to 60 degrees that no side of theirs can be staggered too much.
  const double room = (1.0 - target) / (2.0 * kSideWeight);
  const double low = kEquilateralCotangent - room, high = kEquilateralCotangent + room;
  const auto has_angle = [&](double dot) {
    return dot > 0.0 && dot * dot <= high * high * cross &&
           (low <= 0.0 || dot * dot >= low * low * cross);
  };
  return has_length(bb, a.spacing + b.spacing) && has_length(cc, a.spacing + c.spacing) &&
         has_length(aa, b.spacing + c.spacing) && has_angle(dot_a) && has_angle(dot_b) &&
         has_angle(dot_c);
}

}  // namespace delos
