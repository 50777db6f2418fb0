// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The holes that removed vertices leave, and new triangles in them from the tile kernel.
#include <vector>

#include "adapt/region.hpp"
#include "core/progress.hpp"
#include "geometry/ellipsoid.hpp"
#include "refine/front.hpp"

namespace delos {

/// Connected triangles around removed vertices, after these have gone. A triangle's neighbour
/// across side number b of the border is ~b.
struct Hole {
  std::vector<Index> old_triangles;  ///< those that it was made of, ascending
  /// Old ids, ascending: those on the border, and the few inside that had to stay because without
  /// them a triangle would span too much of the surface.
  std::vector<Index> vertices;
  std::vector<Triangle> triangles;  ///< corners are places in `vertices`; constrained Delaunay
  struct BorderSide {
    Index outside;  ///< old triangle across
    int side;       ///< its side that touches the hole
  };
  std::vector<BorderSide> border;
};

/// Empties the region, hole by hole in the order of their least removed vertices.
std::vector<Hole> make_holes(Context& context, const Ellipsoid& surface, const OldMesh& old,
                             const Region& region);

struct FillInput {
  const Ellipsoid& surface;
  const SpacingField& spacing;
  const RefineOptions& options;
  const OldMesh& old;
  const Region& region;
};

/// Refines every hole from its border inwards (refine_tile); triangles and border as in TileMesh,
/// skeleton_vertices are places in Hole::vertices. Kept vertices count with the spacing that they
/// were made for.
std::vector<TileMesh> fill_holes(Context& context, const FillInput& input,
                                 const std::vector<Hole>& holes);

}  // namespace delos
