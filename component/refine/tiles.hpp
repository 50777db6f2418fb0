// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The fixed tiles: adaptive icosahedral triangles, split until each expects about the same number
// of vertices. They depend on the surface and the spacing alone, never on the thread count.
#include <unordered_map>
#include <vector>

#include "core/parallel.hpp"
#include "geometry/ellipsoid.hpp"
#include "sizing/spacing.hpp"

namespace delos {

/// Corners are ids into Tiling::corners, counter-clockwise seen from outside.
struct Tile {
  std::array<Index, 3> corner;
  double expected_vertices;
};

struct Tiling {
  std::vector<Vec3> corners;       ///< surface points
  std::vector<Tile> tiles;         ///< in the order of a walk through the icosahedral tree
  double expected_vertices = 0.0;  ///< of the whole surface

  /// Corner in the middle of the side (a, b) where the tile beyond is split finer; kNone if not.
  Index middle_of(Index a, Index b) const;

  std::unordered_map<std::uint64_t, Index> middles;  ///< by side_key
};

/// Key of the undirected side between two corners.
constexpr std::uint64_t side_key(Index a, Index b) {
  const auto low = static_cast<std::uint64_t>(a < b ? a : b);
  const auto high = static_cast<std::uint64_t>(a < b ? b : a);
  return (high << 32) | low;
}

/// Splits the icosahedron's faces until every tile expects at most `tile_vertices` vertices.
/// Error(resource) when the whole surface expects more than `max_vertices`, before it splits.
Tiling make_tiles(parallel::Executor& exec, const Ellipsoid& surface, const SpacingField& spacing,
                  double tile_vertices, double max_vertices);

}  // namespace delos
