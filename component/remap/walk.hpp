// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The polygon of a point.
#include "remap/tiling.hpp"

namespace delos::remap {

/// The polygon that holds the surface point p (to rounding), by a walk from `start`. Every step
/// crosses a plane between p and the polygon: in a tiling by Voronoi cells that can't cycle; in
/// others it might, and then the polygon with the nearest centre is returned.
Index walk(const Tiling& tiling, const Vec3& p, Index start);

/// Among about 512 polygons spread over the tiling, the one with the nearest centre: where to start
/// a walk from.
Index start_near(const Tiling& tiling, const Vec3& p);

}  // namespace delos::remap
