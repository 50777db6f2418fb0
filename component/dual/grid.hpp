// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Grid: the finished, immutable C-grid. Cells are the Voronoi cells of the triangulation's
// vertices (cell i belongs to vertex i), grid vertices are the centres of the triangles' surface
// Delaunay balls (vertex t belongs to triangle t). Base 0, lists counter-clockwise seen from
// outside. Metres and radians.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "geometry/ellipsoid.hpp"

namespace delos {

/// Ragged table: row i is values[offsets[i]] .. values[offsets[i + 1] - 1].
template <class T>
struct Ragged {
  std::vector<std::int64_t> offsets;
  std::vector<T> values;
  std::span<const T> row(std::int64_t i) const {
    const auto begin = static_cast<std::size_t>(offsets[static_cast<std::size_t>(i)]);
    const auto end = static_cast<std::size_t>(offsets[static_cast<std::size_t>(i) + 1]);
    return {values.data() + begin, end - begin};
  }
};

struct Grid {
  Ellipsoid surface;
  LatitudeKind latitude = LatitudeKind::geodetic;

  // --- positions: surface points relative to the centre, scaled; lon in [0, 2 pi)
  std::vector<Vec3> cell_position;    // [n_cells]
  std::vector<Vec3> edge_position;    // [n_edges] where the dual edge crosses the primal edge
  std::vector<Vec3> vertex_position;  // [n_vertices]
  std::vector<LonLat> cell_lon_lat, edge_lon_lat, vertex_lon_lat;

  // --- connectivity; entry j of a cell's three lists: edge j joins vertex j-1 to vertex j, and
  //     cells_on_cell[j] is across edge j
  Ragged<Index> edges_on_cell, vertices_on_cell, cells_on_cell;
  //     an edge's normal points from its cell [0] to its cell [1], [0] < [1]; its vertex [1] is 90
  //     degrees left of that; cell j of a vertex is between its edges j and j+1
  std::vector<std::array<Index, 2>> cells_on_edge;
  std::vector<std::array<Index, 2>> vertices_on_edge;
  std::vector<std::array<Index, 3>> cells_on_vertex;
  std::vector<std::array<Index, 3>> edges_on_vertex;
  Ragged<Index> edges_on_edge;  // first those of cells_on_edge[0], then those of [1]

  // --- measures
  std::vector<double> cell_area_m2;                 // [n_cells]
  std::vector<double> triangle_area_m2;             // [n_vertices] sum of its kites
  std::vector<std::array<double, 3>> kite_area_m2;  // [n_vertices] as cells_on_vertex
  std::vector<double> cell_distance_m;              // [n_edges] between the two cells (dc)
  std::vector<double> vertex_distance_m;            // [n_edges] between the two vertices (dv)
  std::vector<double> edge_angle_rad;               // [n_edges] of the normal from local east
  Ragged<double> weights_on_edge;                   // tangential weights, as edges_on_edge
  std::vector<double> cell_spacing_m;               // [n_cells] the spacing that was asked for
  // The same at the projected middle of the two cells, [n_edges]; empty where nobody filled it in
  // (build_grid has no field). Not part of the digest.
  std::vector<double> edge_spacing_m;

  std::int64_t n_cells() const { return static_cast<std::int64_t>(cell_position.size()); }
  std::int64_t n_edges() const { return static_cast<std::int64_t>(cells_on_edge.size()); }
  std::int64_t n_vertices() const { return static_cast<std::int64_t>(vertex_position.size()); }
};

}  // namespace delos
