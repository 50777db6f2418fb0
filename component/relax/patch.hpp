// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A patch: the triangles around a few bad ones, copied into small private arrays, mended there and
// written back. Patches of one round share no triangle, so they are mended in parallel and
// committed in order.
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "geometry/ellipsoid.hpp"
#include "relax/score.hpp"
#include "sizing/spacing.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// Ids are local: free vertices first, [0, n_free); the others lie on the border and stay.
/// A side on the border has neighbour ~b, b its number in the order of extraction.
struct Patch {
  std::vector<Vertex> vertices;
  std::vector<Vertex> beyond;  ///< opposite to each side of the border, in the triangle outside
  std::vector<Triangle> triangles;
  Index n_free = 0;
  /// Edges that no flip may take away, by their ends' numbers among the vertices that stay (which
  /// do not change when free ones come and go).
  std::vector<std::array<Index, 2>> fixed_edges;

  bool is_fixed_edge(Index a, Index b) const;
  const Vertex& vertex(Index v) const { return vertices[static_cast<std::size_t>(v)]; }
  Triangle& triangle(Index t) { return triangles[static_cast<std::size_t>(t)]; }
  const Triangle& triangle(Index t) const { return triangles[static_cast<std::size_t>(t)]; }
  Index n_triangles() const { return static_cast<Index>(triangles.size()); }
  /// The vertex opposite to side k of t in the triangle across.
  const Vertex& across(Index t, int k) const;
  /// triangle_score() and that of its own sides; sides on the border are always its own.
  double score(Index t) const;
  /// Least score of its triangles, and the triangle (the first if there are several).
  std::pair<double, Index> worst() const;
};

/// Where a patch came from, for commit(): global ids by local id.
struct PatchOrigin {
  std::vector<Index> vertices;
  std::vector<Index> triangles;
  struct BorderSide {
    Index outside;  ///< global triangle across
    int side;       ///< its side that touches the patch
  };
  std::vector<BorderSide> border;
};

struct ExtractedPatch {
  Patch patch;
  PatchOrigin origin;
};

/// One triangle at each vertex, or kNone; scratch for extraction.
using TriangleAtVertex = std::vector<Index>;

/// The patch of all triangles around the given free vertices (global ids, ascending).
ExtractedPatch extract_patch(const Mesh& mesh, const TriangleAtVertex& at_vertex,
                             const std::vector<Index>& free_vertices);

/// Edits of a patch. They keep the border and every free vertex's star closed.
namespace patch {

/// Turns side k of a triangle into the other diagonal. The side is not on the border.
void flip(Patch& patch, Index tri, int side);
/// Lawson flips by the opposite-angle sum until no inner side wants one that may; how many.
int restore_delaunay(Patch& patch);
/// Takes out a free vertex; the last free vertex gets its id. False (and an unchanged patch) when
/// its star can't be flipped down to three triangles.
bool remove_vertex(Patch& patch, Index vertex);
/// Puts a free vertex into a triangle (split in three).
void insert_vertex(Patch& patch, Index tri, const Vertex& vertex);
/// The star of each free vertex v, counter-clockwise from its lowest triangle: corners as
/// 3 * triangle + corner, corners[offsets[v]] .. corners[offsets[v + 1] - 1].
struct Stars {
  std::vector<Index> offsets;
  std::vector<Index> corners;
};
Stars stars(const Patch& patch);

}  // namespace patch

/// What commits leave to do.
struct MeshEdits {
  std::vector<Index> dead_vertices;
  std::vector<Index> dead_triangles;     ///< without corners (kNone) until compact()
  std::vector<Index> touched_triangles;  ///< those written
};
/// Writes a patch back. Only patches of one round, which share no vertex, may be committed in a
/// row. Free vertices that the patch gained get new ids at the end; ids that it gave up are listed
/// in `edits`.
void commit_patch(Mesh& mesh, TriangleAtVertex& at_vertex, const ExtractedPatch& mended,
                  MeshEdits& edits);

/// Takes the dead vertices and triangles out of the arrays; the survivors keep their order.
void compact(parallel::Executor& exec, Mesh& mesh, MeshEdits& edits);

}  // namespace delos
