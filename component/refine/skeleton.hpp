// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The skeleton: points at equal h-mass along every tile side, and the Delaunay mesh of them in
// which every side is a chain of edges. The tiles are refined inside it, each on its own.
#include <vector>

#include "core/progress.hpp"
#include "refine/tiles.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// Half-segments are the two directions of a segment: 2 s runs from first to second vertex,
/// 2 s + 1 back; the partner of half-segment x is x ^ 1.
struct Skeleton {
  Mesh mesh;  ///< Delaunay; its vertices get the lowest ids of the finished mesh
  std::vector<std::array<Index, 2>> segments;  ///< vertex ids
  std::vector<std::vector<Index>>
      tile_half_segments;                          ///< the border of each tile, counter-clockwise
  std::vector<std::vector<Index>> tile_triangles;  ///< triangles of `mesh` inside each tile
};

/// Half-segment along side k of a skeleton triangle, or kNone: result[3 * tri + k].
std::vector<Index> half_segment_of_sides(const Skeleton& skeleton);

Skeleton make_skeleton(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
                       const Tiling& tiling);

}  // namespace delos
