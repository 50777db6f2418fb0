// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/velocity.hpp"

#include <cmath>

#include "adapt/east_north.hpp"
#include "core/error.hpp"

namespace delos {
namespace {

/// Cells or edges a task: some hundred thousand operations; no result depends on it.
constexpr std::int64_t kGrain = 2048;

template <class I>
std::size_t at(I i) {
  return static_cast<std::size_t>(i);
}

void check_size(std::size_t n, std::int64_t expected, const char* what) {
  DELOS_CHECK(n == at(expected), ErrorKind::input, "velocities have ", n, " values, the grid has ",
              expected, " ", what);
}

/// The edge's unit normal as a Cartesian vector.
Vec3 normal_of(const Grid& grid, std::size_t edge) {
  const EastNorth local(grid.surface.normal(grid.edge_position[edge]));
  const elementary::SinCos angle = elementary::sincos(grid.edge_angle_rad[edge]);
  return angle.cos * local.east + angle.sin * local.north;
}

/// The sums of the least squares in a cell: the matrix that its vector is multiplied with.
struct Normals {
  double ee = 0.0, en = 0.0, nn = 0.0;
  void add(double weight, double east, double north) {
    ee += weight * east * east;
    en += weight * east * north;
    nn += weight * north * north;
  }
};

void fill_cell(const Grid& grid, std::int64_t cell, std::array<double, 2>* weights) {
  const EastNorth local(grid.surface.normal(grid.cell_position[at(cell)]));
  const std::span<const Index> edges = grid.edges_on_cell.row(cell);
  Normals sums;
  for (std::size_t j = 0; j < edges.size(); ++j) {
    const std::size_t edge = at(edges[j]);
    const Vec3 normal = normal_of(grid, edge);
    const double weight = grid.vertex_distance_m[edge] * grid.cell_distance_m[edge];
    const double east = normal.dot(local.east), north = normal.dot(local.north);
    sums.add(weight, east, north);
    weights[j] = {weight * east, weight * north};
  }
  const double determinant = sums.ee * sums.nn - sums.en * sums.en;
  for (std::size_t j = 0; j < edges.size(); ++j) {
    const auto [east, north] = weights[j];
    weights[j] = {(sums.nn * east - sums.en * north) / determinant,
                  (sums.ee * north - sums.en * east) / determinant};
  }
}

/// The vector of one cell from values at its edges.
template <class Value>
std::array<double, 2> vector_of(const Grid& grid, const EdgeToCell& weights, std::int64_t cell,
                                const Value& value) {
  const auto begin = grid.edges_on_cell.offsets.begin_of(cell);
  const std::span<const Index> edges = grid.edges_on_cell.row(cell);
  double east = 0.0, north = 0.0;
  for (std::size_t j = 0; j < edges.size(); ++j) {
    const auto& weight = weights.weight[at(begin) + j];
    const double component = value(at(edges[j]));
    east += weight[0] * component;
    north += weight[1] * component;
  }
  return {east, north};
}

}  // namespace

EdgeToCell edge_to_cell(parallel::Executor& exec, const Grid& grid) {
  EdgeToCell out;
  out.weight.resize(grid.edges_on_cell.values.size());
  parallel::for_index(exec, grid.n_cells(), kGrain, [&](std::int64_t cell) {
    fill_cell(grid, cell, out.weight.data() + grid.edges_on_cell.offsets.begin_of(cell));
  });
  return out;
}

void vectors_at_cells(parallel::Executor& exec, const Grid& grid, std::span<const double> normal,
                      std::span<double> east, std::span<double> north) {
  check_size(normal.size(), grid.n_edges(), "edges");
  check_size(east.size(), grid.n_cells(), "cells");
  check_size(north.size(), grid.n_cells(), "cells");
  const EdgeToCell weights = edge_to_cell(exec, grid);
  parallel::for_index(exec, grid.n_cells(), kGrain, [&](std::int64_t cell) {
    const auto vector =
        vector_of(grid, weights, cell, [&](std::size_t edge) { return normal[edge]; });
    east[at(cell)] = vector[0];
    north[at(cell)] = vector[1];
  });
}

Array<double> normals_at_edges(parallel::Executor& exec, const Grid& grid,
                               std::span<const double> east, std::span<const double> north) {
  check_size(east.size(), grid.n_cells(), "cells");
  check_size(north.size(), grid.n_cells(), "cells");
  Array<double> out;
  out.resize(at(grid.n_edges()));
  parallel::for_index(exec, grid.n_edges(), kGrain, [&](std::int64_t edge) {
    Vec3 sum(0.0, 0.0, 0.0);
    for (const Index cell : grid.cells_on_edge[at(edge)]) {
      const EastNorth local(grid.surface.normal(grid.cell_position[at(cell)]));
      sum += east[at(cell)] * local.east + north[at(cell)] * local.north;
    }
    out[at(edge)] = 0.5 * sum.dot(normal_of(grid, at(edge)));
  });
  return out;
}

Array<double> relative_vorticity(parallel::Executor& exec, const Grid& grid,
                                 std::span<const double> normal) {
  check_size(normal.size(), grid.n_edges(), "edges");
  Array<double> out;
  out.resize(at(grid.n_vertices()));
  parallel::for_index(exec, grid.n_vertices(), kGrain, [&](std::int64_t vertex) {
    double circulation = 0.0;
    for (const Index edge : grid.edges_on_vertex[at(vertex)]) {
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
                                 const EdgeToCell& weights, std::span<const double> normal) {
  const Array<double> vorticity = relative_vorticity(exec, grid, normal);
  const auto slope = [&](std::size_t edge) {
    const auto [right, left] = grid.vertices_on_edge[edge];
    const double length_m = grid.vertex_distance_m[edge];
    // An edge without length has no weight either.
    return length_m > 0.0 ? (vorticity[at(left)] - vorticity[at(right)]) / length_m : 0.0;
  };
  Array<double> out;
  out.resize(at(grid.n_cells()));
  parallel::for_index(exec, grid.n_cells(), kGrain, [&](std::int64_t cell) {
    // Slopes along the edges taken for components along the normals: the gradient turned by 90
    // degrees, of the same length.
    const auto turned = vector_of(grid, weights, cell, slope);
    out[at(cell)] = std::sqrt(turned[0] * turned[0] + turned[1] * turned[1]);
  });
  return out;
}

}  // namespace delos
