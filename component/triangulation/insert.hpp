// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Adding and removing single vertices of a Delaunay mesh, which stays closed and Delaunay.
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/ellipsoid.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// Adds the vertex, which must be on the surface, and returns its id, n_vertices before the call;
/// the two new triangles are the last ones. `hint` is any triangle, best one close by: the cost is
/// that of locate() and about six flips. Error(input) when a vertex is at the same position; closer
/// than about 1e-8 radii to another one rounding may leave a side that is not Delaunay.
Index insert_vertex(Mesh& mesh, const Ellipsoid& surface, const Vertex& vertex, Index hint);

/// Removes the vertex: flips until it has three triangles, one triangle in their place, then flips
/// back to Delaunay. Afterwards the last vertex has the removed id, and the last two triangles the
/// ids of the two that went. `hint` as above.
///
/// False, and the mesh as good as before (its triangles may be in another order), when the
/// vertices that would be left do not enclose the centre or are fewer than 4.
bool remove_vertex(Mesh& mesh, const Ellipsoid& surface, Index vertex, Index hint);

/// Removes the vertices (no id twice) one after the other; those left, and the triangles, keep
/// their order: new_id[old] = id after the call, kNone for a removed one. Vertices that could not
/// be removed keep an id. Returns the number removed.
std::int64_t remove_vertices(Mesh& mesh, const Ellipsoid& surface, std::span<const Index> vertices,
                             std::vector<Index>& new_id);

}  // namespace delos
