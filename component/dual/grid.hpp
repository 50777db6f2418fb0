// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Grid: the finished, immutable C-grid. Cells are the Voronoi cells of the triangulation's
// vertices (cell i belongs to vertex i), grid vertices are the centres of the triangles' surface
// Delaunay balls (vertex t belongs to triangle t). Base 0, lists counter-clockwise seen from
// outside. Metres and radians.
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "core/array.hpp"
#include "core/types.hpp"
#include "geometry/ellipsoid.hpp"

namespace delos {

/// Where the rows of a ragged table begin: n_rows + 1 positions, the last one behind the last row.
/// Never changed; copies share them, so that tables with rows of the same lengths store them once.
class RowOffsets {
 public:
  RowOffsets() = default;
  explicit RowOffsets(Array<std::int64_t> positions)
      : owner_(std::make_shared<const Array<std::int64_t>>(std::move(positions))),
        positions_(*owner_) {}

  /// Empty for a table that was never filled.
  std::span<const std::int64_t> positions() const { return positions_; }
  std::int64_t n_rows() const {
    return positions_.empty() ? 0 : static_cast<std::int64_t>(positions_.size()) - 1;
  }
  std::int64_t n_values() const { return positions_.empty() ? 0 : positions_.back(); }
  std::int64_t begin_of(std::int64_t row) const {
    return positions_[static_cast<std::size_t>(row)];
  }
  std::int64_t end_of(std::int64_t row) const {
    return positions_[static_cast<std::size_t>(row) + 1];
  }
  std::int64_t length_of(std::int64_t row) const { return end_of(row) - begin_of(row); }
  friend bool operator==(const RowOffsets& a, const RowOffsets& b) {
    return a.owner_ == b.owner_ || std::ranges::equal(a.positions_, b.positions_);
  }

 private:
  std::shared_ptr<const Array<std::int64_t>> owner_;
  std::span<const std::int64_t> positions_;
};

/// Ragged table: row i is values[offsets.begin_of(i)] .. values[offsets.end_of(i) - 1].
template <class T>
struct Ragged {
  RowOffsets offsets;
  Array<T> values;
  std::span<const T> row(std::int64_t i) const {
    return {values.data() + offsets.begin_of(i), static_cast<std::size_t>(offsets.length_of(i))};
  }
  std::span<T> row(std::int64_t i) {
    return {values.data() + offsets.begin_of(i), static_cast<std::size_t>(offsets.length_of(i))};
  }
};

struct Grid {
  Ellipsoid surface;
  LatitudeKind latitude = LatitudeKind::geodetic;

  // --- positions: surface points relative to the centre, scaled; lon in [0, 2 pi)
  Array<Vec3> cell_position;    // [n_cells]
  Array<Vec3> edge_position;    // [n_edges] where the dual edge crosses the primal edge
  Array<Vec3> vertex_position;  // [n_vertices]
  Array<LonLat> cell_lon_lat, edge_lon_lat, vertex_lon_lat;

  // --- connectivity; entry j of a cell's three lists: edge j joins vertex j-1 to vertex j, and
  //     cells_on_cell[j] is across edge j
  Ragged<Index> edges_on_cell, vertices_on_cell, cells_on_cell;
  //     an edge's normal points from its cell [0] to its cell [1], [0] < [1]; its vertex [1] is 90
  //     degrees left of that; cell j of a vertex is between its edges j and j+1.
  //     A grid of a part of the surface has a border. There kNone stands in cells_on_cell, in
  //     cells_on_edge[1] (the normal points out), and in cells_on_vertex and edges_on_vertex at the
  //     place of what is gone. Edges and vertices belong to at least one cell; a cell has all its
  //     edges and vertices
  Array<std::array<Index, 2>> cells_on_edge;
  Array<std::array<Index, 2>> vertices_on_edge;
  Array<std::array<Index, 3>> cells_on_vertex;
  Array<std::array<Index, 3>> edges_on_vertex;
  Ragged<Index> edges_on_edge;  // first those of cells_on_edge[0], then those of [1] if any

  // --- measures
  Array<double> cell_area_m2;                 // [n_cells]
  Array<double> triangle_area_m2;             // [n_vertices] sum of its kites
  Array<std::array<double, 3>> kite_area_m2;  // [n_vertices] as cells_on_vertex; 0 where none
  // [n_edges] between the two cells (dc); at a border as far as the cell that is gone was
  Array<double> cell_distance_m;
  Array<double> vertex_distance_m;  // [n_edges] between the two vertices (dv)
  Array<double> edge_angle_rad;     // [n_edges] of the normal from local east
  Ragged<double> weights_on_edge;   // tangential weights, as edges_on_edge
  Array<double> cell_spacing_m;     // [n_cells] the spacing that was asked for
  // The same at the projected middle of the two cells, [n_edges]; empty where nobody filled it in
  // (build_grid has no field). Not part of the digest.
  Array<double> edge_spacing_m;
  // Of a regional grid, [n_cells]: 0 inside, 1, 2, ... in the rings from there to the border, kNone
  // beyond it (until culled). Empty for other grids.
  Array<std::int32_t> cell_ring;

  std::int64_t n_cells() const { return static_cast<std::int64_t>(cell_position.size()); }
  std::int64_t n_edges() const { return static_cast<std::int64_t>(cells_on_edge.size()); }
  std::int64_t n_vertices() const { return static_cast<std::int64_t>(vertex_position.size()); }
};

/// The ring of an edge or vertex of a regional grid: the innermost of its cells that are there.
template <std::size_t kCells>
std::int32_t ring_of(const Grid& grid, const std::array<Index, kCells>& cells) {
  std::int32_t least = kNone;
  for (const Index cell : cells) {
    if (cell == kNone) continue;
    const std::int32_t ring = grid.cell_ring[static_cast<std::size_t>(cell)];
    if (least == kNone || (ring != kNone && ring < least)) least = ring;
  }
  return least;
}

/// Whether the cells cover the whole surface: no table holds kNone.
inline bool is_closed(const Grid& grid) {
  const auto is_complete = [](const auto& cells) {
    return std::ranges::find(cells, kNone) == cells.end();
  };
  return std::ranges::all_of(grid.cells_on_vertex, is_complete) &&
         std::ranges::all_of(grid.cells_on_edge, is_complete);
}

}  // namespace delos
