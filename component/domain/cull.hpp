// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A part of a grid as a grid of its own, with a border where its neighbours are gone.
#include <span>

#include "core/progress.hpp"
#include "dual/grid.hpp"

namespace delos::domain {

/// A grid of some cells and what it keeps of each element of the old one.
struct Culled {
  Grid grid;
  Array<Index> old_cell, old_edge, old_vertex;  ///< id in the old grid, one of each new element
};

/// The grid of the cells named, numbered in that order, with their edges and vertices. Edges are
/// numbered by (lower cell, order around it), vertices by (lowest cell, order around it), so that
/// what is near in the order of cells is near in all tables. Beyond the border the tables of
/// `Grid` hold kNone, and the kites there are 0; a triangle's area is the sum of the kites left.
/// Cells keep their polygons, all that stays keeps its position, lengths and areas to the last bit,
/// border edges too, with the distance to the cell that is gone. Normals point from the lower to
/// the higher new cell, and out of the grid at its border. edges_on_edge and weights_on_edge lose
/// the side of the cell that is gone. The same bits for any number of threads; linear. `cells` are
/// ids of `grid`, each at most once and at least one (else Error(internal)).
Culled cull(parallel::Executor& exec, const Grid& grid, std::span<const Index> cells);

}  // namespace delos::domain
