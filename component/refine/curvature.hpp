// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Whether a spacing is fine enough for a flat body.
#include "core/parallel.hpp"
#include "geometry/ellipsoid.hpp"
#include "sizing/spacing.hpp"

namespace delos {

/// Least radius of curvature of the surface at the surface point p, scaled.
double least_radius_of_curvature(const Ellipsoid& surface, const Vec3& p);

/// Error(input), with the place, when the spacing somewhere exceeds the surface's least radius of
/// curvature: along such an edge the normal turns by more than a radian, and the surface Delaunay
/// balls of a flat body reach through it. Bodies rounder than kFlattestForPlanes are not looked at.
void check_curvature(parallel::Executor& exec, const Ellipsoid& surface,
                     const SpacingField& spacing);

}  // namespace delos
