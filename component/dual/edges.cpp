// SPDX-License-Identifier: BSD-3-Clause
#include "dual/edges.hpp"

#include <array>

#include "core/elementary.hpp"
#include "core/prefetch.hpp"
#include "dual/locate.hpp"

namespace delos::dual {
namespace {

constexpr std::int64_t kEdgeGrain = 1024;  // about 0.1 ms, and arrays that fit the cache

// Below this ratio of squared lengths the direction of a dual edge is mostly rounding: four
// cocircular cells share one dual vertex, and the edge is crossed at its middle.
constexpr double kDegenerateDual = 1e-12;

// The four points around an edge and where it lies.
struct EdgeFrame {
  Vec3 a, b, along;   // its cells; b - a
  Vec3 v, w, across;  // its vertices; w - v
  bool has_dual;      // across has a direction
};

EdgeFrame frame_of(const Grid& grid, std::size_t edge) {
  const auto [c, d] = grid.cells_on_edge[edge];
  const auto [v, w] = grid.vertices_on_edge[edge];
  EdgeFrame f;
  f.a = grid.cell_position[at(c)];
  f.b = grid.cell_position[at(d)];
  f.v = grid.vertex_position[at(v)];
  f.w = grid.vertex_position[at(w)];
  f.along = f.b - f.a;
  f.across = f.w - f.v;
  f.has_dual = f.across.squaredNorm() > kDegenerateDual * f.along.squaredNorm();
  return f;
}

void prefetch_frame(const Grid& grid, std::size_t edge) {
  for (const Index cell : grid.cells_on_edge[edge]) prefetch(grid.cell_position[at(cell)]);
  for (const Index vertex : grid.vertices_on_edge[edge]) prefetch(grid.vertex_position[at(vertex)]);
}

// Fraction of the chord a b at which the plane through v, w and the centre cuts it. Only
// differences of near points are multiplied, so the result is good to rounding however near they
// are. On the sphere it is 1/2: both v and w are equidistant from a and b.
double crossing_fraction(const EdgeFrame& f) {
  if (!f.has_dual) return 0.5;
  const Vec3 normal = f.v.cross(f.across);
  const double slope = normal.dot(f.along);
  const double offset = normal.dot(f.v - f.a);
  // Off the chord (a dual far from orthogonal) or undefined: the middle serves.
  if (!(offset * slope > 0.0) || std::abs(offset) >= std::abs(slope)) return 0.5;
  return offset / slope;
}

// The normal of an edge by its parts along local east and north, both times the same length. East
// and north lie in the tangent plane; at a pole east is that of longitude 0.
struct EastNorth {
  double east, north;
};

EastNorth parts_of(const Vec3& direction, const Vec3& up) {
  const double equatorial = up.x() * up.x() + up.y() * up.y();
  if (equatorial == 0.0) return {direction.y(), up.z() > 0.0 ? -direction.x() : direction.x()};
  // east = (-up.y, up.x, 0) / sqrt(equatorial), north = up x east / |up|.
  return {
      (up.x() * direction.y() - up.y() * direction.x()) * std::sqrt(equatorial + up.z() * up.z()),
      equatorial * direction.z() - up.z() * (up.x() * direction.x() + up.y() * direction.y())};
}

EastNorth measure_edge(Grid& grid, std::size_t edge) {
  const Ellipsoid& surface = grid.surface;
  const EdgeFrame f = frame_of(grid, edge);
  const double fraction = surface.is_sphere() ? 0.5 : crossing_fraction(f);
  const Vec3 place = surface.project(f.a + fraction * f.along);
  const Vec3 up = place.cwiseProduct(surface.inverse_square());
  grid.edge_position[edge] = place;
  grid.cell_distance_m[edge] = surface.scale_m() * surface.arc_length(f.a, f.b);
  grid.vertex_distance_m[edge] = surface.scale_m() * surface.arc_length(f.v, f.w);
  // On the sphere a dual edge is orthogonal to its edge, whose direction is the sharper one.
  const bool use_along = surface.is_sphere() || !f.has_dual;
  return use_along ? parts_of(f.along, up) : parts_of(f.across.cross(up), up);
}

void measure_block(Grid& grid, std::int64_t begin, std::int64_t end) {
  std::array<double, kEdgeGrain> east, north;
  for (std::int64_t edge = begin; edge < end; ++edge) {
    if (edge + kPrefetchRounds < end) prefetch_frame(grid, at(edge + kPrefetchRounds));
    const EastNorth parts = measure_edge(grid, at(edge));
    east[at(edge - begin)] = parts.east;
    north[at(edge - begin)] = parts.north;
  }
  const std::size_t n = at(end - begin);
  elementary::atan2({north.data(), n}, {east.data(), n}, {grid.edge_angle_rad.data() + begin, n});
  locate(grid, {grid.edge_position.data() + begin, n}, {grid.edge_lon_lat.data() + begin, n});
}

}  // namespace

void measure_edges(parallel::Executor& exec, Grid& grid) {
  grid.edge_position.resize(at(grid.n_edges()));
  grid.edge_lon_lat.resize(at(grid.n_edges()));
  grid.cell_distance_m.resize(at(grid.n_edges()));
  grid.vertex_distance_m.resize(at(grid.n_edges()));
  grid.edge_angle_rad.resize(at(grid.n_edges()));
  parallel::for_range(exec, grid.n_edges(), kEdgeGrain, [&](std::int64_t begin, std::int64_t end) {
    measure_block(grid, begin, end);
  });
}

}  // namespace delos::dual
