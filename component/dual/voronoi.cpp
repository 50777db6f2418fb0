// SPDX-License-Identifier: BSD-3-Clause
#include "dual/voronoi.hpp"

#include <Eigen/Geometry>

namespace delos::dual {
namespace {

constexpr std::int64_t kPointGrain = 4096;  // about 0.1 ms of work

// Below this ratio of squared lengths the direction of a dual edge is mostly rounding: four
// cocircular cells share one dual vertex, and the edge is crossed at its middle.
constexpr double kDegenerateDual = 1e-12;

// Fraction of the chord a b at which the plane through v, w and the centre cuts it. Only
// differences of near points are multiplied, so the result is good to rounding however near they
// are. On the sphere it is 1/2: both v and w are equidistant from a and b.
double crossing_fraction(const Vec3& a, const Vec3& b, const Vec3& v, const Vec3& w) {
  const Vec3 along = b - a;
  const Vec3 across = w - v;
  if (across.squaredNorm() <= kDegenerateDual * along.squaredNorm()) return 0.5;
  const Vec3 normal = v.cross(across);
  const double slope = normal.dot(along);
  const double offset = normal.dot(v - a);
  // Off the chord (a dual far from orthogonal) or undefined: the middle serves.
  if (!(offset * slope > 0.0) || std::abs(offset) >= std::abs(slope)) return 0.5;
  return offset / slope;
}

}  // namespace

void place_cells_and_vertices(parallel::Executor& exec, const Mesh& mesh, Grid& grid) {
  const double scale = grid.surface.scale_m();
  grid.cell_position.resize(mesh.vertices.size());
  grid.cell_spacing_m.resize(mesh.vertices.size());
  parallel::for_index(exec, mesh.n_vertices(), kPointGrain, [&](std::int64_t i) {
    const auto cell = static_cast<std::size_t>(i);
    grid.cell_position[cell] = mesh.vertices[cell].position();
    grid.cell_spacing_m[cell] = scale * mesh.vertices[cell].spacing;
  });
  grid.vertex_position.resize(mesh.triangles.size());
  parallel::for_index(exec, mesh.n_triangles(), kPointGrain, [&](std::int64_t i) {
    const auto& corner = mesh.triangles[static_cast<std::size_t>(i)].vertex;
    grid.vertex_position[static_cast<std::size_t>(i)] = grid.surface.ball_centre(
        mesh.position(corner[0]), mesh.position(corner[1]), mesh.position(corner[2]));
  });
}

void place_edges(parallel::Executor& exec, Grid& grid) {
  grid.edge_position.resize(grid.cells_on_edge.size());
  const bool is_sphere = grid.surface.is_sphere();
  parallel::for_index(exec, grid.n_edges(), kPointGrain, [&](std::int64_t i) {
    const auto edge = static_cast<std::size_t>(i);
    const auto [c, d] = grid.cells_on_edge[edge];
    const auto [v, w] = grid.vertices_on_edge[edge];
    const Vec3& a = grid.cell_position[static_cast<std::size_t>(c)];
    const Vec3& b = grid.cell_position[static_cast<std::size_t>(d)];
    const double fraction =
        is_sphere ? 0.5
                  : crossing_fraction(a, b, grid.vertex_position[static_cast<std::size_t>(v)],
                                      grid.vertex_position[static_cast<std::size_t>(w)]);
    grid.edge_position[edge] = grid.surface.project(a + fraction * (b - a));
  });
}

}  // namespace delos::dual
