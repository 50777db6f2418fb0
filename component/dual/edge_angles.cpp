// SPDX-License-Identifier: BSD-3-Clause
#include "dual/edge_angles.hpp"

#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"

namespace delos {
namespace {

constexpr std::int64_t kGrain = 4096;

struct Found {
  bool is_by_latitude = true;
  AnglesByLatitude worst;
};

/// East and north parts of the unit normal; nothing for an edge without direction.
std::optional<std::array<double, 2>> direction_of_normal(const Grid& g, std::int64_t i) {
  const auto [v, w] = g.vertices_on_edge[at(i)];
  const Vec3 up = g.surface.normal(g.edge_position[at(i)]);
  const Vec3 normal = (g.vertex_position[at(w)] - g.vertex_position[at(v)]).cross(up);
  const Vec3 east(-up.y(), up.x(), 0.0);
  const double size = normal.norm() * east.norm();
  if (!(size > 0.0)) return std::nullopt;
  return std::array{normal.dot(east) / size, normal.dot(up.cross(east)) / size};
}

void look_at(const Grid& g, std::int64_t i, double tolerance, Found& found) {
  const auto direction = direction_of_normal(g, i);
  if (!direction) return;
  const auto [east, north] = *direction;
  const auto [v, w] = g.vertices_on_edge[at(i)];
  const double rise_rad = g.vertex_lon_lat[at(w)].lat_rad - g.vertex_lon_lat[at(v)].lat_rad;
  const double length_rad = g.vertex_distance_m[at(i)] / g.surface.scale_m();
  const auto angle = elementary::sincos(g.edge_angle_rad[at(i)]);
  const double expected = std::clamp(rise_rad / length_rad, -1.0, 1.0);
  const bool has_sign = angle.sin * north >= 0.0 || std::abs(north) <= tolerance;
  if (!(std::abs(angle.cos - expected) <= tolerance) || !has_sign) found.is_by_latitude = false;
  const double off = std::abs(elementary::atan2(angle.sin * east - angle.cos * north,
                                                angle.cos * east + angle.sin * north));
  if (off > found.worst.worst_rad) found.worst = {off, static_cast<Index>(i)};
}

}  // namespace

std::optional<AnglesByLatitude> angles_by_latitude(Context& context, const Grid& grid,
                                                   double tolerance) {
  if (!grid.surface.is_sphere()) return std::nullopt;
  const Found all = parallel::reduce(
      context.exec, grid.n_edges(), kGrain, Found{},
      [&](std::int64_t begin, std::int64_t end) {
        Found part;
        for (std::int64_t i = begin; i < end && part.is_by_latitude; ++i) {
          look_at(grid, i, tolerance, part);
        }
        return part;
      },
      [](Found total, const Found& more) {
        total.is_by_latitude = total.is_by_latitude && more.is_by_latitude;
        if (more.worst.worst_rad > total.worst.worst_rad) total.worst = more.worst;
        return total;
      });
  if (!all.is_by_latitude) return std::nullopt;
  return all.worst;
}

}  // namespace delos
