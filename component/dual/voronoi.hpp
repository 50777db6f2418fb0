// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Positions of cells, grid vertices and edges.
#include "core/parallel.hpp"
#include "dual/grid.hpp"
#include "triangulation/mesh.hpp"

namespace delos::dual {

/// Fills cell_position, cell_spacing_m and vertex_position (centres of the surface Delaunay balls).
void place_cells_and_vertices(parallel::Executor& exec, const Mesh& mesh, Grid& grid);

/// Fills edge_position: where the central-plane arcs through the two cells and through the two
/// vertices cross. Needs the positions above, cells_on_edge and vertices_on_edge.
void place_edges(parallel::Executor& exec, Grid& grid);

}  // namespace delos::dual
