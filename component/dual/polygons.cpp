// SPDX-License-Identifier: BSD-3-Clause
#include "dual/polygons.hpp"

#include <algorithm>
#include <tuple>

#include "core/error.hpp"
#include "dual/areas.hpp"
#include "dual/edge_weights.hpp"
#include "dual/edges.hpp"
#include "dual/locate.hpp"

namespace delos {
namespace {

// One side of a cell: entry `slot` of the cells' lists.
struct CellSide {
  Index low, high;  // its corners
  Index cell;
  std::int64_t slot;
  bool operator<(const CellSide& other) const {
    return std::tie(low, high, slot) < std::tie(other.low, other.high, other.slot);
  }
};

// The corner before entry j of a row.
Index corner_before(std::span<const Index> corners, std::size_t j) {
  return corners[j == 0 ? corners.size() - 1 : j - 1];
}

// For each entry of the cells' lists, the cell across and its entry.
struct Across {
  std::vector<Index> cell;
  std::vector<std::int64_t> slot;
};

Across match_sides(const Ragged<Index>& corners) {
  std::vector<CellSide> sides;
  sides.reserve(corners.values.size());
  for (std::int64_t cell = 0; cell < corners.offsets.n_rows(); ++cell) {
    const auto row = corners.row(cell);
    for (std::size_t j = 0; j < row.size(); ++j) {
      const Index before = corner_before(row, j);
      sides.push_back({std::min(before, row[j]), std::max(before, row[j]), static_cast<Index>(cell),
                       corners.offsets.begin_of(cell) + static_cast<std::int64_t>(j)});
    }
  }
  std::sort(sides.begin(), sides.end());
  const auto is_same = [&](std::size_t i, std::size_t k) {
    return k < sides.size() && sides[i].low == sides[k].low && sides[i].high == sides[k].high;
  };
  Across out{std::vector<Index>(sides.size(), kNone), std::vector<std::int64_t>(sides.size(), -1)};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (!is_same(i, i + 1)) continue;
    const CellSide &a = sides[i], &b = sides[i + 1];
    // Counter-clockwise cells run along their common edge in opposite directions.
    const bool is_pair =
        !is_same(i, i + 2) && corners.values[at(a.slot)] != corners.values[at(b.slot)];
    DELOS_CHECK(is_pair, ErrorKind::input, "the edge of corners ", a.low + 1, " and ", a.high + 1,
                " (from 1) has more than two cells, or two on one side, cells ", a.cell + 1,
                " and ", b.cell + 1, " among them. Voronoi cells have one on each side.");
    out.cell[at(a.slot)] = b.cell;
    out.cell[at(b.slot)] = a.cell;
    out.slot[at(a.slot)] = b.slot;
    out.slot[at(b.slot)] = a.slot;
    ++i;
  }
  return out;
}

// Cells number their edges to higher cells and to none in their order.
void connect_edges(const Across& across, Grid& grid) {
  for (std::int64_t cell = 0; cell < grid.vertices_on_cell.offsets.n_rows(); ++cell) {
    const auto corners = grid.vertices_on_cell.row(cell);
    const std::int64_t first = grid.vertices_on_cell.offsets.begin_of(cell);
    for (std::size_t j = 0; j < corners.size(); ++j) {
      const auto slot = at(first) + j;
      const Index beyond = across.cell[slot];
      if (beyond != kNone && beyond < cell) {
        grid.edges_on_cell.values[slot] = grid.edges_on_cell.values[at(across.slot[slot])];
        continue;
      }
      grid.edges_on_cell.values[slot] = static_cast<Index>(grid.cells_on_edge.size());
      grid.cells_on_edge.push_back({static_cast<Index>(cell), beyond});
      grid.vertices_on_edge.push_back({corner_before(corners, j), corners[j]});
    }
  }
}

// The edges of a cell at one of its corners: counter-clockwise around the corner `out` comes before
// the cell and `in` behind it.
struct Wedge {
  Index cell = kNone, out = kNone, in = kNone;
};

// In the order of the cells.
std::vector<std::array<Wedge, 3>> wedges_of(const Grid& grid) {
  std::vector<std::array<Wedge, 3>> out(grid.vertex_position.size());
  for (std::int64_t cell = 0; cell < grid.vertices_on_cell.offsets.n_rows(); ++cell) {
    const auto corners = grid.vertices_on_cell.row(cell);
    const auto edges = grid.edges_on_cell.row(cell);
    for (std::size_t j = 0; j < corners.size(); ++j) {
      auto& wedges = out[at(corners[j])];
      const auto free = std::find_if(wedges.begin(), wedges.end(),
                                     [](const Wedge& wedge) { return wedge.cell == kNone; });
      DELOS_CHECK(free != wedges.end(), ErrorKind::input, "corner ", corners[j] + 1,
                  " (from 1) belongs to more than three cells; this is no Voronoi diagram of "
                  "points in general position.");
      *free = {static_cast<Index>(cell), edges[(j + 1) % edges.size()], edges[j]};
    }
  }
  return out;
}

// The lowest cell stands first, that across its edge `in` second, that across `out` third.
void connect_vertices(Grid& grid) {
  const std::vector<std::array<Wedge, 3>> wedges = wedges_of(grid);
  grid.cells_on_vertex.assign(wedges.size(), {kNone, kNone, kNone});
  grid.edges_on_vertex.assign(wedges.size(), {kNone, kNone, kNone});
  for (std::size_t vertex = 0; vertex < wedges.size(); ++vertex) {
    const Wedge& first = wedges[vertex][0];
    DELOS_CHECK(first.cell != kNone, ErrorKind::input, "corner ", vertex + 1,
                " (from 1) belongs to no cell. Remove it.");
    auto& cells = grid.cells_on_vertex[vertex];
    auto& edges = grid.edges_on_vertex[vertex];
    cells[0] = first.cell;
    edges = {first.out, first.in, kNone};
    for (std::size_t i = 1; i < 3 && wedges[vertex][i].cell != kNone; ++i) {
      const Wedge& other = wedges[vertex][i];
      const bool is_second = other.out == first.in;
      const Index last = is_second ? other.in : other.out;
      const bool fits =
          (is_second || other.in == first.out) && (edges[2] == kNone || edges[2] == last);
      DELOS_CHECK(fits, ErrorKind::input, "more than three edges meet at corner ", vertex + 1,
                  " (from 1), where cells ", first.cell + 1, " and ", other.cell + 1,
                  " touch. Voronoi cells of points in general position have three there.");
      cells[is_second ? 1 : 2] = other.cell;
      edges[2] = last;
    }
  }
}

// Where the centre beyond an edge with the ends v and w must be: on the surface and as far from v
// and from w as a, on the other side. These points lie on the circle around the line v w through a,
//   x(s) = foot + cos r + sin t, cos = (s^2 - 1) / (s^2 + 1), sin = 2 s / (s^2 + 1),
// where s = 0 is opposite of a. On the sphere s = foot.r / foot.t; elsewhere Newton's method goes
// on.
Vec3 centre_beyond(const Ellipsoid& surface, const Vec3& a, const Vec3& v, const Vec3& w) {
  constexpr int kSteps = 4;            // from 1e-3, the square of which is gone after three
  constexpr double kNoLength = 1e-24;  // squared: of such an edge rounding has the direction
  const Vec3 along = w - v;
  const double square = along.squaredNorm();
  if (square <= kNoLength * (a - v).squaredNorm()) return surface.project(2.0 * v - a);
  const Vec3 foot = v + (along.dot(a - v) / square) * along;
  const Vec3 r = a - foot, t = along.cross(r) / std::sqrt(square);
  const Vec3& d = surface.inverse_square();
  double s = foot.cwiseProduct(d).dot(r) / foot.cwiseProduct(d).dot(t);
  Vec3 x = a;
  for (int step = 0; step <= kSteps; ++step) {
    const double scale = 1.0 / (s * s + 1.0);
    x = foot + ((s * s - 1.0) * scale) * r + (2.0 * s * scale) * t;
    if (surface.is_sphere()) break;
    const Vec3 slope = (4.0 * s * scale * scale) * r + (2.0 * (1.0 - s * s) * scale * scale) * t;
    s -= (x.cwiseProduct(d).dot(x) - 1.0) / (2.0 * x.cwiseProduct(d).dot(slope));
  }
  return surface.project(x);
}

// The grid with a cell beyond every edge of the border, which has no list of its own.
class Completed {
 public:
  explicit Completed(Grid& grid) : grid_(grid), n_cells_(grid.cell_position.size()) {
    offsets_ = grid.vertices_on_cell.offsets;
    for (std::size_t edge = 0; edge < grid.cells_on_edge.size(); ++edge) {
      auto& cells = grid.cells_on_edge[edge];
      if (cells[1] != kNone) continue;
      const auto [v, w] = grid.vertices_on_edge[edge];
      cells[1] = static_cast<Index>(grid.cell_position.size());
      grid.cell_position.push_back(centre_beyond(grid.surface, grid.cell_position[at(cells[0])],
                                                 grid.vertex_position[at(v)],
                                                 grid.vertex_position[at(w)]));
    }
    for (std::size_t vertex = 0; vertex < grid.cells_on_vertex.size(); ++vertex) fill(vertex);
    Array<std::int64_t> positions(offsets_.positions().begin(), offsets_.positions().end());
    positions.resize(grid.cell_position.size() + 1, positions.back());
    grid.vertices_on_cell.offsets = RowOffsets(std::move(positions));
  }

  // Takes away what was added, and the kites there.
  void undo() {
    grid_.cell_position.resize(n_cells_);
    grid_.cell_area_m2.resize(n_cells_);
    grid_.vertices_on_cell.offsets = offsets_;
    for (auto& cells : grid_.cells_on_edge) {
      if (is_added(cells[1])) cells[1] = kNone;
    }
    for (const auto& [vertex, edges] : cut_) {
      grid_.edges_on_vertex[vertex] = edges;
      double area = 0.0;
      for (std::size_t j = 0; j < 3; ++j) {
        Index& cell = grid_.cells_on_vertex[vertex][j];
        double& kite = grid_.kite_area_m2[vertex][j];
        if (is_added(cell)) {
          cell = kNone;
          kite = 0.0;
        }
        area += kite;
      }
      grid_.triangle_area_m2[vertex] = area;
    }
  }

 private:
  bool is_added(Index cell) const { return cell >= static_cast<Index>(n_cells_); }
  Index beyond(Index edge) const { return grid_.cells_on_edge[at(edge)][1]; }

  // A missing cell is that beyond either of its edges; where two are missing the edge between them
  // is, too, and any other stands for it, as only their own kites depend on it.
  void fill(std::size_t vertex) {
    auto& cells = grid_.cells_on_vertex[vertex];
    auto& edges = grid_.edges_on_vertex[vertex];
    if (std::find(cells.begin(), cells.end(), kNone) == cells.end()) return;
    cut_.push_back({vertex, edges});
    if (cells[1] == kNone) cells[1] = beyond(edges[1]);
    if (cells[2] == kNone) cells[2] = beyond(edges[0]);
    if (edges[2] == kNone) edges[2] = edges[0];
  }

  struct CutVertex {
    std::size_t vertex;
    std::array<Index, 3> edges;
  };
  Grid& grid_;
  std::size_t n_cells_;
  RowOffsets offsets_;
  std::vector<CutVertex> cut_;
};

}  // namespace

Grid grid_of_polygons(parallel::Executor& exec, const CellPolygons& cells) {
  Grid grid;
  grid.surface = cells.surface;
  grid.latitude = cells.latitude;
  grid.cell_position = cells.centre;
  grid.vertex_position = cells.corner;
  for (Ragged<Index>* table : {&grid.vertices_on_cell, &grid.cells_on_cell, &grid.edges_on_cell}) {
    *table = cells.corners_on_cell;
  }
  const Across across = match_sides(cells.corners_on_cell);
  std::copy(across.cell.begin(), across.cell.end(), grid.cells_on_cell.values.begin());
  connect_edges(across, grid);
  connect_vertices(grid);
  grid.cell_lon_lat.resize(grid.cell_position.size());
  grid.vertex_lon_lat.resize(grid.vertex_position.size());
  dual::locate(grid, grid.cell_position, grid.cell_lon_lat);
  dual::locate(grid, grid.vertex_position, grid.vertex_lon_lat);
  Completed completed(grid);
  dual::measure_edges(exec, grid);
  dual::measure_areas(exec, grid);
  completed.undo();
  dual::weigh_edges(exec, grid);
  return grid;
}

}  // namespace delos
