// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tile kernel: frontal-Delaunay refinement of one tile from its sides inwards, sequential and
// in private memory. Off-centres after Rebay (1993, doi:10.1006/jcph.1993.1097), Uengoer (2009,
// doi:10.1016/j.comgeo.2008.06.002) and Engwirda & Ivers (2016, doi:10.1016/j.cad.2015.10.007);
// the nudge of each off-centre by one local spring step is ours (component/refine/README.md).
#include <memory>
#include <vector>

#include "refine/refine.hpp"
#include "refine/skeleton.hpp"

namespace delos {

struct TriangleSide {
  Index triangle;
  int side;
};

/// A refined tile. Local vertex ids: first the skeleton's, then the inserted ones.
struct TileMesh {
  std::vector<Index> skeleton_vertices;  ///< ascending ids in the skeleton
  Array<Vertex> inserted;
  Array<Triangle> triangles;         ///< local ids; neighbour < 0 at the tile's border
  std::vector<TriangleSide> border;  ///< what touches each slot of the tile's border
  std::vector<Index> off_bounds;     ///< triangles that break a bound of the options, ascending
};

/// Scratch memory that one thread reuses from tile to tile.
class FrontWorkspace {
 public:
  FrontWorkspace();
  ~FrontWorkspace();
  FrontWorkspace(FrontWorkspace&&) noexcept;
  /// Room for tiles of so many vertices, so that no array grows by copies.
  void reserve(double expected_vertices);
  struct Impl;
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// What all tiles share.
struct FrontInput {
  const Ellipsoid& surface;
  const SpacingField& spacing;
  const RefineOptions& options;
  const Skeleton& skeleton;
  const std::vector<Index>& half_segment;  ///< of half_segment_of_sides()
};

/// Refines tile number `tile`; its triangles meet the size bound but for the few whose
/// circumcentres lie beyond the tile's sides. Those off a bound are listed.
TileMesh refine_tile(const FrontInput& input, std::size_t tile, FrontWorkspace& workspace);

}  // namespace delos
