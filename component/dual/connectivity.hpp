// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The tables that say which cell, edge and vertex touch.
#include "core/parallel.hpp"
#include "dual/grid.hpp"
#include "triangulation/mesh.hpp"

namespace delos::dual {

/// Fills every table of Grid that holds indices but edges_on_edge, from the triangles alone. Count,
/// scan, fill; O(n). Needs the positions of cells and vertices (their number).
void connect(parallel::Executor& exec, const Mesh& mesh, Grid& grid);

}  // namespace delos::dual
