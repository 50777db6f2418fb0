// SPDX-License-Identifier: BSD-3-Clause
#include "dual/edge_weights.hpp"

namespace delos::dual {
namespace {

constexpr std::int64_t kWeightGrain = 1024;  // cells; about 0.2 ms

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

// What one cell needs of its surroundings, in the order of its lists. Reused from cell to cell.
struct CellRing {
  std::vector<double> share;  // kite / cell area at vertex j
  std::vector<double>
      flux_length;  // vertex distance of edge j, positive if the edge points outward
};

void gather(const Grid& grid, Index cell, CellRing& ring) {
  const auto vertices = grid.vertices_on_cell.row(cell);
  const auto edges = grid.edges_on_cell.row(cell);
  const double area = grid.cell_area_m2[at(cell)];
  ring.share.resize(edges.size());
  ring.flux_length.resize(edges.size());
  for (std::size_t j = 0; j < edges.size(); ++j) {
    const auto& cells = grid.cells_on_vertex[at(vertices[j])];
    const std::size_t corner = cells[0] == cell ? 0 : cells[1] == cell ? 1 : 2;
    // A cell of no area (only in a folded mesh) shares itself out evenly rather than by 0 / 0.
    ring.share[j] = area != 0.0 ? grid.kite_area_m2[at(vertices[j])][corner] / area
                                : 1.0 / static_cast<double>(edges.size());
    const bool outward = grid.cells_on_edge[at(edges[j])][0] == cell;
    const double length = grid.vertex_distance_m[at(edges[j])];
    ring.flux_length[j] = outward ? length : -length;
  }
}

// The half of an edge's row that goes around one of its cells, from the edge counter-clockwise.
void weigh_half(const CellRing& ring, std::size_t edge_in_ring, double scale, double* out) {
  const std::size_t n = ring.share.size();
  double swept = 0.0;
  std::size_t j = edge_in_ring;
  for (std::size_t step = 1; step < n; ++step) {
    swept += ring.share[j];
    j = j + 1 == n ? 0 : j + 1;
    *out++ = scale * (0.5 - swept) * ring.flux_length[j];
  }
}

// A cell writes its half of the rows of all its edges: every weight has one writer.
void weigh_around(const CellRing& ring, Index cell, Grid& grid) {
  const auto edges = grid.edges_on_cell.row(cell);
  for (std::size_t j = 0; j < edges.size(); ++j) {
    const auto edge = at(edges[j]);
    const bool first_half = grid.cells_on_edge[edge][0] == cell;
    const double distance = grid.cell_distance_m[edge];
    const double inverse = distance > 0.0 ? 1.0 / distance : 0.0;
    const auto& offsets = grid.weights_on_edge.offsets;
    const auto begin = first_half ? offsets[edge]
                                  : offsets[edge + 1] - static_cast<std::int64_t>(edges.size()) + 1;
    weigh_half(ring, j, first_half ? inverse : -inverse,
               grid.weights_on_edge.values.data() + begin);
  }
}

}  // namespace

void weigh_edges(parallel::Executor& exec, Grid& grid) {
  grid.weights_on_edge.offsets = grid.edges_on_edge.offsets;
  grid.weights_on_edge.values.resize(grid.edges_on_edge.values.size());
  parallel::for_range(exec, grid.n_cells(), kWeightGrain,
                      [&](std::int64_t begin, std::int64_t end) {
                        CellRing ring;
                        for (std::int64_t cell = begin; cell < end; ++cell) {
                          gather(grid, static_cast<Index>(cell), ring);
                          weigh_around(ring, static_cast<Index>(cell), grid);
                        }
                      });
}

}  // namespace delos::dual
