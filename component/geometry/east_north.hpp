// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Local east and north as Cartesian unit vectors.
#include <cmath>

#include "core/elementary.hpp"
#include "core/types.hpp"
#include "geometry/ellipsoid.hpp"

namespace delos {

/// At a place by longitude and latitude (geodetic: then both are tangent to the surface), or by the
/// surface's unit normal. At a pole east is that of longitude 0.
struct EastNorth {
  explicit EastNorth(const LonLat& place) {
    const elementary::SinCos lon = elementary::sincos(place.lon_rad);
    const elementary::SinCos lat = elementary::sincos(place.lat_rad);
    east = {-lon.sin, lon.cos, 0.0};
    north = {-lat.sin * lon.cos, -lat.sin * lon.sin, lat.cos};
  }
  explicit EastNorth(const Vec3& up) {
    const double equatorial = std::sqrt(up.x() * up.x() + up.y() * up.y());
    east = equatorial > 0.0 ? Vec3(-up.y() / equatorial, up.x() / equatorial, 0.0)
                            : Vec3(0.0, 1.0, 0.0);
    north = up.cross(east);
  }
  Vec3 east, north;
};

}  // namespace delos
