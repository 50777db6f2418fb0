// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Exact geometric predicates: the sign is that of the real-number expression of the given
// doubles, never of a rounded one. Static filter, then double-double, then expansions
// (Shewchuk 1997, doi:10.1007/PL00009321). Ties are broken by index (simulation of simplicity,
// Edelsbrunner & Muecke 1990, doi:10.1145/77635.77639).
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
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of det[a, b, c]: +1 when a, b, c are counter-clockwise seen from outside the origin.
int orient_origin(const Vec3& a, const Vec3& b, const Vec3& c);

/// Whether d is inside the circumcircle of the counter-clockwise triangle (a, b, c) on a convex
/// surface around the origin: orient3d > 0, ties decided by moving every point outward by a
/// positive infinitesimal that falls steeply with its index. Never undecided for four distinct
/// indices unless the points are degenerate as seen from the origin too; then false.
/// Law: for the two triangles of a quadrilateral the answers agree, so flips can't cycle.
bool in_circle(const Site& a, const Site& b, const Site& c, const Site& d);

/// in_circle once the static filter has failed: exact, slow, never inlined.
bool in_circle_exact(const Site& a, const Site& b, const Site& c, const Site& d);

/// Whether the surface Delaunay prefers the other diagonal of the quadrilateral whose diagonal is
/// (u, v) and whose opposite corners are o and p: cot(angle at o) + cot(angle at p) < 0. On the
/// sphere this is in_circle up to rounding; on an ellipsoid it agrees with the surface Delaunay
/// ball where the hull predicate is anisotropic. Floating point with a fixed tolerance, so that
/// exact ties stay unflipped and flips can't cycle.
bool prefers_flip(const Vec3& u, const Vec3& v, const Vec3& o, const Vec3& p);

}  // namespace delos::predicates
