// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The skeleton: points at equal h-mass along every tile side, and the Delaunay mesh of them in
// which every side is a chain of edges, and so is every arc of the given lines. The tiles are
// refined inside it, each on its own.
#include <vector>

#include "core/progress.hpp"
#include "refine/line_network.hpp"
#include "refine/tiles.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// Half-segments are the two directions of a segment: 2 s runs from first to second vertex,
/// 2 s + 1 back; the partner of half-segment x is x ^ 1.
struct Skeleton {
  Mesh mesh;  ///< Delaunay; its vertices get the lowest ids of the finished mesh, fixed ones first
  std::vector<std::array<Index, 2>> segments;  ///< vertex ids
  std::vector<std::vector<Index>>
      tile_half_segments;  ///< the border of each tile; counter-clockwise where no line runs
  std::vector<std::vector<Index>> tile_triangles;  ///< triangles of `mesh` inside each tile
};

/// Half-segment along side k of a skeleton triangle, or kNone: result[3 * tri + k].
std::vector<Index> half_segment_of_sides(const Skeleton& skeleton);

/// What the vertices of the skeleton are for.
struct SkeletonInput {
  const Tiling& tiling;
  const LineNetwork& lines;  ///< may be empty
};

/// Where a side of a tile comes near to a given line it goes through the line's vertices, or has a
/// gap through which two tiles become one; no vertex of a side is near to a line. A line may cut a
/// tile in two or enclose a part of it. Error(input) when lines are too near to each other.
Skeleton make_skeleton(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
                       const SkeletonInput& input);

}  // namespace delos
