// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Subgrid: what one process keeps of a grid that is spread over many.
#include <array>
#include <vector>

#include "core/array.hpp"
#include "core/types.hpp"
#include "geometry/ellipsoid.hpp"

namespace delos {

/// For each neighbouring part which of our entities it needs (send) and which of its own we hold
/// (receive): local ids, in the order of their global ids, so that what `a` sends to `b` is what
/// `b` receives from `a`, one by one.
struct ExchangeLists {
  std::vector<Index> neighbours;              ///< parts, ascending
  std::vector<std::int64_t> send_offsets{0};  ///< [n_neighbours + 1]
  std::vector<std::int64_t> receive_offsets{0};
  std::vector<Index> send, receive;
};

/// The cells, edges or vertices of a part: those it owns, then its halo, layer after layer, by
/// global id within each.
struct LocalEntities {
  std::int64_t n_global = 0;
  std::vector<Index> global_id;             ///< [n]
  std::vector<Index> owner;                 ///< [n] part
  std::vector<std::int64_t> layer_offsets;  ///< layer l is [layer_offsets[l], layer_offsets[l + 1])
  ExchangeLists exchange;
  std::int64_t n_owned() const { return layer_offsets.empty() ? 0 : layer_offsets[1]; }
};

/// The arrays of Grid for local entities, with local ids; rows in the whole grid's order, kNone
/// where an entity is beyond the halo or the grid's border. The three tables around a cell share
/// their offsets, and so do an edge's neighbours and weights.
struct LocalArrays {
  Array<Vec3> cell_position, edge_position, vertex_position;
  Array<LonLat> cell_lon_lat, edge_lon_lat, vertex_lon_lat;
  Array<std::int64_t> cell_offsets, edge_offsets;
  Array<Index> edges_on_cell, vertices_on_cell, cells_on_cell;
  Array<std::array<Index, 2>> cells_on_edge, vertices_on_edge;
  Array<std::array<Index, 3>> cells_on_vertex, edges_on_vertex;
  Array<Index> edges_on_edge;
  Array<double> weights_on_edge;
  Array<double> cell_area_m2, cell_spacing_m;
  Array<std::int32_t> cell_ring;
  Array<double> cell_distance_m, vertex_distance_m, edge_angle_rad, edge_spacing_m;
  Array<double> triangle_area_m2;
  Array<std::array<double, 3>> kite_area_m2;
};

/// Cells: layer 0 is owned, layer l is l steps away from there. Edges and vertices: layer 0 is
/// owned, layer 1 the rest of those on owned cells, layer l + 1 the rest of those on cells of
/// layer l. An edge belongs to the owner of its first cell (cells_on_edge[e][0]), a vertex to that
/// of its first cell that is there.
struct Subgrid {
  Index part = 0;
  Index n_parts = 1;
  Index n_halo_layers = 1;
  LocalEntities cells, edges, vertices;
  LocalArrays arrays;  ///< every edge and vertex of a local cell is there
};

/// visit(array) for every array of a subgrid, always in the same order: what crosses to another
/// process.
template <class AnySubgrid, class Visit>
void for_each_array(AnySubgrid& subgrid, Visit&& visit) {
  const auto all = [&](auto&... arrays) { (visit(arrays), ...); };
  const auto entities = [&](auto& e) {
    all(e.global_id, e.owner, e.layer_offsets);
    auto& x = e.exchange;
    all(x.neighbours, x.send_offsets, x.receive_offsets, x.send, x.receive);
  };
  entities(subgrid.cells);
  entities(subgrid.edges);
  entities(subgrid.vertices);
  auto& a = subgrid.arrays;
  all(a.cell_position, a.edge_position, a.vertex_position);
  all(a.cell_lon_lat, a.edge_lon_lat, a.vertex_lon_lat);
  all(a.cell_offsets, a.edge_offsets);
  all(a.edges_on_cell, a.vertices_on_cell, a.cells_on_cell);
  all(a.cells_on_edge, a.vertices_on_edge, a.cells_on_vertex, a.edges_on_vertex);
  all(a.edges_on_edge, a.weights_on_edge);
  all(a.cell_area_m2, a.cell_spacing_m, a.cell_ring);
  all(a.cell_distance_m, a.vertex_distance_m, a.edge_angle_rad, a.edge_spacing_m);
  all(a.triangle_area_m2, a.kite_area_m2);
}

}  // namespace delos
