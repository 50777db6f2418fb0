// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The part of the surface that a regional grid is for, and a spacing that spends cells only there.
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "core/parallel.hpp"
#include "geometry/ellipsoid.hpp"
#include "sizing/raster.hpp"
#include "sizing/spacing.hpp"

namespace delos {

/// All places within an angle of the centre, that between the directions of two places.
struct RegionDisc {
  LonLat centre;
  double radius_rad;
};

/// Sides of polygons are straight in longitude and latitude, as in all sources of spacing.
using Region = std::variant<RegionDisc, std::shared_ptr<const PolygonSet>>;

/// 1 inside, 0 outside, by place. Error(input) for a set without a polygon, Error(config) for a
/// radius that is not above 0 and below pi.
std::vector<char> inside_region(parallel::Executor& exec, const Region& region,
                                std::span<const LonLat> places);

/// Angle (rad) from every node of the table to the region, 0 inside. Errors as above.
void distance_to_region(parallel::Executor& exec, const Region& region, LatLonField& distance_rad);

struct OutsideOptions {
  double rings = 8.0;  ///< cells around the region that keep the spacing; 7 make its boundary
  double rate = 0.4;   ///< growth of the spacing per distance behind them
  double coarsest_rad = 0.4;  ///< spacing, over the largest radius, that it grows to
};

/// h becomes max(h, min(coarsest, rate (d - rings h))), d the distance from the region less a step
/// of the table: what lies outside costs about 2.3 / rate cells for every cell of the region's rim,
/// whatever the spacing. `field_m`: of the size of the distance.
void coarsen_outside(parallel::Executor& exec, const Ellipsoid& surface,
                     const LatLonField& distance_rad, const OutsideOptions& options,
                     LatLonField& field_m);

}  // namespace delos
