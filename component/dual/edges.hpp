// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where the edges are, how long they and their dual edges are, and where they point.
#include "core/parallel.hpp"
#include "dual/grid.hpp"

namespace delos::dual {

/// Fills edge_position (where the central-plane arcs through the two cells and through the two
/// vertices cross), edge_lon_lat, cell_distance_m, vertex_distance_m and edge_angle_rad. Needs the
/// positions of cells and vertices, cells_on_edge and vertices_on_edge.
void measure_edges(parallel::Executor& exec, Grid& grid);

}  // namespace delos::dual
