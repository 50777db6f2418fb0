// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A grid cut into parts for many processes, and one part with its halo. No MPI here: delos/mpi.hpp
// is built on this, and a host with communication of its own can do without that one.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "delos/export.hpp"
#include "delos/field.hpp"
#include "delos/grid.hpp"

namespace delos::api {

enum class PartitionMethod {
  automatic,  ///< kway where the library was built with METIS, else curve
  kway,       ///< METIS, multilevel k-way: short borders; curve where parts have less work than
              ///< 32 of the heaviest cells
  curve       ///< pieces of a Hilbert curve: cheap, the same with any library
};

/// What a cell counts where the host gives no weights.
enum class CellWork {
  automatic,  ///< layers where the grid has those of an ocean (section `layers`), else cells
  cells,      ///< each cell the same
  layers      ///< the wet layers of each cell; Error(config) where the grid has none
};

struct PartitionOptions {
  std::int64_t n_parts = 1;
  PartitionMethod method = PartitionMethod::automatic;
  int halo_layers = 1;  ///< 1 to 1000; one is enough for the tangential velocity at owned edges
  /// Work of each cell: [n_cells], finite, >= 0; empty = as `work` says.
  std::vector<double> cell_weight = {};
  CellWork work = CellWork::automatic;
};

/// What one process has of a grid: the cells it owns, then the halo, layer after layer, by global
/// id within each; edges and vertices likewise. An edge belongs to the owner of its first cell, a
/// vertex to that of its first cell, and every edge and vertex of a local cell is local. Ids are
/// local, 32-bit with base 0, and -1 where something lies beyond the halo; rows have the order and
/// length of the whole grid's. Units as in Grid. Copies share the arrays; a span lives as long as
/// any copy.
class DELOS_API LocalGrid {
 public:
  int part() const;         ///< from 0
  int n_parts() const;      ///< of the partition
  int halo_layers() const;  ///< of cells, around the owned ones

  // --- of Location cell, edge or vertex; Error(config) for another
  std::int64_t n_local(Location location) const;                     ///< owned and halo
  std::int64_t n_owned(Location location) const;                     ///< the first ones
  std::int64_t n_global(Location location) const;                    ///< of the whole grid
  std::span<const std::int32_t> global_id(Location location) const;  ///< [n_local] from 0
  std::span<const std::int32_t> owner(Location location) const;      ///< [n_local] part, from 0
  /// Layer l is [offsets[l], offsets[l + 1]); one more than there are layers. Cells: 0 is owned, l
  /// is l steps away. Edges and vertices: 0 is owned, 1 the rest of those on owned cells, l + 1
  /// those on cells of layer l.
  std::span<const std::int64_t> layer_offsets(Location location) const;
  /// [n_neighbours] parts to exchange with, ascending.
  std::span<const std::int32_t> neighbours(Location location) const;
  /// [n_neighbours + 1] local ids that the k-th neighbour needs of ours: send_ids [send_offsets[k],
  /// send_offsets[k + 1]), in the order in which it lists them as received.
  std::span<const std::int64_t> send_offsets(Location location) const;
  std::span<const std::int32_t> send_ids(Location location) const;
  /// [n_neighbours + 1] likewise the local ids whose values come from the k-th neighbour.
  std::span<const std::int64_t> receive_offsets(Location location) const;
  std::span<const std::int32_t> receive_ids(Location location) const;

  // --- the surface, as of Grid
  std::array<double, 3> radii_m() const;
  std::array<double, 3> centre_m() const;
  double scale_m() const;

  // --- arrays as of Grid with n_local of their kind in the place of n_cells, n_edges, n_vertices
  std::span<const double> cell_position() const;
  std::span<const double> edge_position() const;
  std::span<const double> vertex_position() const;
  std::span<const double> cell_lon_lat() const;
  std::span<const double> edge_lon_lat() const;
  std::span<const double> vertex_lon_lat() const;
  std::span<const std::int64_t> cell_offsets() const;
  std::span<const std::int32_t> edges_on_cell() const;
  std::span<const std::int32_t> vertices_on_cell() const;
  std::span<const std::int32_t> cells_on_cell() const;
  std::span<const std::int32_t> cells_on_edge() const;
  std::span<const std::int32_t> vertices_on_edge() const;
  std::span<const std::int32_t> cells_on_vertex() const;
  std::span<const std::int32_t> edges_on_vertex() const;
  std::span<const std::int64_t> edge_offsets() const;
  std::span<const std::int32_t> edges_on_edge() const;
  std::span<const double> weights_on_edge() const;
  std::span<const double> cell_area_m2() const;
  std::span<const double> cell_spacing_m() const;
  std::span<const double> edge_spacing_m() const;
  std::span<const std::int32_t> cell_ring() const;
  std::span<const double> triangle_area_m2() const;
  std::span<const double> kite_area_m2() const;
  std::span<const double> cell_distance_m() const;
  std::span<const double> vertex_distance_m() const;
  std::span<const double> edge_angle_rad() const;

  std::span<const double> level_interface_m() const;  ///< [n_levels + 1] of the whole grid
  std::span<const std::int32_t> max_level_cell() const;
  std::span<const double> bottom_depth_m() const;
  std::span<const double> ground_height_m() const;
  std::span<const double> ground_influence() const;  ///< [n_levels + 1] of the whole grid
  std::vector<double> layer_thickness_m() const;
  std::vector<double> interface_height_m() const;

  // --- to another process: its layout, kLayoutSize numbers, then the bytes of its buffers. Both
  //     sides must be the same library on machines of the same kind.
  static constexpr std::size_t kLayoutSize = 72;
  std::array<std::int64_t, kLayoutSize> layout() const;
  std::vector<std::span<const std::byte>> buffers() const;
  /// Calls fill once for each buffer, in order, to write its bytes. Error(input) for a layout that
  /// is none.
  template <class Fill>
  static LocalGrid received(const std::array<std::int64_t, kLayoutSize>& layout, Fill&& fill) {
    std::vector<std::span<std::byte>> buffers;
    LocalGrid grid = with_layout(layout, buffers);
    for (const std::span<std::byte> buffer : buffers) fill(buffer);
    return grid;
  }

 private:
  friend class Partition;
  struct Impl;
  explicit LocalGrid(std::shared_ptr<const Impl> impl);
  static LocalGrid with_layout(const std::array<std::int64_t, kLayoutSize>& layout,
                               std::vector<std::span<std::byte>>& buffers);
  std::shared_ptr<const Impl> impl_;
};

/// A grid's cells in parts. Keeps the grid. One thread at a time.
class DELOS_API Partition {
 public:
  /// No part is empty. The same for any number of threads. Error(config) for fewer cells than parts
  /// and for options out of range.
  explicit Partition(const Grid& grid, const PartitionOptions& options);
  Partition(Partition&& other) noexcept;
  Partition& operator=(Partition&& other) noexcept;
  Partition(const Partition&) = delete;
  Partition& operator=(const Partition&) = delete;
  ~Partition();

  /// [n_cells]
  std::span<const std::int32_t> part_of_cell() const;
  /// Cut out when asked for; time and memory in proportion to the part.
  LocalGrid part(int number);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace delos::api

#ifndef DELOS_BUILDING_LIBRARY
namespace delos {
using api::CellWork;
using api::LocalGrid;
using api::Partition;
using api::PartitionMethod;
using api::PartitionOptions;
}  // namespace delos
#endif
