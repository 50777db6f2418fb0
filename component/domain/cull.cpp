// SPDX-License-Identifier: BSD-3-Clause
#include "domain/cull.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "dual/edge_weights.hpp"

namespace delos::domain {
namespace {

constexpr std::int64_t kTableGrain = 4096;  // rows of tables: tenths of a millisecond

// From old ids to new ones, kNone for what is left out, and back.
struct Numbers {
  Array<Index> new_id, old_id;
};
struct Numbering {
  Array<Index> new_cell;
  Numbers edges, vertices;
};

Array<Index> none_of(parallel::Executor& exec, std::int64_t n) {
  Array<Index> out(at(n));
  parallel::for_range(exec, n, kTableGrain, [&](std::int64_t begin, std::int64_t end) {
    std::fill(out.begin() + begin, out.begin() + end, kNone);
  });
  return out;
}

Array<Index> number_cells(parallel::Executor& exec, const Grid& grid,
                          std::span<const Index> cells) {
  DELOS_CHECK(!cells.empty(), ErrorKind::internal, "a grid of no cells was asked for.");
  Array<Index> new_cell = none_of(exec, grid.n_cells());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    DELOS_CHECK(cells[i] >= 0 && cells[i] < grid.n_cells() && new_cell[at(cells[i])] == kNone,
                ErrorKind::internal, "cell ", cells[i], " is not in the grid or named twice.");
    new_cell[at(cells[i])] = static_cast<Index>(i);
  }
  return new_cell;
}

// The lowest new cell of an element: the one that numbers it. kNone when all are left out.
template <class Cells>
Index owner_of(const Array<Index>& new_cell, const Cells& cells) {
  Index lowest = kNone;
  for (const Index cell : cells) {
    if (cell == kNone) continue;
    const Index mine = new_cell[at(cell)];
    if (mine != kNone && (lowest == kNone || mine < lowest)) lowest = mine;
  }
  return lowest;
}

// Numbers the elements in the rows of `on_cell` by (lowest new cell, order around it); `cells_of`
// gives the old cells of an element. Every element is written by the cell that owns it.
template <class Cells>
Numbers number_elements(parallel::Executor& exec, std::span<const Index> cells,
                        const Ragged<Index>& on_cell, const Array<Cells>& cells_of,
                        const Array<Index>& new_cell) {
  const auto n = static_cast<std::int64_t>(cells.size());
  const auto visit_own = [&](std::int64_t i, auto&& visit) {
    for (const Index element : on_cell.row(cells[at(i)])) {
      if (owner_of(new_cell, cells_of[at(element)]) == i) visit(element);
    }
  };
  const std::vector<std::int64_t> first =
      parallel::exclusive_scan(exec, n, kTableGrain, [&](std::int64_t i) {
        std::int64_t count = 0;
        visit_own(i, [&](Index) { ++count; });
        return count;
      });
  Numbers out{none_of(exec, static_cast<std::int64_t>(cells_of.size())),
              Array<Index>(at(first.back()))};
  parallel::for_index(exec, n, kTableGrain, [&](std::int64_t i) {
    auto next = static_cast<Index>(first[at(i)]);
    visit_own(i, [&](Index element) {
      out.old_id[at(next)] = element;
      out.new_id[at(element)] = next++;
    });
  });
  return out;
}

template <class T>
Array<T> taken(parallel::Executor& exec, const Array<T>& from, std::span<const Index> ids) {
  Array<T> out(from.empty() ? 0 : ids.size());
  parallel::for_index(exec, static_cast<std::int64_t>(out.size()), kTableGrain,
                      [&](std::int64_t i) { out[at(i)] = from[at(ids[at(i)])]; });
  return out;
}

Index renamed(const Array<Index>& new_id, Index old) {
  return old == kNone ? kNone : new_id[at(old)];
}

void take_cells(parallel::Executor& exec, const Grid& from, std::span<const Index> cells,
                const Numbering& ids, Grid& to) {
  to.cell_position = taken(exec, from.cell_position, cells);
  to.cell_lon_lat = taken(exec, from.cell_lon_lat, cells);
  to.cell_area_m2 = taken(exec, from.cell_area_m2, cells);
  to.cell_spacing_m = taken(exec, from.cell_spacing_m, cells);
  to.cell_ring = taken(exec, from.cell_ring, cells);
  const auto n = static_cast<std::int64_t>(cells.size());
  Array<std::int64_t> lengths(cells.size() + 1);
  parallel::for_index(exec, n, kTableGrain, [&](std::int64_t i) {
    lengths[at(i)] = from.edges_on_cell.offsets.length_of(cells[at(i)]);
  });
  parallel::scan_counts(exec, kTableGrain, lengths);
  const RowOffsets offsets(std::move(lengths));
  const auto take = [&](const Ragged<Index>& table, const Array<Index>& new_id) {
    Ragged<Index> out{offsets, Array<Index>(at(offsets.n_values()))};
    parallel::for_index(exec, n, kTableGrain, [&](std::int64_t i) {
      const auto row = table.row(cells[at(i)]);
      std::transform(row.begin(), row.end(), out.row(i).begin(),
                     [&](Index old) { return renamed(new_id, old); });
    });
    return out;
  };
  to.edges_on_cell = take(from.edges_on_cell, ids.edges.new_id);
  to.vertices_on_cell = take(from.vertices_on_cell, ids.vertices.new_id);
  to.cells_on_cell = take(from.cells_on_cell, ids.new_cell);
}

// The edge as seen from its lower new cell, which may be its higher old one: then all that depends
// on its direction turns round.
void take_edge(const Grid& from, const Numbering& ids, std::size_t edge, Grid& to) {
  const auto old = at(ids.edges.old_id[edge]);
  const auto [a, b] = from.cells_on_edge[old];
  const auto [v, w] = from.vertices_on_edge[old];
  const Index first = renamed(ids.new_cell, a), second = renamed(ids.new_cell, b);
  const bool stays = first != kNone && (second == kNone || first < second);
  const double angle = from.edge_angle_rad[old];
  const Index left = ids.vertices.new_id[at(w)], right = ids.vertices.new_id[at(v)];
  to.cells_on_edge[edge] = stays ? std::array{first, second} : std::array{second, first};
  to.vertices_on_edge[edge] = stays ? std::array{right, left} : std::array{left, right};
  to.edge_angle_rad[edge] = stays ? angle : angle > 0.0 ? angle - kPi : angle + kPi;
}

void take_edges(parallel::Executor& exec, const Grid& from, const Numbering& ids, Grid& to) {
  const Array<Index>& old = ids.edges.old_id;
  to.edge_position = taken(exec, from.edge_position, old);
  to.edge_lon_lat = taken(exec, from.edge_lon_lat, old);
  to.cell_distance_m = taken(exec, from.cell_distance_m, old);
  to.vertex_distance_m = taken(exec, from.vertex_distance_m, old);
  to.edge_spacing_m = taken(exec, from.edge_spacing_m, old);
  to.cells_on_edge.resize(old.size());
  to.vertices_on_edge.resize(old.size());
  to.edge_angle_rad.resize(old.size());
  parallel::for_index(exec, static_cast<std::int64_t>(old.size()), kTableGrain,
                      [&](std::int64_t edge) { take_edge(from, ids, at(edge), to); });
}

void take_vertex(const Grid& from, const Numbering& ids, std::size_t vertex, Grid& to) {
  const auto old = at(ids.vertices.old_id[vertex]);
  double area = 0.0;
  for (std::size_t j = 0; j < 3; ++j) {
    const Index cell = renamed(ids.new_cell, from.cells_on_vertex[old][j]);
    const double kite = cell == kNone ? 0.0 : from.kite_area_m2[old][j];
    to.cells_on_vertex[vertex][j] = cell;
    to.edges_on_vertex[vertex][j] = renamed(ids.edges.new_id, from.edges_on_vertex[old][j]);
    to.kite_area_m2[vertex][j] = kite;
    area += kite;
  }
  to.triangle_area_m2[vertex] = area;
}

void take_vertices(parallel::Executor& exec, const Grid& from, const Numbering& ids, Grid& to) {
  const Array<Index>& old = ids.vertices.old_id;
  to.vertex_position = taken(exec, from.vertex_position, old);
  to.vertex_lon_lat = taken(exec, from.vertex_lon_lat, old);
  to.cells_on_vertex.resize(old.size());
  to.edges_on_vertex.resize(old.size());
  to.kite_area_m2.resize(old.size());
  to.triangle_area_m2.resize(old.size());
  parallel::for_index(exec, static_cast<std::int64_t>(old.size()), kTableGrain,
                      [&](std::int64_t vertex) { take_vertex(from, ids, at(vertex), to); });
}

}  // namespace

Culled cull(parallel::Executor& exec, const Grid& grid, std::span<const Index> cells) {
  Numbering ids;
  ids.new_cell = number_cells(exec, grid, cells);
  ids.edges = number_elements(exec, cells, grid.edges_on_cell, grid.cells_on_edge, ids.new_cell);
  ids.vertices =
      number_elements(exec, cells, grid.vertices_on_cell, grid.cells_on_vertex, ids.new_cell);
  Culled out;
  out.grid.surface = grid.surface;
  out.grid.latitude = grid.latitude;
  take_cells(exec, grid, cells, ids, out.grid);
  take_edges(exec, grid, ids, out.grid);
  take_vertices(exec, grid, ids, out.grid);
  dual::weigh_edges(exec, out.grid);
  out.old_cell.assign(cells.begin(), cells.end());
  out.old_edge = std::move(ids.edges.old_id);
  out.old_vertex = std::move(ids.vertices.old_id);
  return out;
}

}  // namespace delos::domain
