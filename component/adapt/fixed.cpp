// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/fixed.hpp"

#include <cmath>

#include "core/elementary.hpp"
#include "core/types.hpp"
#include "sizing/analytic.hpp"

namespace delos {
namespace {

/// Places a task; no result depends on it.
constexpr std::int64_t kPlaceGrain = 4096;
constexpr double kCircle_deg = 360.0;

Vec3 direction(double lon_rad, double lat_rad) {
  const elementary::SinCos lon = elementary::sincos(lon_rad), lat = elementary::sincos(lat_rad);
  return {lat.cos * lon.cos, lat.cos * lon.sin, lat.sin};
}

bool holds(const FixedDisc& disc, const LonLat& place) {
  const Vec3 centre = direction(disc.lon_deg * kRadPerDeg, disc.lat_deg * kRadPerDeg);
  const double half_chord = 0.5 * (direction(place.lon_rad, place.lat_rad) - centre).norm();
  return 2.0 * elementary::asin(half_chord) <= disc.radius_rad;
}

/// An angle in [0, 360).
double turned(double angle_deg) {
  return angle_deg - kCircle_deg * std::floor(angle_deg / kCircle_deg);
}

bool holds(const FixedBox& box, const LonLat& place) {
  const double lat_deg = place.lat_rad * kDegPerRad;
  if (lat_deg < box.south_deg || lat_deg > box.north_deg) return false;
  if (box.east_deg - box.west_deg >= kCircle_deg) return true;
  const double width_deg = turned(box.east_deg - box.west_deg);
  return turned(place.lon_rad * kDegPerRad - box.west_deg) <= width_deg;
}

bool holds(const FixedRegion& region, const LonLat& place) {
  if (const auto* const disc = std::get_if<FixedDisc>(&region)) return holds(*disc, place);
  return holds(std::get<FixedBox>(region), place);
}

}  // namespace

std::vector<char> in_fixed_regions(parallel::Executor& exec, std::span<const FixedRegion> regions,
                                   std::span<const LonLat> places) {
  if (regions.empty()) return {};
  std::vector<char> out(places.size(), 0);
  for (const FixedRegion& region : regions) {
    if (const auto* const shape = std::get_if<FixedPolygons>(&region)) {
      const std::vector<char> inside = inside_polygons(exec, *shape->polygons, places);
      for (std::size_t i = 0; i < out.size(); ++i) out[i] |= inside[i];
      continue;
    }
    parallel::for_index(exec, static_cast<std::int64_t>(places.size()), kPlaceGrain,
                        [&](std::int64_t i) {
                          const auto k = static_cast<std::size_t>(i);
                          if (holds(region, places[k])) out[k] = 1;
                        });
  }
  return out;
}

}  // namespace delos
