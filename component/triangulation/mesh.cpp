// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/mesh.hpp"

#include <algorithm>
#include <array>

#include "core/hash.hpp"

namespace delos {

bool FixedEdges::has_edge(Index a, Index b) const {
  if (!has_vertex(a) || !has_vertex(b)) return false;
  const auto begin = ends.begin() + offsets[static_cast<std::size_t>(a)];
  const auto end = ends.begin() + offsets[static_cast<std::size_t>(a) + 1];
  return std::find(begin, end, b) != end;  // two, but for the few where lines meet
}

std::vector<Index> triangle_at_vertex(const Mesh& mesh) {
  std::vector<Index> at(mesh.vertices.size(), kNone);
  for (Index tri = mesh.n_triangles() - 1; tri >= 0; --tri) {
    for (const Index vertex : mesh.triangle(tri).vertex) at[static_cast<std::size_t>(vertex)] = tri;
  }
  return at;
}

std::vector<Index> triangle_at_vertex(parallel::Executor& exec, const Mesh& mesh) {
  if (exec.n_threads() == 1) return triangle_at_vertex(mesh);  // needs no shared writes
  constexpr std::int64_t kGrain = 16384;                       // triangles; about 0.1 ms
  std::vector<Index> at(mesh.vertices.size(), kNone);
  parallel::for_index(exec, mesh.n_triangles(), kGrain, [&](std::int64_t tri) {
    for (const Index vertex : mesh.triangle(static_cast<Index>(tri)).vertex) {
      parallel::lower_to(at[static_cast<std::size_t>(vertex)], static_cast<Index>(tri));
    }
  });
  return at;
}

std::string digest(const Mesh& mesh) {
  // Counts first, so that no two meshes give the same stream of bytes; blocks, for speed.
  constexpr std::size_t kBlock = 4096;
  Digest digest;
  const std::array<std::int64_t, 2> counts = {mesh.n_vertices(), mesh.n_triangles()};
  digest.add(std::span<const std::int64_t>(counts));
  std::vector<double> positions;
  for (std::size_t begin = 0; begin < mesh.vertices.size(); begin += kBlock) {
    positions.clear();
    for (std::size_t i = begin; i < mesh.vertices.size() && i < begin + kBlock; ++i) {
      const Vertex& v = mesh.vertices[i];
      positions.insert(positions.end(), {v.x, v.y, v.z});
    }
    digest.add(std::span<const double>(positions));
  }
  std::vector<Index> corners;
  for (std::size_t begin = 0; begin < mesh.triangles.size(); begin += kBlock) {
    corners.clear();
    for (std::size_t i = begin; i < mesh.triangles.size() && i < begin + kBlock; ++i) {
      const auto& vertex = mesh.triangles[i].vertex;
      corners.insert(corners.end(), vertex.begin(), vertex.end());
    }
    digest.add(std::span<const Index>(corners));
  }
  return digest.hex();
}

}  // namespace delos
