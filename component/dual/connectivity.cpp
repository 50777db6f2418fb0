// SPDX-License-Identifier: BSD-3-Clause
#include "dual/connectivity.hpp"

#include <algorithm>

namespace delos::dual {
namespace {

constexpr std::int64_t kRowGrain = 2048;  // about 0.1 ms of table walking

// The next of `three` after that at the place of `mine` in `around`, counter-clockwise; chosen
// without a branch, which could not be foretold.
Index after(Index mine, const std::array<Index, 3>& around, const std::array<Index, 3>& three) {
  const Index last = around[1] == mine ? three[2] : three[0];
  return around[0] == mine ? three[1] : last;
}

// Calls visit(triangle, the vertex that follows in it) for the triangles around a vertex,
// counter-clockwise.
template <class Visit>
void walk_around(const Mesh& mesh, Index vertex, Index first, Visit&& visit) {
  Index tri = first;
  do {
    const Triangle& t = mesh.triangle(tri);
    visit(tri, after(vertex, t.vertex, t.vertex));
    tri = after(vertex, t.vertex, t.neighbour);
  } while (tri != first);
}

// What is known of every cell before its tables can be written.
struct CellCounts {
  std::vector<Index> first_triangle;  // [n_cells] where its lists begin
  Array<std::int64_t> first_entry;    // [n_cells + 1] of its lists
  Array<std::int64_t> first_edge;     // [n_cells + 1] of those that lead to a higher cell
};

CellCounts count_around_cells(parallel::Executor& exec, const Mesh& mesh) {
  const auto n_rows = mesh.vertices.size() + 1;
  CellCounts counts{triangle_at_vertex(exec, mesh), Array<std::int64_t>(n_rows),
                    Array<std::int64_t>(n_rows)};
  parallel::for_index(exec, mesh.n_vertices(), kRowGrain, [&](std::int64_t i) {
    const auto cell = static_cast<Index>(i);
    std::int64_t degree = 0, n_higher = 0;
    walk_around(mesh, cell, counts.first_triangle[at(i)], [&](Index, Index neighbour) {
      ++degree;
      n_higher += neighbour > cell;
    });
    counts.first_entry[at(i)] = degree;
    counts.first_edge[at(i)] = n_higher;
  });
  parallel::scan_counts(exec, kRowGrain, counts.first_entry);
  parallel::scan_counts(exec, kRowGrain, counts.first_edge);
  return counts;
}

void allocate(CellCounts& counts, const Mesh& mesh, Grid& grid) {
  const RowOffsets offsets(std::move(counts.first_entry));
  const auto n_edges = at(counts.first_edge.back());
  for (Ragged<Index>* table : {&grid.vertices_on_cell, &grid.cells_on_cell, &grid.edges_on_cell}) {
    table->offsets = offsets;
    table->values.resize(at(offsets.n_values()));
  }
  grid.cells_on_edge.resize(n_edges);
  grid.vertices_on_edge.resize(n_edges);
  grid.cells_on_vertex.resize(mesh.triangles.size());
  grid.edges_on_vertex.resize(mesh.triangles.size());
}

// Edge j of a cell runs between its triangles j - 1 and j, so it is crossed by the side from the
// cell to the corner that follows it in triangle j.
void list_around_cell(const Mesh& mesh, const CellCounts& counts, Index cell, Grid& grid) {
  auto slot = at(grid.vertices_on_cell.offsets.begin_of(cell));
  walk_around(mesh, cell, counts.first_triangle[at(cell)], [&](Index tri, Index neighbour) {
    grid.vertices_on_cell.values[slot] = tri;
    grid.cells_on_cell.values[slot] = neighbour;
    ++slot;
  });
}

// A cell writes all that is said of the edges to higher cells: every slot has one writer. Edge j of
// a vertex comes before its cell j: it lies between the cells j - 1 and j.
void number_edges_of_cell(const Mesh& mesh, const CellCounts& counts, Index cell, Grid& grid) {
  const auto neighbours = grid.cells_on_cell.row(cell);
  const auto vertices = grid.vertices_on_cell.row(cell);
  auto edge = static_cast<Index>(counts.first_edge[at(cell)]);
  for (std::size_t j = 0; j < neighbours.size(); ++j) {
    if (neighbours[j] < cell) continue;
    const Index before = vertices[j == 0 ? vertices.size() - 1 : j - 1];
    const Index tri = vertices[j];
    grid.cells_on_edge[at(edge)] = {cell, neighbours[j]};
    grid.vertices_on_edge[at(edge)] = {before, tri};
    const int k = own_corner_at(mesh.triangle(tri), cell);
    grid.edges_on_vertex[at(tri)][at(next_corner(k))] = edge;
    grid.edges_on_vertex[at(before)][at(own_corner_at(mesh.triangle(before), cell))] = edge;
    ++edge;
  }
}

// By now the vertices know the edges' numbers.
void list_edges_of_cell(const Mesh& mesh, Index cell, Grid& grid) {
  const auto vertices = grid.vertices_on_cell.row(cell);
  const auto edges = grid.edges_on_cell.row(cell);
  for (std::size_t j = 0; j < edges.size(); ++j) {
    edges[j] =
        after(cell, mesh.triangle(vertices[j]).vertex, grid.edges_on_vertex[at(vertices[j])]);
  }
}

}  // namespace

void connect(parallel::Executor& exec, const Mesh& mesh, Grid& grid) {
  const auto for_each_cell = [&](auto&& visit) {
    parallel::for_index(exec, mesh.n_vertices(), kRowGrain,
                        [&](std::int64_t cell) { visit(static_cast<Index>(cell)); });
  };
  CellCounts counts = count_around_cells(exec, mesh);
  allocate(counts, mesh, grid);
  parallel::for_index(exec, mesh.n_triangles(), kRowGrain, [&](std::int64_t tri) {
    grid.cells_on_vertex[at(tri)] = mesh.triangles[at(tri)].vertex;
  });
  for_each_cell([&](Index cell) {
    list_around_cell(mesh, counts, cell, grid);
    number_edges_of_cell(mesh, counts, cell, grid);
  });
  counts = {};
  for_each_cell([&](Index cell) { list_edges_of_cell(mesh, cell, grid); });
}

}  // namespace delos::dual
