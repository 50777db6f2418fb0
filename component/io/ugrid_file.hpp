// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One UGRID topology of dimension 2 as a file: what triangles and cells have in common.
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "io/ugrid.hpp"

namespace delos {

/// One topology, as functions of ids, so that nothing has to be copied.
struct UgridTopology {
  std::string name, long_name;
  std::int64_t n_nodes = 0, n_faces = 0, n_edges = 0;
  std::size_t max_corners = 3;
  std::function<LonLat(std::int64_t)> node, face_centre;
  std::function<double(std::int64_t)> face_area_m2;
  /// Writes the corners of a face, counter-clockwise, and returns how many.
  std::function<std::size_t(std::int64_t, std::span<Index>)> corners;
  /// Calls back with the two nodes of every edge.
  std::function<void(const std::function<void(Index, Index)>&)> for_each_edge;
  /// The spacing at edges [first, first + nodes.size() / 2), whose nodes (from 0) are given in
  /// pairs; null: not known.
  std::function<std::vector<double>(parallel::Executor& exec, std::size_t first,
                                    std::span<const Index> nodes)>
      edge_spacing_m;
  std::span<const std::int32_t> face_ring = {};  ///< Grid::cell_ring; empty: not known
  ElementNames elements;
};

/// Atomic; blocks of faces are converted while others are written.
void write_ugrid_topology(const std::string& path, const UgridTopology& topology,
                          const UgridSurface& surface, const Provenance& provenance,
                          const UgridOptions& options);

/// Bytes of the file, without its header. The two topologies have about the same size per triangle.
std::uint64_t ugrid_size_bytes(const UgridTopology& topology, const UgridOptions& options);

}  // namespace delos
