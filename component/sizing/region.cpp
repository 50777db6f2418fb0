// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/region.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "sizing/analytic.hpp"
#include "sizing/coast.hpp"
#include "sizing/nodes.hpp"

namespace delos {
namespace {

constexpr std::int64_t kPlaceGrain = 1024;  // places a task: some ten microseconds a ring

const PolygonSet& checked(const std::shared_ptr<const PolygonSet>& polygons) {
  DELOS_CHECK(polygons && !polygons->rings.empty(), ErrorKind::input,
              polygons ? polygons->source : "region", " holds no polygon: check the file.");
  return *polygons;
}

const RegionDisc& checked(const RegionDisc& disc) {
  DELOS_CHECK(disc.radius_rad > 0.0 && disc.radius_rad < kPi, ErrorKind::config,
              "region: its radius is ", disc.radius_rad * kDegPerRad,
              " deg: must be above 0 and below 180 deg.");
  return disc;
}

Vec3 direction(const LonLat& place) {
  return unit_vector(place.lon_rad * kDegPerRad, place.lat_rad * kDegPerRad);
}

double angle_from(const RegionDisc& disc, const Vec3& centre, const Vec3& p) {
  return std::max(0.0,
                  angle_of_chord2(std::min(4.0, (p - centre).squaredNorm())) - disc.radius_rad);
}

/// How often a ray to the east from the place crosses the ring, at any turn of its longitudes.
int n_crossed(const PolygonRing& ring, double lon, double lat) {
  constexpr double kTurn = 360.0;
  int n = 0;
  for (std::size_t i = 0, j = ring.lon_deg.size() - 1; i < ring.lon_deg.size(); j = i++) {
    const double south = ring.lat_deg[j], north = ring.lat_deg[i];
    if ((south > lat) == (north > lat)) continue;
    const double x =
        ring.lon_deg[j] + (lat - south) / (north - south) * (ring.lon_deg[i] - ring.lon_deg[j]);
    for (const double turn : {-kTurn, 0.0, kTurn}) n += lon + turn < x ? 1 : 0;
  }
  return n;
}

/// Even-odd over the rings of a polygon, the union of polygons.
bool holds(const PolygonSet& polygons, const LonLat& place) {
  const double lon = place.lon_rad * kDegPerRad;
  const double lat = place.lat_rad * kDegPerRad;
  const double west = lon > 180.0 ? lon - 360.0 : lon;
  int n = 0;
  for (std::size_t r = 0; r < polygons.rings.size(); ++r) {
    n += n_crossed(polygons.rings[r], west, lat);
    const bool is_last = r + 1 == polygons.rings.size() ||
                         polygons.rings[r + 1].polygon != polygons.rings[r].polygon;
    if (!is_last) continue;
    if (n % 2 == 1) return true;
    n = 0;
  }
  return false;
}

}  // namespace

std::vector<char> inside_region(parallel::Executor& exec, const Region& region,
                                std::span<const LonLat> places) {
  std::vector<char> inside(places.size(), 0);
  const auto fill = [&](const auto& is_in) {
    parallel::for_index(exec, static_cast<std::int64_t>(places.size()), kPlaceGrain,
                        [&](std::int64_t i) {
                          const auto k = static_cast<std::size_t>(i);
                          inside[k] = is_in(places[k]) ? 1 : 0;
                        });
  };
  if (const auto* const given = std::get_if<RegionDisc>(&region)) {
    const RegionDisc& disc = checked(*given);
    const Vec3 centre = direction(disc.centre);
    fill([&](const LonLat& place) { return angle_from(disc, centre, direction(place)) <= 0.0; });
  } else {
    const PolygonSet& polygons = checked(std::get<std::shared_ptr<const PolygonSet>>(region));
    fill([&](const LonLat& place) { return holds(polygons, place); });
  }
  return inside;
}

void distance_to_region(parallel::Executor& exec, const Region& region, LatLonField& distance_rad) {
  if (const auto* const given = std::get_if<RegionDisc>(&region)) {
    const RegionDisc& disc = checked(*given);
    const Vec3 centre = direction(disc.centre);
    const NodeDirections nodes(distance_rad);
    for_rows(exec, distance_rad, [&](Index row, double* values) {
      for (Index i = 0; i < distance_rad.n_lon; ++i) {
        values[i] = angle_from(disc, centre, nodes.direction(row, i));
      }
    });
    return;
  }
  const PolygonSet& polygons = checked(std::get<std::shared_ptr<const PolygonSet>>(region));
  const std::vector<char> inside = inside_polygons(exec, polygons, distance_rad);
  // Side points twice as dense as the table: distances true to a quarter of a cell.
  const double step = 0.5 * kPi / distance_rad.n_lat_cells;
  distance_to_points(exec, coast_points(exec, polygons, step), kPi, distance_rad);
  for_rows(exec, distance_rad, [&](Index row, double* values) {
    for (Index i = 0; i < distance_rad.n_lon; ++i) {
      if (inside[distance_rad.at(row, i)] != 0) values[i] = 0.0;
    }
  });
}

void coarsen_outside(parallel::Executor& exec, const Ellipsoid& surface,
                     const LatLonField& distance_rad, const OutsideOptions& options,
                     LatLonField& field_m) {
  DELOS_ASSERT(field_m.values.size() == distance_rad.values.size());
  const double step = kPi / distance_rad.n_lat_cells, scale_m = surface.scale_m();
  for_rows(exec, field_m, [&](Index row, double* values) {
    const double* const distance = distance_rad.values.data() + distance_rad.at(row, 0);
    for (Index i = 0; i < field_m.n_lon; ++i) {
      const double behind = (distance[i] - step) * scale_m - options.rings * values[i];
      values[i] =
          std::max(values[i], std::min(options.coarsest_rad * scale_m, options.rate * behind));
    }
  });
}

}  // namespace delos
