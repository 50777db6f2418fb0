// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Longitudes and latitudes of a grid's points.
#include <span>

#include "dual/grid.hpp"

namespace delos::dual {

/// Longitudes in [0, 2 pi) and latitudes, of the grid's kind, of surface points.
inline void locate(const Grid& grid, std::span<const Vec3> points, std::span<LonLat> lon_lat) {
  grid.surface.lon_lat(points, grid.latitude, lon_lat);
  for (LonLat& place : lon_lat) {
    const double turned = place.lon_rad < 0.0 ? place.lon_rad + 2.0 * kPi : place.lon_rad;
    place.lon_rad = turned < 2.0 * kPi ? turned : 0.0;  // -1e-17 + 2 pi rounds to 2 pi
  }
}

}  // namespace delos::dual
