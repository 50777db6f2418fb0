// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>

#include "core/elementary.hpp"
#include "dual/edge_angles.hpp"
#include "dual/rules.hpp"

namespace delos::dual {
namespace {

void check_positions(const Grid& g, const char* rule, std::span<const Vec3> positions,
                     std::span<const LonLat> lon_lat, Rules& rules) {
  // Coordinates are stored to rounding, however coarse the lengths of a file are.
  constexpr double kCoordinate = 1e-11;
  rules.check(rule, static_cast<std::int64_t>(positions.size()), kCoordinate, [&](std::int64_t i) {
    const LonLat& place = lon_lat[at(i)];
    if (!(place.lon_rad >= 0.0 && place.lon_rad < 2.0 * kPi)) return 1.0;
    const Vec3& p = positions[at(i)];
    return worse((g.surface.project(p) - p).norm(),
                 (g.surface.point(place, g.latitude) - p).norm());
  });
}

// The three distances from a vertex to its cells, relative.
double radius_spread(const Grid& g, std::int64_t i) {
  double low = 1e300, high = 0.0;
  for (const Index cell : g.cells_on_vertex[at(i)]) {
    if (cell == kNone) continue;
    const double r = (g.cell_position[at(cell)] - g.vertex_position[at(i)]).norm();
    low = std::min(low, r);
    high = std::max(high, r);
  }
  return (high - low) / high;
}

bool is_border(const Grid& g, std::int64_t edge) { return g.cells_on_edge[at(edge)][1] == kNone; }

// From cell [0] to cell [1]; at a border where that would be, twice as far as the edge.
Vec3 across_edge(const Grid& g, std::int64_t i) {
  const auto [c, d] = g.cells_on_edge[at(i)];
  const Vec3& from = g.cell_position[at(c)];
  return d == kNone ? Vec3(2.0 * (g.edge_position[at(i)] - from))
                    : Vec3(g.cell_position[at(d)] - from);
}

Vec3 along_edge(const Grid& g, std::int64_t i) {
  const auto [v, w] = g.vertices_on_edge[at(i)];
  return g.vertex_position[at(w)] - g.vertex_position[at(v)];
}

// How far the edge position is off the two planes, against the lengths of the edge. At a border
// the plane of the cells is not known.
double crossing_error(const Grid& g, std::int64_t i) {
  const Vec3& e = g.edge_position[at(i)];
  const auto off_plane = [&](const Vec3& a, const Vec3& ab) {
    const Vec3 normal = a.cross(ab);
    return normal.squaredNorm() > 0.0 ? std::abs(normal.dot(e - a)) / normal.norm() : 0.0;
  };
  const Vec3& a = g.cell_position[at(g.cells_on_edge[at(i)][0])];
  const Vec3& p = g.vertex_position[at(g.vertices_on_edge[at(i)][0])];
  const Vec3 ab = across_edge(g, i), pq = along_edge(g, i);
  // The plane of two nearly equal vertices is known only to rounding over their distance.
  const double blur = 1e-15 / std::max(pq.norm(), 1e-15);
  const double off_cells = is_border(g, i) ? 0.0 : off_plane(a, ab);
  return std::max(off_cells, std::max(0.0, off_plane(p, pq) - blur)) / ab.norm();
}

// Vertex [1] lies to the left of the way from cell [0] to cell [1].
bool turns_left(const Grid& g, std::int64_t i) {
  return across_edge(g, i).cross(along_edge(g, i)).dot(g.surface.normal(g.edge_position[at(i)])) >=
         0.0;
}

double angle_error(const Grid& g, std::int64_t i) {
  const Vec3 up = g.surface.normal(g.edge_position[at(i)]);
  const Vec3 along = along_edge(g, i);
  if (along.squaredNorm() < 1e-12 * across_edge(g, i).squaredNorm()) return 0.0;
  const Vec3 normal = along.cross(up).normalized();
  const Vec3 east = Vec3(-up.y(), up.x(), 0.0).normalized();
  const auto angle = elementary::sincos(g.edge_angle_rad[at(i)]);
  if (up.x() == 0.0 && up.y() == 0.0) return 0.0;
  const double blur = 1e-15 / along.norm();
  return std::max(0.0, (angle.cos * east + angle.sin * up.cross(east) - normal).norm() - blur);
}

}  // namespace

void check_geometry(const Grid& g, double tolerance, Rules& rules) {
  check_positions(g, "cells lie on the surface, at their lon/lat", g.cell_position, g.cell_lon_lat,
                  rules);
  check_positions(g, "edges lie on the surface, at their lon/lat", g.edge_position, g.edge_lon_lat,
                  rules);
  check_positions(g, "vertices lie on the surface, at their lon/lat", g.vertex_position,
                  g.vertex_lon_lat, rules);
  rules.check("a vertex is as far from each of its cells", g.n_vertices(), tolerance,
              [&](std::int64_t i) { return radius_spread(g, i); });
  rules.check("an edge lies where its two arcs cross", g.n_edges(), tolerance,
              [&](std::int64_t i) { return crossing_error(g, i); });
  rules.check("vertices on an edge turn left of its normal", g.n_edges(), 0.0,
              [&](std::int64_t i) { return unless(turns_left(g, i)); });
  rules.check(kEdgeAngleRule, g.n_edges(), tolerance,
              [&](std::int64_t i) { return angle_error(g, i); });
  const auto length_error = [&](const Vec3& a, const Vec3& b, double length_m) {
    const double arc_m = g.surface.scale_m() * g.surface.arc_length(a, b);
    return std::abs(length_m - arc_m) / std::max(arc_m, 1e-9 * g.surface.scale_m());
  };
  rules.check("cell distances are arc lengths", g.n_edges(), tolerance, [&](std::int64_t i) {
    const auto [c, d] = g.cells_on_edge[at(i)];
    if (d == kNone) return unless(g.cell_distance_m[at(i)] > 0.0);
    return length_error(g.cell_position[at(c)], g.cell_position[at(d)], g.cell_distance_m[at(i)]);
  });
  rules.check("vertex distances are arc lengths", g.n_edges(), tolerance, [&](std::int64_t i) {
    const auto [v, w] = g.vertices_on_edge[at(i)];
    return length_error(g.vertex_position[at(v)], g.vertex_position[at(w)],
                        g.vertex_distance_m[at(i)]);
  });
}

}  // namespace delos::dual
