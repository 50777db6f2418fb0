// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Spacing given by a formula of position: constant, latitude profile, disc, box, polygon.
// Angles are those of the table's lon/lat taken on the unit sphere; a length in metres becomes an
// angle by division by the largest radius.
#include <memory>
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "sizing/raster.hpp"
#include "sizing/spacing.hpp"

namespace delos {

struct ConstantSource {
  double spacing_m = 0.0;
};

/// Through the points: piecewise linear, or monotone piecewise cubic (Fritsch & Butland 1984,
/// doi:10.1137/0905021); constant beyond the first and the last. Latitudes ascend.
struct LatitudeProfileSource {
  std::vector<double> lat_deg, spacing_m;
  bool cubic = false;
};

/// How a region passes into its surroundings, as a function of the distance d outside its edge:
///   linear:   straight from `spacing` at d = 0 to `outside` at d = width
///   smooth:   the same with 3 t^2 - 2 t^3, t = d / width
///   gaussian: outside - (outside - spacing) exp(-d^2 / (2 width^2))
/// Width 0 is a step.
enum class Transition { linear, smooth, gaussian };

struct RegionEdge {
  double spacing_m = 0.0;
  double outside_m = 0.0;
  double width_rad = 0.0;
  Transition transition = Transition::smooth;
};

struct DiscSource {
  double lon_deg = 0.0, lat_deg = 0.0;
  double radius_rad = 0.0;
  RegionEdge edge;
};

/// West to east may cross the date line (west > east, or east beyond 180).
struct BoxSource {
  double west_deg = 0.0, east_deg = 0.0, south_deg = 0.0, north_deg = 0.0;
  RegionEdge edge;
};

/// Sides are straight in lon-lat (GeoJSON, RFC 7946).
struct PolygonSource {
  std::shared_ptr<const PolygonSet> polygons;
  RegionEdge edge;
};

/// Each writes metres on the nodes of `field` (its size says which nodes). Error(config) for an
/// option out of range.
void fill_constant(parallel::Executor& exec, const ConstantSource& source, LatLonField& field);
void fill_latitude_profile(parallel::Executor& exec, const LatitudeProfileSource& source,
                           LatLonField& field);
void fill_disc(parallel::Executor& exec, const DiscSource& source, LatLonField& field);
void fill_box(parallel::Executor& exec, const BoxSource& source, LatLonField& field);
void fill_polygon(parallel::Executor& exec, const PolygonSource& source, LatLonField& field);

/// 1 inside, 0 outside (even-odd rule over all rings) at the nodes of `like`. A ring whose
/// longitudes do not come back to where they began goes round a pole and holds the pole nearer
/// to it.
std::vector<char> inside_polygons(parallel::Executor& exec, const PolygonSet& polygons,
                                  const LatLonField& like);
/// The same at places. Each looks at all sides of the rings that reach its latitude.
std::vector<char> inside_polygons(parallel::Executor& exec, const PolygonSet& polygons,
                                  std::span<const LonLat> places);

}  // namespace delos
