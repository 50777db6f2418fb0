// SPDX-License-Identifier: BSD-3-Clause
#include "dual/rules.hpp"

namespace delos::dual {
namespace {

template <class T>
bool is_table(const Ragged<T>& table, std::int64_t n_rows) {
  const auto positions = table.offsets.positions();
  return table.offsets.n_rows() == n_rows && !positions.empty() && positions[0] == 0 &&
         std::is_sorted(positions.begin(), positions.end()) &&
         table.offsets.n_values() == static_cast<std::int64_t>(table.values.size());
}

template <class Row>
bool in_range(const Row& ids, std::int64_t n) {
  return std::all_of(ids.begin(), ids.end(), [&](Index id) { return id >= 0 && id < n; });
}

// The same where a grid with a border has kNone.
template <class Row>
bool in_range_or_none(const Row& ids, std::int64_t n) {
  return std::all_of(ids.begin(), ids.end(), [&](Index id) { return id >= kNone && id < n; });
}

// A vertex has a cell, and those edges that lie beside a cell.
bool borders_agree(const std::array<Index, 3>& cells, const std::array<Index, 3>& edges) {
  bool agree = cells[0] != kNone || cells[1] != kNone || cells[2] != kNone;
  for (std::size_t j = 0; j < 3; ++j) {
    const bool has_cell = cells[j] != kNone || cells[(j + 2) % 3] != kNone;
    agree = agree && has_cell == (edges[j] != kNone);
  }
  return agree;
}

bool cell_lists_agree(const Grid& g, std::int64_t i) {
  const auto edges = g.edges_on_cell.row(i);
  const auto vertices = g.vertices_on_cell.row(i);
  const auto cells = g.cells_on_cell.row(i);
  for (std::size_t j = 0; j < edges.size(); ++j) {
    const auto& ends = g.cells_on_edge[at(edges[j])];
    const std::size_t side = ends[0] == i ? 0 : 1;
    const auto& through = g.vertices_on_edge[at(edges[j])];
    const Index before = vertices[j == 0 ? vertices.size() - 1 : j - 1];
    if (ends[side] != i || ends[1 - side] != cells[j]) return false;
    if (through[side] != before || through[1 - side] != vertices[j]) return false;
  }
  return true;
}

bool vertex_lists_agree(const Grid& g, std::int64_t i) {
  const auto& cells = g.cells_on_vertex[at(i)];
  const auto& edges = g.edges_on_vertex[at(i)];
  for (std::size_t j = 0; j < 3; ++j) {
    if (edges[j] == kNone) continue;
    const auto& ends = g.cells_on_edge[at(edges[j])];
    const auto& through = g.vertices_on_edge[at(edges[j])];
    const std::size_t side = ends[0] == cells[j] ? 0 : 1;
    if (ends[side] != cells[j] || ends[1 - side] != cells[(j + 2) % 3]) return false;
    if (through[0] != i && through[1] != i) return false;
  }
  return true;
}

// First the edges of cell [0] after this one, counter-clockwise, then those of cell [1].
bool edge_list_agrees(const Grid& g, std::int64_t i) {
  const auto row = g.edges_on_edge.row(i);
  std::size_t next = 0;
  for (const Index cell : g.cells_on_edge[at(i)]) {
    if (cell == kNone) continue;
    const auto around = g.edges_on_cell.row(cell);
    const auto here = std::find(around.begin(), around.end(), static_cast<Index>(i));
    if (here == around.end()) return false;
    const auto start = static_cast<std::size_t>(here - around.begin());
    for (std::size_t step = 1; step < around.size(); ++step) {
      if (next == row.size() || row[next++] != around[(start + step) % around.size()]) return false;
    }
  }
  return next == row.size();
}

}  // namespace

bool has_sizes(const Grid& g) {
  const auto cells = at(g.n_cells()), edges = at(g.n_edges()), vertices = at(g.n_vertices());
  const bool on_cells = g.cell_lon_lat.size() == cells && g.cell_area_m2.size() == cells &&
                        is_table(g.edges_on_cell, g.n_cells()) &&
                        g.vertices_on_cell.offsets == g.edges_on_cell.offsets &&
                        g.cells_on_cell.offsets == g.edges_on_cell.offsets &&
                        g.vertices_on_cell.values.size() == g.edges_on_cell.values.size() &&
                        g.cells_on_cell.values.size() == g.edges_on_cell.values.size();
  const bool on_edges = g.edge_position.size() == edges && g.edge_lon_lat.size() == edges &&
                        g.vertices_on_edge.size() == edges && g.cell_distance_m.size() == edges &&
                        g.vertex_distance_m.size() == edges && g.edge_angle_rad.size() == edges &&
                        is_table(g.edges_on_edge, g.n_edges()) &&
                        g.weights_on_edge.offsets == g.edges_on_edge.offsets &&
                        g.weights_on_edge.values.size() == g.edges_on_edge.values.size();
  const bool on_vertices =
      g.vertex_lon_lat.size() == vertices && g.cells_on_vertex.size() == vertices &&
      g.edges_on_vertex.size() == vertices && g.triangle_area_m2.size() == vertices &&
      g.kite_area_m2.size() == vertices;
  return on_cells && on_edges && on_vertices;
}

void check_ids(const Grid& g, Rules& rules) {
  rules.check("ids on cells are in range and a cell has at least three edges", g.n_cells(), 0.0,
              [&](std::int64_t i) {
                return unless(g.edges_on_cell.row(i).size() >= 3 &&
                              in_range(g.edges_on_cell.row(i), g.n_edges()) &&
                              in_range(g.vertices_on_cell.row(i), g.n_vertices()) &&
                              in_range_or_none(g.cells_on_cell.row(i), g.n_cells()));
              });
  rules.check("ids on edges are in range", g.n_edges(), 0.0, [&](std::int64_t i) {
    const auto [first, second] = g.cells_on_edge[at(i)];
    return unless(first >= 0 && in_range_or_none(std::array{first, second}, g.n_cells()) &&
                  in_range(g.vertices_on_edge[at(i)], g.n_vertices()) &&
                  in_range(g.edges_on_edge.row(i), g.n_edges()));
  });
  rules.check("ids on vertices are in range", g.n_vertices(), 0.0, [&](std::int64_t i) {
    return unless(in_range_or_none(g.cells_on_vertex[at(i)], g.n_cells()) &&
                  in_range_or_none(g.edges_on_vertex[at(i)], g.n_edges()) &&
                  borders_agree(g.cells_on_vertex[at(i)], g.edges_on_vertex[at(i)]));
  });
}

void check_order(const Grid& g, Rules& rules) {
  rules.check("the lists of a cell agree (edge j from vertex j-1 to j, cell j across it)",
              g.n_cells(), 0.0, [&](std::int64_t i) { return unless(cell_lists_agree(g, i)); });
  rules.check("the lists of a vertex agree (cell j between edges j and j+1)", g.n_vertices(), 0.0,
              [&](std::int64_t i) { return unless(vertex_lists_agree(g, i)); });
  rules.check("an edge runs from its lower to its higher cell", g.n_edges(), 0.0,
              [&](std::int64_t i) {
                const auto [first, second] = g.cells_on_edge[at(i)];
                return unless(second == kNone || first < second);
              });
  rules.check("edges on edges run around the first cell, then the second", g.n_edges(), 0.0,
              [&](std::int64_t i) { return unless(edge_list_agrees(g, i)); });
}

}  // namespace delos::dual
