// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/velocity.hpp"

#include "core/error.hpp"
#include "geometry/east_north.hpp"
#include "remap/vectors.hpp"

namespace delos {
namespace {

/// Cells or edges a task: some hundred thousand operations; no result depends on it.
constexpr std::int64_t kGrain = 2048;

void check_size(std::size_t n, std::int64_t expected, const char* what) {
  DELOS_CHECK(n == at(expected), ErrorKind::input, "velocities have ", n, " values, the grid has ",
              expected, " ", what);
}

}  // namespace

void vectors_at_cells(parallel::Executor& exec, const Grid& grid, std::span<const double> normal,
                      std::span<double> east, std::span<double> north) {
  check_size(normal.size(), grid.n_edges(), "edges");
  check_size(east.size(), grid.n_cells(), "cells");
  check_size(north.size(), grid.n_cells(), "cells");
  const Array<Vec3> vectors = remap::cell_velocities(exec, grid, normal);
  parallel::for_index(exec, grid.n_cells(), kGrain, [&](std::int64_t cell) {
    const EastNorth local(grid.surface.normal(grid.cell_position[at(cell)]));
    east[at(cell)] = vectors[at(cell)].dot(local.east);
    north[at(cell)] = vectors[at(cell)].dot(local.north);
  });
}

Array<double> normals_at_edges(parallel::Executor& exec, const Grid& grid,
                               std::span<const double> east, std::span<const double> north) {
  check_size(east.size(), grid.n_cells(), "cells");
  check_size(north.size(), grid.n_cells(), "cells");
  Array<Vec3> vectors(at(grid.n_cells()));
  parallel::for_index(exec, grid.n_cells(), kGrain, [&](std::int64_t cell) {
    const EastNorth local(grid.surface.normal(grid.cell_position[at(cell)]));
    vectors[at(cell)] = east[at(cell)] * local.east + north[at(cell)] * local.north;
  });
  return remap::normal_velocities(exec, grid, vectors);
}

Array<double> relative_vorticity(parallel::Executor& exec, const Grid& grid,
                                 std::span<const double> normal) {
  check_size(normal.size(), grid.n_edges(), "edges");
  Array<double> out;
  out.resize(at(grid.n_vertices()));
  parallel::for_index(exec, grid.n_vertices(), kGrain, [&](std::int64_t vertex) {
    double circulation = 0.0;
    for (const Index edge : grid.edges_on_vertex[at(vertex)]) {
      if (edge == kNone) continue;  // beyond a border, where nothing flows
      // The normal goes counter-clockwise round the vertex on its left.
      const bool is_left = grid.vertices_on_edge[at(edge)][1] == vertex;
      const double part = normal[at(edge)] * grid.cell_distance_m[at(edge)];
      circulation += is_left ? part : -part;
    }
    out[at(vertex)] = circulation / grid.triangle_area_m2[at(vertex)];
  });
  return out;
}

Array<double> vorticity_gradient(parallel::Executor& exec, const Grid& grid,
                                 std::span<const double> normal) {
  const Array<double> vorticity = relative_vorticity(exec, grid, normal);
  // Slopes along the edges taken for components along the normals: the gradient turned by 90
  // degrees, of the same length.
  Array<double> slope(at(grid.n_edges()));
  parallel::for_index(exec, grid.n_edges(), kGrain, [&](std::int64_t edge) {
    const auto [right, left] = grid.vertices_on_edge[at(edge)];
    const double length_m = grid.vertex_distance_m[at(edge)];
    // An edge without length has no weight either.
    slope[at(edge)] =
        length_m > 0.0 ? (vorticity[at(left)] - vorticity[at(right)]) / length_m : 0.0;
  });
  const Array<Vec3> turned = remap::cell_velocities(exec, grid, slope);
  Array<double> out(at(grid.n_cells()));
  parallel::for_index(exec, grid.n_cells(), kGrain,
                      [&](std::int64_t cell) { out[at(cell)] = turned[at(cell)].norm(); });
  return out;
}

}  // namespace delos
