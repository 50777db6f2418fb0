// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The finished grid: an immutable C-grid whose arrays are handed out without a copy.
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "delos/export.hpp"

namespace delos::api {

struct GridAccess;

/// Numbers of the certificate and the report, over the whole grid.
struct Quality {
  bool well_centred;      ///< every triangle is acute, so every dual edge crosses its primal
  std::int64_t n_obtuse;  ///< triangles with an angle >= 90 degrees
  double min_angle_deg;
  double max_angle_deg;
  double min_area_length;  ///< 4 sqrt(3)/3 area / rms(edge)^2, 1 = equilateral
  double mean_area_length;
  double min_relative_edge;  ///< edge length / wanted spacing
  double max_relative_edge;
  double min_dual_ratio;     ///< shortest dual edge / its primal edge
  double degree_6_fraction;  ///< share of hexagons
};

/// The worst element of one measure.
struct Worst {
  double value;
  std::int64_t id;                    ///< from 0, into the arrays of Grid: a vertex or an edge
  std::array<std::int64_t, 2> cells;  ///< of the edge, from 0; -1 for a vertex
  double lon_rad, lat_rad;            ///< [0, 2 pi), of the configured kind
};

/// What a C-grid model needs to know before it trusts the grid. The same numbers stand in every
/// file (delos_*, ids from 1) and in the report.
struct Certificate {
  bool well_centred;             ///< every triangle is acute, so every dual edge crosses its primal
  double well_centred_fraction;  ///< of the triangles
  std::int64_t n_obtuse;         ///< the others
  bool spacing_kept;             ///< relative_edge_min.value >= relative_edge_bound
  double relative_edge_bound;    ///< 0.65
  Worst relative_edge_min;       ///< an edge: length / wanted spacing
  Worst dual_ratio_min;          ///< an edge: its dual's length / its own
  Worst stagger_max;             ///< an edge: distance of its middle from its dual's / its length
  Worst angle_max_deg;           ///< a vertex (triangle): largest angle
};

/// Cells are Voronoi polygons, grid vertices are their corners (one for each triangle), edges lie
/// between two cells. Ids are 32-bit with base 0, counts are 64-bit. Lists around a cell or a
/// vertex run counter-clockwise seen from outside. Lengths in metres, angles in radians.
/// Copies share the arrays. A span lives as long as any copy of its grid.
class DELOS_API Grid {
 public:
  Grid(const Grid& other);
  Grid(Grid&& other) noexcept;
  Grid& operator=(const Grid& other);
  Grid& operator=(Grid&& other) noexcept;
  ~Grid();

  std::int64_t n_cells() const;
  std::int64_t n_edges() const;
  std::int64_t n_vertices() const;
  /// Edges of the cell that has most.
  std::int64_t max_edges() const;

  /// 1 for a grid fresh from generate(); grows when a component rebuilds its grid.
  std::int64_t generation() const;
  /// SHA-256 of the triangulation: equal iff two grids are the same to the last bit.
  const std::string& digest() const;
  const Quality& quality() const;
  const Certificate& certificate() const;
  /// The effective configuration that made this grid.
  const std::string& config_text() const;
  /// The report on one screen, and as JSON.
  const std::string& report() const;
  const std::string& report_json() const;

  // --- the surface: x = centre_m + scale_m * position
  std::array<double, 3> radii_m() const;
  std::array<double, 3> centre_m() const;
  /// Metres per unit of the position arrays (the largest radius).
  double scale_m() const;

  // --- positions: [n, 3] Cartesian, relative to the centre, in units of scale_m
  std::span<const double> cell_position() const;
  std::span<const double> edge_position() const;
  std::span<const double> vertex_position() const;
  // --- [n, 2] longitude in [0, 2 pi) and latitude of the configured kind, radians
  std::span<const double> cell_lon_lat() const;
  std::span<const double> edge_lon_lat() const;
  std::span<const double> vertex_lon_lat() const;

  // --- tables around a cell are ragged: those of cell i are values [offsets[i], offsets[i + 1])
  //     and entry j of each belongs to edge j, which joins vertex j - 1 to vertex j.
  //     With a section `domain` or `region` the grid has a border: -1 stands in cells_on_cell, in
  //     cells_on_edge[1] (the normal points out), cells_on_vertex and edges_on_vertex where there
  //     is nothing, a kite there is 0, and the ragged tables are shorter than 2 n_edges
  std::span<const std::int64_t> cell_offsets() const;      ///< [n_cells + 1]
  std::span<const std::int32_t> edges_on_cell() const;     ///< [2 n_edges]
  std::span<const std::int32_t> vertices_on_cell() const;  ///< [2 n_edges]
  std::span<const std::int32_t> cells_on_cell() const;     ///< [2 n_edges] across edge j
  std::span<const std::int32_t> cells_on_edge() const;     ///< [n_edges, 2] normal: [0] to [1]
  std::span<const std::int32_t> vertices_on_edge() const;  ///< [n_edges, 2] left of the normal
  std::span<const std::int32_t> cells_on_vertex() const;   ///< [n_vertices, 3]
  std::span<const std::int32_t> edges_on_vertex() const;   ///< [n_vertices, 3] j before cell j
  /// Neighbours of an edge's tangential reconstruction: first those of cell [0], then of [1].
  std::span<const std::int64_t> edge_offsets() const;   ///< [n_edges + 1]
  std::span<const std::int32_t> edges_on_edge() const;  ///< [edge_offsets.back()]
  std::span<const double> weights_on_edge() const;      ///< as edges_on_edge
  /// With a section `region`, [n_cells]: 0 inside, 1, 2, ... in the rings from there to the border,
  /// as MPAS's bdyMaskCell; that of an edge or vertex is the least of its cells. Else empty.
  std::span<const std::int32_t> cell_ring() const;

  // --- measures
  std::span<const double> cell_area_m2() const;       ///< [n_cells] sums to the surface's area
  std::span<const double> cell_spacing_m() const;     ///< [n_cells] the spacing asked for
  std::span<const double> edge_spacing_m() const;     ///< [n_edges] the same amid the two cells
  std::span<const double> triangle_area_m2() const;   ///< [n_vertices]
  std::span<const double> kite_area_m2() const;       ///< [n_vertices, 3] as cells_on_vertex
  std::span<const double> cell_distance_m() const;    ///< [n_edges] between the two cells
  std::span<const double> vertex_distance_m() const;  ///< [n_edges] between the two vertices
  std::span<const double> edge_angle_rad() const;     ///< [n_edges] of the normal from east

  // --- the vertical, with a section `layers`; else all empty
  /// [n_levels + 1], ascending, 0 first: of an ocean (kind z_level) the depth of the interfaces
  /// between levels, of an atmosphere (terrain_following) their height over flat ground.
  std::span<const double> level_interface_m() const;
  /// Of an ocean, [n_cells]: the layers of each cell, from the surface down; 0 on land. The number
  /// of the deepest one from 1, as MPAS's maxLevelCell.
  std::span<const std::int32_t> max_level_cell() const;
  /// Of an ocean, [n_cells]: positive down, of the partial bottom cell; 0 on land.
  std::span<const double> bottom_depth_m() const;
  /// Of an atmosphere, [n_cells]: the smoothed ground above sea level.
  std::span<const double> ground_height_m() const;
  /// Of an atmosphere, [n_levels + 1]: interface k of a cell is at level_interface_m[k] +
  /// ground_influence[k] * ground_height_m of the cell; 1 first.
  std::span<const double> ground_influence() const;
  /// [n_cells, n_levels] a new array: the thickness at rest; 0 below an ocean's bottom.
  std::vector<double> layer_thickness_m() const;
  /// [n_cells, n_levels + 1] a new array: the height of each interface above sea level, an
  /// atmosphere's from the ground up (MPAS's zgrid), an ocean's from 0 down to the bottom.
  std::vector<double> interface_height_m() const;

  // --- files: each appears whole or not at all; Error(output) says why not
  void write_mpas(const std::string& path) const;
  /// The Voronoi cells as UGRID faces.
  void write_ugrid_cells(const std::string& path) const;
  /// The triangles as UGRID faces.
  void write_ugrid_triangles(const std::string& path) const;
  /// report.json's content.
  void write_report(const std::string& path) const;
  /// What the configuration's `output` section names, all or nothing; `directory` replaces the
  /// configured one unless empty. The paths written.
  std::vector<std::string> write_outputs(const std::string& directory = "") const;

 private:
  friend struct GridAccess;
  struct Impl;
  explicit Grid(std::shared_ptr<const Impl> impl);
  std::shared_ptr<const Impl> impl_;
};

}  // namespace delos::api

#ifndef DELOS_BUILDING_LIBRARY
namespace delos {
using api::Certificate;
using api::Grid;
using api::Quality;
using api::Worst;
}  // namespace delos
#endif
