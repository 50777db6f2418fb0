// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One mesh from what is kept of the old one and what fills its holes.
#include <vector>

#include "adapt/hole.hpp"

namespace delos {

struct Joined {
  Mesh mesh;                      ///< survivors in order, then new ones hole by hole
  std::vector<Index> at_vertex;   ///< one triangle at each vertex
  Array<Index> new_id;            ///< by old vertex; kNone when it is gone
  std::vector<Index> hole_sides;  ///< triangles at the holes' borders, ascending
  Index first_inserted = 0;       ///< vertices from this id on are new
  Index first_filling = 0;        ///< triangles from this id on fill holes
};

/// Closed and sound, Delaunay but for the holes' borders.
Joined join(parallel::Executor& exec, const OldMesh& old, const std::vector<Hole>& holes,
            const std::vector<TileMesh>& fillings);

}  // namespace delos
