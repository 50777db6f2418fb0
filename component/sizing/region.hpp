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
using RegionShape = std::variant<RegionDisc, std::shared_ptr<const PolygonSet>>;

/// Where the side from the last corner of the ring to its first ends: the first's longitude, a turn
/// on for a ring round a pole.
double closing_lon_deg(const PolygonRing& ring);

/// Error(input) for a set without a polygon, or with two sides that cross (both with a place),
/// Error(config) for a radius that is not above 0 and below pi. n log n where sides are short.
void check_region(const RegionShape& region);

/// 1 inside, 0 outside, by place. The region must be one that check_region passes.
std::vector<char> inside_region(parallel::Executor& exec, const RegionShape& region,
                                std::span<const LonLat> places);

/// Angle (rad) from every node of the table to the region, 0 inside.
void distance_to_region(parallel::Executor& exec, const RegionShape& region,
                        LatLonField& distance_rad);

struct OutsideOptions {
  int n_rings = 7;            ///< cells around the region that keep the spacing; one more does
  double rate = 0.12;         ///< growth of the spacing per distance behind them
  double coarsest_rad = 0.4;  ///< spacing, over the largest radius, that it grows to
};

/// h becomes min(coarsest, h + rate (d - (rings + 1) h)) where d, the distance from the region less
/// a step of the table, is larger than these rings, and stays where it is larger: what lies
/// outside costs some 2 / rate cells for every cell of the region's rim, whatever the spacing.
/// `field_m`: of the size of the distance.
void coarsen_outside(parallel::Executor& exec, const Ellipsoid& surface,
                     const LatLonField& distance_rad, const OutsideOptions& options,
                     LatLonField& field_m);

/// h becomes the coarsest at once behind the rings, so that expected_vertices() counts the region
/// and its rings alone, to some per cent.
void drop_outside(parallel::Executor& exec, const Ellipsoid& surface,
                  const LatLonField& distance_rad, const OutsideOptions& options,
                  LatLonField& field_m);

}  // namespace delos
