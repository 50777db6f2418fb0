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

/// Takes one tile after the other, so that few of them are in memory twice.
class Assembler {
 public:
  /// Begins with the skeleton's vertices and reserves room for about `expected_vertices`.
  Assembler(parallel::Executor& exec, const Skeleton& skeleton, double expected_vertices);
  /// Appends the next tile of the skeleton's order.
  void append(const TileMesh& tile);
  /// Links the triangles across the tiles' sides.
  Assembly finish();

 private:
  parallel::Executor& exec_;
  const Skeleton& skeleton_;
  std::size_t n_tiles_ = 0;            ///< appended so far
  std::vector<TriangleSide> at_half_;  ///< by half-segment
  Assembly out_;
};

}  // namespace delos
