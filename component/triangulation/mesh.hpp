// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The triangulation: a closed genus-0 surface in flat arrays. Data only; the algorithms are its
// neighbours in this folder.
#include <string>
#include <vector>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "core/types.hpp"

namespace delos {

/// A vertex: scaled position on the surface and the wanted spacing (scaled) there. 32 bytes, so
/// that one aligned load brings all of it.
struct alignas(32) Vertex {
  double x, y, z;
  double spacing;
  Vec3 position() const { return {x, y, z}; }
};

/// Corner k of a triangle is opposite to its side k, and neighbour k is across side k, which runs
/// from corner k+1 to corner k+2 (mod 3).
struct Triangle {
  std::array<Index, 3> vertex;  ///< counter-clockwise seen from outside
  std::array<Index, 3>
      neighbour;  ///< triangle across each side; kNone only while under construction
};

/// The first vertices of a mesh, when they must stay where they are, and edges between them that no
/// flip may take away. Empty for most meshes.
struct FixedEdges {
  std::vector<Index> offsets;  ///< [n_vertices() + 1], or empty
  std::vector<Index> ends;     ///< the other ends of the edges at each vertex, ascending

  Index n_vertices() const { return offsets.empty() ? 0 : static_cast<Index>(offsets.size()) - 1; }
  std::int64_t n_edges() const { return static_cast<std::int64_t>(ends.size() / 2); }
  bool has_vertex(Index vertex) const { return vertex < n_vertices(); }
  bool has_edge(Index a, Index b) const;
};

struct Mesh {
  Array<Vertex> vertices;
  Array<Triangle> triangles;  ///< 2 n_vertices - 4 of them when closed
  FixedEdges fixed;

  Index n_vertices() const { return static_cast<Index>(vertices.size()); }
  Index n_triangles() const { return static_cast<Index>(triangles.size()); }
  Vec3 position(Index vertex) const {
    return vertices[static_cast<std::size_t>(vertex)].position();
  }
  const Triangle& triangle(Index tri) const { return triangles[static_cast<std::size_t>(tri)]; }
  Triangle& triangle(Index tri) { return triangles[static_cast<std::size_t>(tri)]; }
};

inline constexpr int next_corner(int k) { return k == 2 ? 0 : k + 1; }
inline constexpr int previous_corner(int k) { return k == 0 ? 2 : k - 1; }

/// The side of `tri` that touches triangle `neighbour`, or -1. (Two triangles of a closed surface
/// with more than four vertices share at most one side.)
inline int side_towards(const Triangle& tri, Index neighbour) {
  for (int k = 0; k < 3; ++k) {
    if (tri.neighbour[static_cast<std::size_t>(k)] == neighbour) return k;
  }
  return -1;
}

/// The corner of `tri` at `vertex`, or -1.
inline int corner_at(const Triangle& tri, Index vertex) {
  for (int k = 0; k < 3; ++k) {
    if (tri.vertex[static_cast<std::size_t>(k)] == vertex) return k;
  }
  return -1;
}

/// The same for a vertex that is a corner of `tri`; without a branch, which could not be foretold.
inline int own_corner_at(const Triangle& tri, Index vertex) {
  return static_cast<int>(tri.vertex[1] == vertex) + 2 * static_cast<int>(tri.vertex[2] == vertex);
}

/// visit(neighbour) for the neighbours of a vertex of a closed mesh, counter-clockwise, from the
/// corner after the vertex in `first_triangle`, which is one at the vertex.
template <class Visit>
inline void for_each_neighbour(const Mesh& mesh, Index first_triangle, Index vertex,
                               const Visit& visit) {
  Index tri = first_triangle;
  do {
    const Triangle& t = mesh.triangle(tri);
    const auto k = static_cast<std::size_t>(next_corner(corner_at(t, vertex)));
    visit(t.vertex[k]);
    tri = t.neighbour[k];
  } while (tri != first_triangle);
}

/// One triangle at every vertex (the one of lowest id), kNone for a vertex of none.
std::vector<Index> triangle_at_vertex(const Mesh& mesh);
/// The same by all threads.
std::vector<Index> triangle_at_vertex(parallel::Executor& exec, const Mesh& mesh);

/// Digest (SHA-256, hex) of positions and triangle corners: two meshes are "the same to the last
/// bit" iff these agree.
std::string digest(const Mesh& mesh);

}  // namespace delos
