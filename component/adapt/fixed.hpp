// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Regions that no remesh touches.
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "core/parallel.hpp"
#include "geometry/ellipsoid.hpp"
#include "sizing/raster.hpp"

namespace delos {

/// Angles of longitude and latitude taken on the unit sphere, borders included.
struct FixedDisc {
  double lon_deg = 0.0, lat_deg = 0.0;
  double radius_rad = 0.0;
};

/// West to east may cross the date line (west > east, or east beyond 180).
struct FixedBox {
  double west_deg = 0.0, east_deg = 0.0, south_deg = 0.0, north_deg = 0.0;
};

/// What lies inside, by inside_polygons().
struct FixedPolygons {
  std::shared_ptr<const PolygonSet> polygons;
};

using FixedRegion = std::variant<FixedDisc, FixedBox, FixedPolygons>;

/// 1 where a place lies in a region, else 0; empty without regions.
std::vector<char> in_fixed_regions(parallel::Executor& exec, std::span<const FixedRegion> regions,
                                   std::span<const LonLat> places);

}  // namespace delos
