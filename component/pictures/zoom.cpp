// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/zoom.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace delos::pictures {

namespace {

// A cap beyond this is seen better as a whole globe and a map of the world.
constexpr double kLargestCap_rad = 75.0 * kRadPerDeg;
constexpr double kSmallestCap_rad = 1e-4;

Vec3 direction(const LonLat& place) {
  const double clat = std::cos(place.lat_rad);
  return {clat * std::cos(place.lon_rad), clat * std::sin(place.lon_rad), std::sin(place.lat_rad)};
}

LonLat place_at(const Vec3& d) {
  return {std::atan2(d.y(), d.x()), std::atan2(d.z(), std::hypot(d.x(), d.y()))};
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

std::optional<Zoom> zoom_of(const Grid& grid, const PictureOptions& options) {
  if (options.view_radius_deg > 0.0) {
    return Zoom{
        {options.view_lon_deg * kRadPerDeg, options.view_lat_deg * kRadPerDeg},
        std::clamp(options.view_radius_deg * kRadPerDeg, kSmallestCap_rad, kLargestCap_rad)};
  }
  if (is_closed(grid)) return std::nullopt;
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < grid.cell_lon_lat.size(); ++i) {
    sum += grid.cell_area_m2[i] * direction(grid.cell_lon_lat[i]);
  }
  if (!(sum.norm() > 0.0)) return std::nullopt;
  const Vec3 axis = sum.normalized();
  double radius_rad = kSmallestCap_rad;
  for (const LonLat& corner : grid.vertex_lon_lat) {
    radius_rad = std::max(radius_rad, angle_between(axis, direction(corner)));
  }
  if (radius_rad > kLargestCap_rad) return std::nullopt;
  return Zoom{place_at(axis), radius_rad};
}

double graticule_step(double span_deg) {
  constexpr double kFewestLines = 4.0;
  for (const double step : {30.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02}) {
    if (span_deg / step >= kFewestLines) return step;
  }
  return 0.01;
}

double meridian_step(const Zoom& zoom) {
  const double nearest_pole_rad =
      std::min(std::abs(zoom.centre.lat_rad) + zoom.radius_rad / 2.0, 89.0 * kRadPerDeg);
  const double width_deg = 2.0 * zoom.radius_rad * kDegPerRad / std::cos(nearest_pole_rad);
  return graticule_step(std::min(360.0, width_deg));
}

AzimuthalMap::AzimuthalMap(const LonLat& centre)
    : axis_(direction(centre)),
      east_(-std::sin(centre.lon_rad), std::cos(centre.lon_rad), 0.0),
      north_(axis_.cross(east_)) {}

Point AzimuthalMap::forward(const LonLat& place) const {
  const Vec3 d = direction(place);
  const double stretch = std::sqrt(2.0 / std::max(1.0 + d.dot(axis_), 1e-12));
  return {stretch * d.dot(east_), stretch * d.dot(north_)};
}

LonLat AzimuthalMap::inverse(const Point& point) const {
  const double square = std::min(point.x * point.x + point.y * point.y, 4.0);
  const double shrink = std::sqrt(1.0 - square / 4.0);
  return place_at((1.0 - square / 2.0) * axis_ + shrink * (point.x * east_ + point.y * north_));
}

bool AzimuthalMap::shows(const LonLat& place) const {
  constexpr double kFar = -0.9;  // the cosine of 154 degrees
  return direction(place).dot(axis_) > kFar;
}

}  // namespace delos::pictures
