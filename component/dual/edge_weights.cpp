// SPDX-License-Identifier: BSD-3-Clause
#include "dual/edge_weights.hpp"

#include <vector>

#include "dual/kites.hpp"

namespace delos::dual {
namespace {

constexpr std::int64_t kWeightGrain = 1024;  // cells; about 0.2 ms

// What one cell needs of its surroundings, in the order of its lists and once more behind that, so
// that a walk around it may begin anywhere. Degree 0 stands for any.
template <std::size_t kDegree>
struct CellRing {
  explicit CellRing(std::size_t) {}
  std::array<Index, 2 * kDegree> edge;
  std::array<double, 2 * kDegree> share;        // kite / cell area at vertex j
  std::array<double, 2 * kDegree> flux_length;  // vertex distance of edge j, outward positive
};
template <>
struct CellRing<0> {
  explicit CellRing(std::size_t n) : edge(2 * n), share(2 * n), flux_length(2 * n) {}
  std::vector<Index> edge;
  std::vector<double> share, flux_length;
};

// An edge points from the lower of its cells, [0], to the higher. A table, not a branch, which
// could not be foretold.
double sign_of_side(bool is_first) {
  constexpr std::array<double, 2> kSign = {-1.0, 1.0};
  return kSign[static_cast<std::size_t>(is_first)];
}

// Whether the edge between them points out of the cell: its neighbour is the higher, or gone.
bool points_out(Index cell, Index neighbour) {
  return static_cast<std::uint32_t>(neighbour) > static_cast<std::uint32_t>(cell);
}

template <std::size_t kDegree>
void gather(const Grid& grid, Index cell, std::size_t n, CellRing<kDegree>& ring) {
  const Index* edges = grid.edges_on_cell.row(cell).data();
  const Index* vertices = grid.vertices_on_cell.row(cell).data();
  const Index* neighbours = grid.cells_on_cell.row(cell).data();
  const double area = grid.cell_area_m2[at(cell)];
  for (std::size_t j = 0; j < n; ++j) {
    // A cell of no area (only in a folded mesh) shares itself out evenly rather than by 0 / 0.
    const double share =
        area != 0.0 ? shared_kite_m2(grid, cell, vertices[j]) / area : 1.0 / static_cast<double>(n);
    const double flux_length =
        sign_of_side(points_out(cell, neighbours[j])) * grid.vertex_distance_m[at(edges[j])];
    ring.edge[j] = ring.edge[j + n] = edges[j];
    ring.share[j] = ring.share[j + n] = share;
    ring.flux_length[j] = ring.flux_length[j + n] = flux_length;
  }
}

// A cell writes its half of the rows of all its edges, from the edge counter-clockwise: every entry
// has one writer.
template <std::size_t kDegree>
void weigh_around(Grid& grid, Index cell, std::size_t any_degree) {
  const std::size_t n = kDegree > 0 ? kDegree : any_degree;
  CellRing<kDegree> ring(n);
  gather(grid, cell, n, ring);
  const Index* neighbours = grid.cells_on_cell.row(cell).data();
  for (std::size_t j = 0; j < n; ++j) {
    const Index edge = ring.edge[j];
    const bool first_half = points_out(cell, neighbours[j]);
    const double distance = grid.cell_distance_m[at(edge)];
    const double inverse = distance > 0.0 ? 1.0 / distance : 0.0;
    const double scale = sign_of_side(first_half) * inverse;
    const RowOffsets& rows = grid.edges_on_edge.offsets;
    const auto begin =
        at(first_half ? rows.begin_of(edge) : rows.end_of(edge)) - (first_half ? 0 : n - 1);
    Index* others = grid.edges_on_edge.values.data() + begin;
    double* weights = grid.weights_on_edge.values.data() + begin;
    double swept = 0.0;
    for (std::size_t step = 0; step + 1 < n; ++step) {
      swept += ring.share[j + step];
      others[step] = ring.edge[j + step + 1];
      weights[step] = scale * (0.5 - swept) * ring.flux_length[j + step + 1];
    }
  }
}

// The usual numbers of edges are known to the compiler, which then unrolls the loops.
void weigh_around(Grid& grid, Index cell) {
  const auto n = at(grid.edges_on_cell.offsets.length_of(cell));
  switch (n) {
    case 5:
      return weigh_around<5>(grid, cell, n);
    case 6:
      return weigh_around<6>(grid, cell, n);
    case 7:
      return weigh_around<7>(grid, cell, n);
    default:
      return weigh_around<0>(grid, cell, n);
  }
}

RowOffsets rows_of_edges(parallel::Executor& exec, const Grid& grid) {
  Array<std::int64_t> counts(grid.cells_on_edge.size() + 1);
  parallel::for_index(exec, grid.n_edges(), kWeightGrain, [&](std::int64_t edge) {
    const auto [c, d] = grid.cells_on_edge[at(edge)];
    const RowOffsets& of_cell = grid.edges_on_cell.offsets;
    counts[at(edge)] = of_cell.length_of(c) - 1 + (d == kNone ? 0 : of_cell.length_of(d) - 1);
  });
  parallel::scan_counts(exec, kWeightGrain, counts);
  return RowOffsets(std::move(counts));
}

}  // namespace

void weigh_edges(parallel::Executor& exec, Grid& grid) {
  grid.edges_on_edge.offsets = grid.weights_on_edge.offsets = rows_of_edges(exec, grid);
  grid.edges_on_edge.values.resize(at(grid.edges_on_edge.offsets.n_values()));
  grid.weights_on_edge.values.resize(grid.edges_on_edge.values.size());
  parallel::for_index(exec, grid.n_cells(), kWeightGrain,
                      [&](std::int64_t cell) { weigh_around(grid, static_cast<Index>(cell)); });
}

}  // namespace delos::dual
