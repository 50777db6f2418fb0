// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Edge flips, and Lawson's algorithm, which makes a triangulation Delaunay by flips.
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "geometry/ellipsoid.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// The side of `tri` that runs from vertex `from` to vertex `to`, or -1.
inline int side_of_edge(const Triangle& tri, Index from, Index to) {
  for (int k = 0; k < 3; ++k) {
    if (tri.vertex[static_cast<std::size_t>(next_corner(k))] == from &&
        tri.vertex[static_cast<std::size_t>(previous_corner(k))] == to) {
      return k;
    }
  }
  return -1;
}

/// The corner of `neighbour`, across side `side` of `tri`, that is not on that side.
Index opposite_vertex(const Mesh& mesh, Index tri, int side);

/// Replaces the diagonal that is side `side` of `tri` by the other one of the quadrilateral. Both
/// triangles keep their ids; corner 0 of both is an end of the new diagonal.
void flip(Mesh& mesh, Index tri, int side);

/// Whether both triangles after the flip are counter-clockwise seen from outside and the side is no
/// fixed edge.
bool can_flip(const Mesh& mesh, Index tri, int side);

/// Whether the side breaks the Delaunay property: by predicates::in_circle with the vertex id as
/// the index on a sphere, by predicates::prefers_flip on an ellipsoid.
bool is_illegal(const Mesh& mesh, const Ellipsoid& surface, Index tri, int side);

/// The same for any of its three sides; quick where all angles around it are clearly acute.
bool has_illegal_side(const Mesh& mesh, const Ellipsoid& surface, Index tri);

/// Flips until no side that can be reached from the sides of the seed triangles is illegal
/// (Lawson 1977). Returns the number of flips; `touched`, when given, receives the ids of flipped
/// triangles, with repetition. On an ellipsoid the flips stop at 64 a triangle of the mesh at the
/// latest; validate() tells whether sides were left.
std::int64_t restore_delaunay(Mesh& mesh, const Ellipsoid& surface, std::span<const Index> seeds,
                              std::vector<Index>* touched = nullptr);

/// The same for all triangles: candidates are found in parallel, then flipped serially in
/// ascending order, so that the result does not depend on the number of threads.
std::int64_t restore_delaunay_everywhere(parallel::Executor& exec, Mesh& mesh,
                                         const Ellipsoid& surface,
                                         std::vector<Index>* touched = nullptr);

/// The same from some triangles only, which may hold repetitions; flips spread from there.
std::int64_t restore_delaunay_around(parallel::Executor& exec, Mesh& mesh, const Ellipsoid& surface,
                                     std::span<const Index> triangles,
                                     std::vector<Index>* touched = nullptr);

}  // namespace delos
