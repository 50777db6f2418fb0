// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lines on the map as chains of cells.
#include <vector>

#include "dual/grid.hpp"
#include "geometry/lines.hpp"

namespace delos::domain {

/// The cell whose centre is nearest to a surface point: its Voronoi cell. Walks over neighbours,
/// from the nearest of some hundred cells spread over the grid. On a grid with a border the walk
/// may end there, before a nearer cell behind a gap.
Index cell_at(const Grid& grid, const Vec3& point);

/// The cells that a line runs through, in the order in which it enters them, each once. They hang
/// together by edges: water in all of them joins the line's ends, and land in all of them parts its
/// sides. The line is followed in steps of a quarter of the cells' width. On a closed grid.
std::vector<Index> cells_along(const Grid& grid, const LonLatLine& line);

}  // namespace delos::domain
