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

constexpr std::int64_t kRegionGrain = 1024;  // places a task: some tens of microseconds

double angle_from(const RegionDisc& disc, const Vec3& centre, const Vec3& p) {
  return std::max(0.0,
                  angle_of_chord2(std::min(4.0, (p - centre).squaredNorm())) - disc.radius_rad);
}

Vec3 direction(const LonLat& place) {
  return unit_vector(place.lon_rad * kDegPerRad, place.lat_rad * kDegPerRad);
}

/// A side from its western to its eastern end, and where it stands: side k of a ring of a set.
struct PolygonSide {
  double west, west_lat, east, east_lat;  // degrees
  std::size_t ring, k, n;
};

std::vector<PolygonSide> sides_of(const PolygonSet& polygons) {
  std::vector<PolygonSide> out;
  for (std::size_t r = 0; r < polygons.rings.size(); ++r) {
    const PolygonRing& ring = polygons.rings[r];
    const std::size_t n = ring.lon_deg.size();
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t next = (k + 1) % n;
      PolygonSide side{ring.lon_deg[k],
                       ring.lat_deg[k],
                       next == 0 ? closing_lon_deg(ring) : ring.lon_deg[next],
                       ring.lat_deg[next],
                       r,
                       k,
                       n};
      if (side.west > side.east) {
        std::swap(side.west, side.east);
        std::swap(side.west_lat, side.east_lat);
      }
      out.push_back(side);
    }
  }
  return out;
}

/// Twice the area of the triangle from the side to the point: its sign says on which side it is.
double side_of(const PolygonSide& s, double lon, double lat) {
  return (s.east - s.west) * (lat - s.west_lat) - (s.east_lat - s.west_lat) * (lon - s.west);
}

bool are_neighbours(const PolygonSide& a, const PolygonSide& b) {
  return a.ring == b.ring && ((a.k + 1) % a.n == b.k || (b.k + 1) % b.n == a.k);
}

/// Sides that only touch do not cross: neighbouring rings of a map may share points.
bool do_cross(const PolygonSide& a, const PolygonSide& b) {
  return !are_neighbours(a, b) &&
         side_of(a, b.west, b.west_lat) * side_of(a, b.east, b.east_lat) < 0.0 &&
         side_of(b, a.west, a.west_lat) * side_of(b, a.east, a.east_lat) < 0.0;
}

/// Sides of one polygon, which must not cross each other; different polygons may overlap.
void check_sides(const PolygonSet& polygons) {
  std::vector<PolygonSide> sides = sides_of(polygons);
  std::stable_sort(sides.begin(), sides.end(),
                   [](const PolygonSide& a, const PolygonSide& b) { return a.west < b.west; });
  std::vector<const PolygonSide*> open;  // those that the sweep to the east has not left behind
  for (const PolygonSide& side : sides) {
    std::erase_if(open, [&](const PolygonSide* other) { return other->east < side.west; });
    for (const PolygonSide* other : open) {
      const bool is_same = polygons.rings[side.ring].polygon == polygons.rings[other->ring].polygon;
      DELOS_CHECK(!is_same || !do_cross(side, *other), ErrorKind::input, polygons.source,
                  ": the outline of a polygon crosses itself near lon ",
                  0.5 * (side.west + side.east), ", lat ", 0.5 * (side.west_lat + side.east_lat),
                  " deg. Put its points in order, or split it.");
    }
    open.push_back(&side);
  }
}

}  // namespace

double closing_lon_deg(const PolygonRing& ring) {
  constexpr double kHalfTurn = 180.0;
  const double gap = ring.lon_deg.back() - ring.lon_deg.front();
  if (std::abs(gap) <= kHalfTurn) return ring.lon_deg.front();
  return ring.lon_deg.front() + (gap > 0.0 ? 2.0 : -2.0) * kHalfTurn;
}

void check_region(const RegionShape& region) {
  if (const auto* const disc = std::get_if<RegionDisc>(&region)) {
    DELOS_CHECK(disc->radius_rad > 0.0 && disc->radius_rad < kPi, ErrorKind::config,
                "region: its radius is ", disc->radius_rad * kDegPerRad,
                " deg: must be above 0 and below 180 deg.");
    return;
  }
  const auto& polygons = std::get<std::shared_ptr<const PolygonSet>>(region);
  DELOS_CHECK(polygons && !polygons->rings.empty(), ErrorKind::input,
              polygons ? polygons->source : "region",
              " holds no polygon: check the file and the feature's name.");
  check_sides(*polygons);
}

std::vector<char> inside_region(parallel::Executor& exec, const RegionShape& region,
                                std::span<const LonLat> places) {
  const auto* const disc = std::get_if<RegionDisc>(&region);
  if (disc == nullptr) {
    return inside_polygons(exec, *std::get<std::shared_ptr<const PolygonSet>>(region), places);
  }
  const Vec3 centre = direction(disc->centre);
  std::vector<char> inside(places.size(), 0);
  parallel::for_index(exec, static_cast<std::int64_t>(places.size()), kRegionGrain,
                      [&](std::int64_t i) {
                        const auto k = static_cast<std::size_t>(i);
                        inside[k] = angle_from(*disc, centre, direction(places[k])) <= 0.0 ? 1 : 0;
                      });
  return inside;
}

void distance_to_region(parallel::Executor& exec, const RegionShape& region,
                        LatLonField& distance_rad) {
  if (const auto* const disc = std::get_if<RegionDisc>(&region)) {
    const Vec3 centre = direction(disc->centre);
    const NodeDirections nodes(distance_rad);
    for_rows(exec, distance_rad, [&](Index row, double* values) {
      for (Index i = 0; i < distance_rad.n_lon; ++i) {
        values[i] = angle_from(*disc, centre, nodes.direction(row, i));
      }
    });
    return;
  }
  const PolygonSet& polygons = *std::get<std::shared_ptr<const PolygonSet>>(region);
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
  const double coarsest_m = options.coarsest_rad * scale_m, n_kept = options.n_rings + 1.0;
  for_rows(exec, field_m, [&](Index row, double* values) {
    const double* const distance = distance_rad.values.data() + distance_rad.at(row, 0);
    for (Index i = 0; i < field_m.n_lon; ++i) {
      const double behind_m = (distance[i] - step) * scale_m - n_kept * values[i];
      const double grown_m = values[i] + options.rate * std::max(0.0, behind_m);
      values[i] = std::max(values[i], std::min(coarsest_m, grown_m));
    }
  });
}

void drop_outside(parallel::Executor& exec, const Ellipsoid& surface,
                  const LatLonField& distance_rad, const OutsideOptions& options,
                  LatLonField& field_m) {
  DELOS_ASSERT(field_m.values.size() == distance_rad.values.size());
  // Rows of hexagons along the outline, and half a one beyond the middle of the last.
  const double row = 0.5 * std::sqrt(3.0), n_wide = row * (options.n_rings + 0.5);
  // Where the node before is the last one inside, the middle between the two is the border.
  const double half_step = 0.5 * kPi / distance_rad.n_lat_cells, scale_m = surface.scale_m();
  for_rows(exec, field_m, [&](Index row, double* values) {
    const double* const distance = distance_rad.values.data() + distance_rad.at(row, 0);
    for (Index i = 0; i < field_m.n_lon; ++i) {
      const bool is_beyond = (distance[i] - half_step) * scale_m > n_wide * values[i];
      if (is_beyond) values[i] = std::max(values[i], options.coarsest_rad * scale_m);
    }
  });
}

}  // namespace delos
