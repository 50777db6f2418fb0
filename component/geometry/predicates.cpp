// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/predicates.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/expansion.hpp"

namespace delos::predicates {
namespace {

using expansion::Expansion;
using expansion::Two;

using Vec3Two = std::array<Two, 3>;

Vec3Two exact_difference(const Vec3& a, const Vec3& b) {
  return {expansion::two_sum(a.x(), -b.x()), expansion::two_sum(a.y(), -b.y()),
          expansion::two_sum(a.z(), -b.z())};
}

/// Sign of det[u, v, w] by double-double arithmetic, or 0 when that can't tell. Each of the six
/// products of three factors carries two products and at most three sums, each with a relative
/// error below 2^-103 of the magnitudes it adds: below 2^-100 of the permanent in all. The bound
/// leaves a factor of eight for the rounding of the permanent and of the bound itself.
int double_double_sign(const Vec3Two& u, const Vec3Two& v, const Vec3Two& w) {
  constexpr double kRelative = 0x1p-97;
  Two det{0, 0};
  double permanent = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const Two p = expansion::multiply(v[j], w[k]);
    const Two q = expansion::multiply(v[k], w[j]);
    det = expansion::add(det, expansion::multiply(expansion::add(p, expansion::negate(q)), u[i]));
    permanent += (std::abs(p.hi) + std::abs(q.hi)) * std::abs(u[i].hi);
  }
  const double bound = kRelative * permanent;
  return det.hi > bound ? 1 : (det.hi < -bound ? -1 : 0);
}

/// The 2x2 minors of a pair of points.
struct Minors {
  Expansion<4> xy, yz, zx;
};
Minors minors(const Vec3& a, const Vec3& b) {
  return {expansion::minor2(a.x(), a.y(), b.x(), b.y()),
          expansion::minor2(a.y(), a.z(), b.y(), b.z()),
          expansion::minor2(a.z(), a.x(), b.z(), b.x())};
}

/// det[a, b, c] exactly.
Expansion<24> exact_determinant(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Minors m = minors(a, b);
  return expansion::sum(
      expansion::sum(expansion::scale(m.yz, c.x()), expansion::scale(m.zx, c.y())),
      expansion::scale(m.xy, c.z()));
}

}  // namespace

int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const int sign =
      double_double_sign(exact_difference(b, a), exact_difference(c, a), exact_difference(d, a));
  if (sign != 0) return sign;
  // det[b - a, c - a, d - a] = [b c d] - [a c d] + [a b d] - [a b c].
  const auto with_d =
      expansion::sum(exact_determinant(b, c, d), expansion::negate(exact_determinant(a, c, d)));
  const auto with_ab =
      expansion::sum(exact_determinant(a, b, d), expansion::negate(exact_determinant(a, b, c)));
  return expansion::sum(with_d, with_ab).sign();
}

int orient_origin_exact(const Vec3& a, const Vec3& b, const Vec3& c) {
  return exact_determinant(a, b, c).sign();
}

bool in_circle_exact(const Site& a, const Site& b, const Site& c, const Site& d) {
  const int sign = orient3d_exact(a.position, b.position, c.position, d.position);
  if (sign != 0) return sign > 0;
  // Coplanar: p_i becomes (1 + e_i) p_i with e_i far above all e_j of larger index j. The
  // determinant D = [b c d] - [a c d] + [a b d] - [a b c] is linear in each point, so that where
  // D = 0 its derivatives are dD/de_a = -[b c d], dD/de_b = +[a c d], dD/de_c = -[a b d] and
  // dD/de_d = +[a b c]. The first one that is not zero decides; when all four are zero, so are
  // all the mixed ones.
  struct Term {
    Index index;
    const Vec3 *p, *q, *r;
    int factor;
  };
  std::array<Term, 4> terms = {{{a.index, &b.position, &c.position, &d.position, -1},
                                {b.index, &a.position, &c.position, &d.position, 1},
                                {c.index, &a.position, &b.position, &d.position, -1},
                                {d.index, &a.position, &b.position, &c.position, 1}}};
  std::sort(terms.begin(), terms.end(),
            [](const Term& s, const Term& t) { return s.index < t.index; });
  for (const Term& term : terms) {
    const int derivative = term.factor * orient_origin(*term.p, *term.q, *term.r);
    if (derivative != 0) return derivative > 0;
  }
  return false;
}

bool prefers_flip(const Vec3& u, const Vec3& v, const Vec3& o, const Vec3& p) {
  // sin(angle at o + angle at p) < -tolerance, times all four side lengths. The tolerance is a
  // thousand roundings of a sine: below what any grid notices, above the noise of this expression.
  constexpr double kTolerance = 1e-13;
  const Vec3 ou = u - o;
  const Vec3 ov = v - o;
  const Vec3 pu = u - p;
  const Vec3 pv = v - p;
  const double dot_o = ou.dot(ov);
  const double dot_p = pu.dot(pv);
  if (dot_o > 0 && dot_p > 0) return false;
  const double cross_o = ou.cross(ov).norm();
  const double cross_p = pu.cross(pv).norm();
  const double scale =
      std::sqrt((ou.squaredNorm() * ov.squaredNorm()) * (pu.squaredNorm() * pv.squaredNorm()));
  return dot_o * cross_p + dot_p * cross_o < -kTolerance * scale;
}

}  // namespace delos::predicates
