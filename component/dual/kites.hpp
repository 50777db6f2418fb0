// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The kite that a cell and one of its vertices share.
#include "dual/grid.hpp"

namespace delos::dual {

/// kite_area_m2[vertex][j] of the j with cells_on_vertex[vertex][j] == cell, found without a
/// branch, which could not be foretold.
inline double shared_kite_m2(const Grid& grid, Index cell, Index vertex) {
  const auto& cells = grid.cells_on_vertex[static_cast<std::size_t>(vertex)];
  const auto j =
      static_cast<std::size_t>(cells[1] == cell) + 2 * static_cast<std::size_t>(cells[2] == cell);
  return grid.kite_area_m2[static_cast<std::size_t>(vertex)][j];
}

}  // namespace delos::dual
