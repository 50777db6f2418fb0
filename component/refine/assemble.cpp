// SPDX-License-Identifier: BSD-3-Clause
#include "refine/assemble.hpp"

#include <algorithm>

namespace delos {
namespace {

constexpr std::int64_t kTileGrain = 1;  // a tile is some ten thousand triangles

// Global triangle at every half-segment.
std::vector<Index> triangles_at_half_segments(const Skeleton& skeleton,
                                              const std::vector<TileMesh>& tiles,
                                              const std::vector<std::int64_t>& first_triangle) {
  std::vector<Index> at_half(2 * skeleton.segments.size(), kNone);
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const std::vector<Index>& border = skeleton.tile_half_segments[t];
    for (std::size_t slot = 0; slot < border.size(); ++slot) {
      at_half[static_cast<std::size_t>(border[slot])] =
          static_cast<Index>(first_triangle[t]) + tiles[t].border[slot];
    }
  }
  return at_half;
}

}  // namespace

Mesh assemble(parallel::Executor& exec, Skeleton& skeleton, std::vector<TileMesh>& tiles,
              std::vector<Index>& side_triangles) {
  const auto n_tiles = static_cast<std::int64_t>(tiles.size());
  const auto count = [&](auto&& size_of) {
    return parallel::exclusive_scan(exec, n_tiles, n_tiles, [&](std::int64_t t) {
      return static_cast<std::int64_t>(size_of(tiles[static_cast<std::size_t>(t)]));
    });
  };
  const auto first_triangle = count([](const TileMesh& t) { return t.triangles.size(); });
  const auto first_vertex = count([](const TileMesh& t) { return t.inserted.size(); });
  const std::vector<Index> at_half = triangles_at_half_segments(skeleton, tiles, first_triangle);

  Mesh mesh;
  mesh.vertices = std::move(skeleton.mesh.vertices);
  const auto n_skeleton = static_cast<Index>(mesh.vertices.size());
  mesh.vertices.resize(mesh.vertices.size() + static_cast<std::size_t>(first_vertex.back()));
  mesh.triangles.resize(static_cast<std::size_t>(first_triangle.back()));
  parallel::for_index(exec, n_tiles, kTileGrain, [&](std::int64_t tile) {
    const auto t = static_cast<std::size_t>(tile);
    TileMesh& source = tiles[t];
    const auto n_shared = static_cast<Index>(source.skeleton_vertices.size());
    const Index vertex_shift = n_skeleton + static_cast<Index>(first_vertex[t]) - n_shared;
    const auto triangle_shift = static_cast<Index>(first_triangle[t]);
    std::copy(source.inserted.begin(), source.inserted.end(),
              mesh.vertices.begin() + n_skeleton + first_vertex[t]);
    for (std::size_t i = 0; i < source.triangles.size(); ++i) {
      Triangle tri = source.triangles[i];
      for (std::size_t k = 0; k < 3; ++k) {
        const Index v = tri.vertex[k], n = tri.neighbour[k];
        tri.vertex[k] =
            v < n_shared ? source.skeleton_vertices[static_cast<std::size_t>(v)] : v + vertex_shift;
        if (n >= 0) {
          tri.neighbour[k] = n + triangle_shift;
        } else {
          const Index slot = ~n;
          const Index beyond = skeleton.tile_half_segments[t][static_cast<std::size_t>(slot)] ^ 1;
          tri.neighbour[k] = at_half[static_cast<std::size_t>(beyond)];
        }
      }
      mesh.triangles[static_cast<std::size_t>(first_triangle[t]) + i] = tri;
    }
    source = {};
  });
  side_triangles = at_half;
  return mesh;
}

}  // namespace delos
