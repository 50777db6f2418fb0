// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Positions of cells and grid vertices, in space and on the map.
#include "core/parallel.hpp"
#include "dual/grid.hpp"
#include "triangulation/mesh.hpp"

namespace delos::dual {

/// Fills cell_position, cell_spacing_m and cell_lon_lat.
void place_cells(parallel::Executor& exec, const Mesh& mesh, Grid& grid);

/// Fills vertex_position (centres of the surface Delaunay balls) and vertex_lon_lat.
void place_vertices(parallel::Executor& exec, const Mesh& mesh, Grid& grid);

}  // namespace delos::dual
