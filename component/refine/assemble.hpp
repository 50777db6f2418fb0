// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From refined tiles to one mesh: compaction in tile order.
#include <vector>

#include "refine/front.hpp"

namespace delos {

/// Vertices: the skeleton's, then those that each tile inserted. Triangles: tile by tile. Consumes
/// the tiles, freeing each as it is copied. `sides` receives the triangles at the tiles' sides.
Mesh assemble(parallel::Executor& exec, Skeleton& skeleton, std::vector<TileMesh>& tiles,
              std::vector<Index>& side_triangles);

}  // namespace delos
