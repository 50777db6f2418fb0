// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The C-grid of cells that a file has as polygons, where they end at a border.
#include "core/parallel.hpp"
#include "dual/grid.hpp"
#include "io/ugrid.hpp"

namespace delos {

struct FaceGrid {
  Grid grid;
  std::int64_t n_turned = 0;  ///< cells that were clockwise in the file
};

/// Voronoi cells by their centres and corners, nodes of no cell left out; with the rings that the
/// file has, and `edges` (null: none) for the spacing at the edges. Error(input), without the path,
/// as grid_of_polygons(), and for an edge without spacing.
FaceGrid face_grid(parallel::Executor& exec, const Ellipsoid& surface, const FaceMesh& faces,
                   const UgridMesh* edges);

}  // namespace delos
