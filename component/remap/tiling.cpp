// SPDX-License-Identifier: BSD-3-Clause
#include "remap/tiling.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace delos::remap {
namespace {

constexpr std::int64_t kTriangleGrain = 4096;  // about 0.1 ms

// Of the first cell of each edge. They are rounding themselves: single precision is plenty.
Array<float> bows_of_edges(parallel::Executor& exec, const Grid& grid) {
  const bool is_sphere = grid.surface.is_sphere();
  Array<float> bow(at(grid.n_edges()));
  parallel::for_index(exec, grid.n_edges(), kTriangleGrain, [&](std::int64_t edge) {
    if (edge + kPrefetchRounds < grid.n_edges()) {
      const auto next = at(edge + kPrefetchRounds);
      prefetch(grid.cell_position[at(grid.cells_on_edge[next][0])]);
      prefetch(grid.cell_position[at(std::max(grid.cells_on_edge[next][1], 0))]);
      for (const Index id : grid.vertices_on_edge[next]) prefetch(grid.vertex_position[at(id)]);
    }
    const auto [c, d] = grid.cells_on_edge[at(edge)];
    const auto [v, w] = grid.vertices_on_edge[at(edge)];
    const Vec3& from = grid.vertex_position[at(v)];
    // Areas on the sphere halve the triangles between the two cells; they know no edge.
    // At a border the other cell is not known: what the edge is off is rounding all the same.
    const Vec3 middle = is_sphere && d != kNone
                            ? Vec3(0.5 * (grid.cell_position[at(c)] + grid.cell_position[at(d)]))
                            : grid.edge_position[at(edge)];
    // Surface over solid angle: |W y| where y W y = 1, and 1 on the sphere.
    const double density = from.cwiseProduct(grid.surface.inverse_square()).norm();
    bow[at(edge)] = static_cast<float>(
        0.5 * density * from.dot((middle - from).cross(grid.vertex_position[at(w)] - from)));
  });
  return bow;
}

}  // namespace

Tiling Tiling::cells(parallel::Executor& exec, const Grid& grid) {
  Tiling tiling;
  tiling.grid_ = &grid;
  tiling.is_closed_ = delos::is_closed(grid);
  tiling.corner_position_ = grid.vertex_position;
  tiling.area_m2_ = grid.cell_area_m2;
  const Array<float> of_edge = bows_of_edges(exec, grid);
  tiling.bow_.resize(grid.edges_on_cell.values.size());
  parallel::for_index(exec, grid.n_cells(), kTriangleGrain, [&](std::int64_t i) {
    float* bow = tiling.bow_.data() + grid.edges_on_cell.offsets.begin_of(i);
    for (const Index edge : grid.edges_on_cell.row(i)) {
      *bow++ = grid.cells_on_edge[at(edge)][0] == i ? of_edge[at(edge)] : -of_edge[at(edge)];
    }
  });
  return tiling;
}

Tiling Tiling::triangles(parallel::Executor& exec, const Grid& grid) {
  DELOS_CHECK(delos::is_closed(grid), ErrorKind::input, "a grid of ", grid.n_cells(),
              " cells has a border, where its triangles lack corners: carry fields of cells, or "
              "fields of triangles between the grids before they are culled.");
  Tiling tiling;
  tiling.grid_ = &grid;
  tiling.of_cells_ = false;
  tiling.corner_position_ = grid.cell_position;
  tiling.area_m2_ = grid.triangle_area_m2;
  tiling.beside_triangle_.resize(at(grid.n_vertices()));
  tiling.own_centre_.resize(at(grid.n_vertices()));
  parallel::for_index(exec, grid.n_vertices(), kTriangleGrain, [&](std::int64_t i) {
    const auto& cells = grid.cells_on_vertex[at(i)];
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      // Cell k lies between edges k and k + 1, so edge k crosses the side from cell k - 1 to k.
      const auto& ends = grid.vertices_on_edge[at(grid.edges_on_vertex[at(i)][k])];
      tiling.beside_triangle_[at(i)][k] = ends[0] == static_cast<Index>(i) ? ends[1] : ends[0];
      sum += grid.cell_position[at(cells[k])];
    }
    tiling.own_centre_[at(i)] = grid.surface.project(sum);
  });
  return tiling;
}

}  // namespace delos::remap
