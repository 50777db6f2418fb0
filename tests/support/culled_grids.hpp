// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Parts of grids for tests of what has a border.
#include <vector>

#include "domain/cull.hpp"

namespace delos::samples {

/// The cells whose positions keep(p) says to keep, in their order.
template <class Keep>
domain::Culled culled(const Grid& grid, Keep&& keep) {
  std::vector<Index> cells;
  for (std::size_t i = 0; i < grid.cell_position.size(); ++i) {
    if (keep(grid.cell_position[i])) cells.push_back(static_cast<Index>(i));
  }
  parallel::Executor exec(1);
  return domain::cull(exec, grid, cells);
}

}  // namespace delos::samples
