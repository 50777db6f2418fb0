// SPDX-License-Identifier: BSD-3-Clause
#include "dual/connectivity.hpp"

#include <algorithm>

namespace delos::dual {
namespace {

constexpr std::int64_t kRowGrain = 2048;  // about 0.1 ms of table walking

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

std::span<Index> row_of(Ragged<Index>& table, std::int64_t i) {
  const auto begin = at(table.offsets[at(i)]);
  return {table.values.data() + begin, at(table.offsets[at(i) + 1]) - begin};
}

// Calls visit(triangle, corner at `vertex`) for the triangles around a vertex, counter-clockwise.
template <class Visit>
void walk_around(const Mesh& mesh, Index vertex, Index first, Visit&& visit) {
  Index tri = first;
  do {
    const Triangle& t = mesh.triangle(tri);
    const int k = corner_at(t, vertex);
    visit(tri, k);
    tri = t.neighbour[at(next_corner(k))];
  } while (tri != first);
}

// Edge j of a cell runs between its triangles j - 1 and j, so it is crossed by the side from the
// cell to the corner that follows it in triangle j.
void list_around_cells(parallel::Executor& exec, const Mesh& mesh, Grid& grid) {
  const std::vector<Index> first = triangle_at_vertex(mesh);
  auto& offsets = grid.vertices_on_cell.offsets;
  offsets = parallel::exclusive_scan(exec, mesh.n_vertices(), kRowGrain, [&](std::int64_t cell) {
    std::int64_t degree = 0;
    walk_around(mesh, static_cast<Index>(cell), first[at(cell)], [&](Index, int) { ++degree; });
    return degree;
  });
  grid.cells_on_cell.offsets = offsets;
  grid.vertices_on_cell.values.resize(at(offsets.back()));
  grid.cells_on_cell.values.resize(at(offsets.back()));
  parallel::for_index(exec, mesh.n_vertices(), kRowGrain, [&](std::int64_t cell) {
    std::size_t slot = at(offsets[at(cell)]);
    walk_around(mesh, static_cast<Index>(cell), first[at(cell)], [&](Index tri, int k) {
      grid.vertices_on_cell.values[slot] = tri;
      grid.cells_on_cell.values[slot] = mesh.triangle(tri).vertex[at(next_corner(k))];
      ++slot;
    });
  });
}

// The edge between two neighbours: the k-th edge of the lower cell that leads to a higher one.
struct EdgeNumbers {
  const Ragged<Index>& cells_on_cell;
  std::vector<std::int64_t> first;  // [n_cells + 1]

  Index between(Index c, Index d) const {
    const Index lower = std::min(c, d), higher = std::max(c, d);
    std::int64_t edge = first[at(lower)];
    for (const Index neighbour : cells_on_cell.row(lower)) {
      if (neighbour == higher) break;
      if (neighbour > lower) ++edge;
    }
    return static_cast<Index>(edge);
  }
};

EdgeNumbers number_edges(parallel::Executor& exec, const Grid& grid) {
  return {grid.cells_on_cell,
          parallel::exclusive_scan(exec, grid.n_cells(), kRowGrain, [&](std::int64_t cell) {
            std::int64_t n = 0;
            for (const Index neighbour : grid.cells_on_cell.row(cell)) n += neighbour > cell;
            return n;
          })};
}

// A cell writes its own list of edges, and the ends of the edges that it numbers.
void list_edges_of_cell(const EdgeNumbers& edges, Index cell, Grid& grid) {
  const auto neighbours = grid.cells_on_cell.row(cell);
  const auto vertices = grid.vertices_on_cell.row(cell);
  const auto own = row_of(grid.edges_on_cell, cell);
  std::int64_t next = edges.first[at(cell)];
  for (std::size_t j = 0; j < neighbours.size(); ++j) {
    if (neighbours[j] < cell) {
      own[j] = edges.between(cell, neighbours[j]);
      continue;
    }
    own[j] = static_cast<Index>(next);
    grid.cells_on_edge[at(next)] = {cell, neighbours[j]};
    grid.vertices_on_edge[at(next)] = {vertices[j == 0 ? vertices.size() - 1 : j - 1], vertices[j]};
    ++next;
  }
}

void list_edges(parallel::Executor& exec, const EdgeNumbers& edges, Grid& grid) {
  grid.edges_on_cell.offsets = grid.cells_on_cell.offsets;
  grid.edges_on_cell.values.resize(grid.cells_on_cell.values.size());
  grid.cells_on_edge.resize(at(edges.first.back()));
  grid.vertices_on_edge.resize(at(edges.first.back()));
  parallel::for_index(exec, grid.n_cells(), kRowGrain, [&](std::int64_t cell) {
    list_edges_of_cell(edges, static_cast<Index>(cell), grid);
  });
}

// Edge j of a vertex comes before its cell j: it lies between the cells j - 1 and j.
void list_around_vertices(parallel::Executor& exec, const Mesh& mesh, const EdgeNumbers& edges,
                          Grid& grid) {
  grid.cells_on_vertex.resize(mesh.triangles.size());
  grid.edges_on_vertex.resize(mesh.triangles.size());
  parallel::for_index(exec, mesh.n_triangles(), kRowGrain, [&](std::int64_t tri) {
    const auto& cell = mesh.triangles[at(tri)].vertex;
    grid.cells_on_vertex[at(tri)] = cell;
    for (int j = 0; j < 3; ++j) {
      grid.edges_on_vertex[at(tri)][at(j)] =
          edges.between(cell[at(previous_corner(j))], cell[at(j)]);
    }
  });
}

// Copies the edges of one cell that follow `edge` counter-clockwise, itself left out.
Index* copy_after(std::span<const Index> around, Index edge, Index* out) {
  const auto here = std::find(around.begin(), around.end(), edge);
  out = std::copy(here + 1, around.end(), out);
  return std::copy(around.begin(), here, out);
}

void list_edges_on_edges(parallel::Executor& exec, Grid& grid) {
  const auto& of_cell = grid.edges_on_cell;
  auto& table = grid.edges_on_edge;
  table.offsets = parallel::exclusive_scan(exec, grid.n_edges(), kRowGrain, [&](std::int64_t edge) {
    const auto [c, d] = grid.cells_on_edge[at(edge)];
    return static_cast<std::int64_t>(of_cell.row(c).size() + of_cell.row(d).size()) - 2;
  });
  table.values.resize(at(table.offsets.back()));
  parallel::for_index(exec, grid.n_edges(), kRowGrain, [&](std::int64_t edge) {
    const auto [c, d] = grid.cells_on_edge[at(edge)];
    Index* out = table.values.data() + table.offsets[at(edge)];
    out = copy_after(of_cell.row(c), static_cast<Index>(edge), out);
    copy_after(of_cell.row(d), static_cast<Index>(edge), out);
  });
}

}  // namespace

void connect(parallel::Executor& exec, const Mesh& mesh, Grid& grid) {
  list_around_cells(exec, mesh, grid);
  const EdgeNumbers edges = number_edges(exec, grid);
  list_edges(exec, edges, grid);
  list_around_vertices(exec, mesh, edges, grid);
  list_edges_on_edges(exec, grid);
}

}  // namespace delos::dual
