// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From refined tiles to one mesh: compaction in tile order.
#include <vector>

#include "refine/front.hpp"

namespace delos {

/// Vertices: the skeleton's, then those that each tile inserted. Triangles: tile by tile.
struct Assembly {
  Mesh mesh;
  std::vector<Index> side_triangles;  ///< the triangles at the tiles' sides
  std::vector<Index> off_bounds;      ///< those that break a bound, ascending
};

/// Takes the tiles a batch at a time, so that only one batch is in memory twice.
class Assembler {
 public:
  /// Begins with the skeleton's vertices and reserves room for about `expected_vertices`.
  Assembler(parallel::Executor& exec, const Skeleton& skeleton, double expected_vertices);
  /// Appends the next tiles of the skeleton's order.
  void append(const std::vector<TileMesh>& tiles);
  /// Links the triangles across the tiles' sides.
  Assembly finish();

 private:
  struct Place;
  void write(const TileMesh& tile, const Place& place);

  parallel::Executor& exec_;
  const Skeleton& skeleton_;
  std::size_t n_tiles_ = 0;            ///< appended so far
  std::vector<TriangleSide> at_half_;  ///< by half-segment
  Assembly out_;
};

}  // namespace delos
