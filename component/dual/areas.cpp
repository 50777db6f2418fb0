// SPDX-License-Identifier: BSD-3-Clause
#include "dual/areas.hpp"

#include <array>

#include "core/prefetch.hpp"
#include "dual/kites.hpp"

namespace delos::dual {
namespace {

constexpr std::int64_t kAreaGrain = 1024;  // about 0.1 ms

using Kites = std::array<double, 3>;

Kites kites_on_sphere(const Grid& grid, std::size_t vertex) {
  const Vec3& centre = grid.vertex_position[vertex];
  const auto& cells = grid.cells_on_vertex[vertex];
  std::array<double, 3> half;  // at edge j, between the cells j - 1 and j
  for (std::size_t j = 0; j < 3; ++j) {
    half[j] =
        0.5 * grid.surface.triangle_area(centre, grid.cell_position[at(cells[j == 0 ? 2 : j - 1])],
                                         grid.cell_position[at(cells[j])]);
  }
  return {half[0] + half[1], half[1] + half[2], half[2] + half[0]};
}

Kites kites_on_ellipsoid(const Grid& grid, std::size_t vertex) {
  const auto& cells = grid.cells_on_vertex[vertex];
  const auto& edges = grid.edges_on_vertex[vertex];
  std::array<Vec3, 6> ring;
  for (std::size_t j = 0; j < 3; ++j) {
    ring[2 * j] = grid.edge_position[at(edges[j])];
    ring[2 * j + 1] = grid.cell_position[at(cells[j])];
  }
  const auto area = grid.surface.fan_areas(grid.vertex_position[vertex], ring);
  return {area[0] + area[1], area[2] + area[3], area[4] + area[5]};
}

}  // namespace

void measure_areas(parallel::Executor& exec, Grid& grid) {
  const double square_metres = grid.surface.scale_m() * grid.surface.scale_m();
  const bool is_sphere = grid.surface.is_sphere();
  grid.kite_area_m2.resize(at(grid.n_vertices()));
  grid.triangle_area_m2.resize(at(grid.n_vertices()));
  parallel::for_index(exec, grid.n_vertices(), kAreaGrain, [&](std::int64_t vertex) {
    if (vertex + kPrefetchRounds < grid.n_vertices()) {
      for (const Index cell : grid.cells_on_vertex[at(vertex + kPrefetchRounds)]) {
        prefetch(grid.cell_position[at(cell)]);
      }
      for (const Index edge : grid.edges_on_vertex[at(vertex + kPrefetchRounds)]) {
        prefetch(grid.edge_position[at(edge)]);
      }
    }
    Kites kites =
        is_sphere ? kites_on_sphere(grid, at(vertex)) : kites_on_ellipsoid(grid, at(vertex));
    for (double& kite : kites) kite *= square_metres;
    grid.kite_area_m2[at(vertex)] = kites;
    grid.triangle_area_m2[at(vertex)] = kites[0] + kites[1] + kites[2];
  });
  grid.cell_area_m2.resize(at(grid.n_cells()));
  parallel::for_index(exec, grid.n_cells(), kAreaGrain, [&](std::int64_t cell) {
    double area = 0.0;
    for (const Index vertex : grid.vertices_on_cell.row(cell)) {
      area += shared_kite_m2(grid, static_cast<Index>(cell), vertex);
    }
    grid.cell_area_m2[at(cell)] = area;
  });
}

}  // namespace delos::dual
