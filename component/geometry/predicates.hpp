// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Exact geometric predicates: the sign is that of the real-number expression of the given
// doubles, never of a rounded one. Static filter, then double-double, then expansions
// (Shewchuk 1997, doi:10.1007/PL00009321). Ties are broken by index (simulation of simplicity,
// Edelsbrunner & Muecke 1990, doi:10.1145/77635.77639).
//
// Coordinates must be 0 or have a magnitude in [1e-85, 1e85], so that no product underflows.
#include <Eigen/Geometry>
#include <cmath>

#include "core/types.hpp"

namespace delos::predicates {

/// A point with the index that breaks ties. The same point must always carry the same index.
struct Site {
  Vec3 position;
  Index index;
};

/// Sign of det[b - a, c - a, d - a]: +1 when d lies on the outer side of the plane through a, b, c
/// that are counter-clockwise seen from outside; 0 when the four are coplanar.
/// Laws: swapping two points flips the sign; cyclic shifts of (a, b, c) keep it.
inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of det[a, b, c]: +1 when a, b, c are counter-clockwise seen from outside the origin.
inline int orient_origin(const Vec3& a, const Vec3& b, const Vec3& c);

/// Whether d is inside the circumcircle of the counter-clockwise triangle (a, b, c) on a convex
/// surface around the origin: orient3d > 0, ties decided by moving every point outward by a
/// positive infinitesimal that falls steeply with its index. Never undecided for four distinct
/// indices unless the points are degenerate as seen from the origin too; then false.
/// Law: for the two triangles of a quadrilateral the answers agree, so flips can't cycle.
inline bool in_circle(const Site& a, const Site& b, const Site& c, const Site& d);

/// in_circle once the static filter has failed: exact, slow, never inlined.
bool in_circle_exact(const Site& a, const Site& b, const Site& c, const Site& d);

/// orient3d and orient_origin once the static filter has failed.
int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int orient_origin_exact(const Vec3& a, const Vec3& b, const Vec3& c);

/// Whether the surface Delaunay prefers the other diagonal of the quadrilateral whose diagonal is
/// (u, v) and whose opposite corners are o and p: cot(angle at o) + cot(angle at p) < 0. On the
/// sphere this is in_circle up to rounding; on an ellipsoid it agrees with the surface Delaunay
/// ball where the hull predicate is anisotropic. Floating point with a fixed tolerance, so that
/// exact ties stay unflipped and flips can't cycle.
/// Laws: swapping u and v, or o and p, changes nothing; (u, v | o, p) and (o, p | u, v) are never
/// both preferred.
bool prefers_flip(const Vec3& u, const Vec3& v, const Vec3& o, const Vec3& p);

// ---- static filters, for hot loops ----

/// det[u, v, w] rounded, and a bound on its error.
struct Filtered {
  double det, bound;
  bool is_certain() const { return std::abs(det) > bound; }
};

/// Bound: Shewchuk 1997, section 4.3 ((7 + 56 eps) eps times the permanent, which covers one
/// rounding in each coordinate of u, v, w), eps = 2^-53; the last term covers underflow.
inline Filtered determinant(const Vec3& u, const Vec3& v, const Vec3& w) {
  constexpr double kRelative = 7.771561172376103e-16;  // (7 + 56 eps) eps, rounded up
  constexpr double kAbsolute = 1e-290;
  const double vw_yz = v.y() * w.z();
  const double vw_zy = v.z() * w.y();
  const double vw_zx = v.z() * w.x();
  const double vw_xz = v.x() * w.z();
  const double vw_xy = v.x() * w.y();
  const double vw_yx = v.y() * w.x();
  const double det = u.x() * (vw_yz - vw_zy) + u.y() * (vw_zx - vw_xz) + u.z() * (vw_xy - vw_yx);
  const double permanent = (std::abs(vw_yz) + std::abs(vw_zy)) * std::abs(u.x()) +
                           (std::abs(vw_zx) + std::abs(vw_xz)) * std::abs(u.y()) +
                           (std::abs(vw_xy) + std::abs(vw_yx)) * std::abs(u.z());
  return {det, kRelative * permanent + kAbsolute};
}

inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Filtered f = determinant(b - a, c - a, d - a);
  if (f.is_certain()) return f.det > 0 ? 1 : -1;
  return orient3d_exact(a, b, c, d);
}

inline int orient_origin(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Filtered f = determinant(a, b, c);
  if (f.is_certain()) return f.det > 0 ? 1 : -1;
  return orient_origin_exact(a, b, c);
}

inline bool in_circle(const Site& a, const Site& b, const Site& c, const Site& d) {
  const Filtered f =
      determinant(b.position - a.position, c.position - a.position, d.position - a.position);
  if (f.is_certain()) return f.det > 0;
  return in_circle_exact(a, b, c, d);
}

}  // namespace delos::predicates
