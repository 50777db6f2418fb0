// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Distance to the coast and the spacing that grows with it.
#include <memory>

#include "core/parallel.hpp"
#include "core/types.hpp"
#include "geometry/ellipsoid.hpp"
#include "sizing/raster.hpp"
#include "sizing/spacing.hpp"

namespace delos {

/// h = min(spacing + rate * distance to the coast, max), both sides of the coast. The coast is
/// the border of `land` when given, else where the elevation changes sign.
struct CoastSource {
  double spacing_m = 15.0e3;
  double rate = 0.1;
  double max_m = 60.0e3;
  std::shared_ptr<const PolygonSet> land;
};

/// Points on the coast as unit vectors: the zeros of the elevation on the lines between
/// neighbouring nodes of its raster (missing = no coast).
std::vector<Vec3> coast_points(parallel::Executor& exec, const Raster& elevation_m);
/// The same of polygons: their sides (straight in lon-lat) cut to at most `step_rad`.
std::vector<Vec3> coast_points(parallel::Executor& exec, const PolygonSet& polygons,
                               double step_rad);

/// Great-circle angle (rad) from each node of the table to the nearest of the points, exact to
/// rounding; `cutoff_rad` where none is nearer. A k-d tree: the poles and the date line are
/// nothing special to it.
void distance_to_points(parallel::Executor& exec, const std::vector<Vec3>& points,
                        double cutoff_rad, LatLonField& distance_rad);

/// Error(input) when there is no coast at all.
void fill_coast(parallel::Executor& exec, const Ellipsoid& surface, const CoastSource& source,
                const Raster* elevation_m, LatLonField& field);

}  // namespace delos
