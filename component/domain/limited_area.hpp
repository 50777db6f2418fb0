// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The cells of a regional grid with the rings that limited-area models drive it through.
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "domain/mask.hpp"
#include "dual/grid.hpp"

namespace delos::domain {

/// Rings around the inside, from the innermost. Those of MPAS-Atmosphere: five in which it relaxes
/// towards the driving model, and the two outermost, where it takes its values.
struct RingWidths {
  int relaxation = 5;
  int specified = 2;
  int total() const { return relaxation + specified; }
};

struct LimitedArea {
  /// [n_cells] of the whole grid: 0 inside, then 1, 2, ... to the border (MPAS's bdyMaskCell), and
  /// kNone beyond it.
  Array<std::int32_t> ring;
  std::vector<std::int64_t> n_cells;  ///< by ring
  std::int64_t n_parts = 0;           ///< that hang together by edges
};

/// Inside is what `inside` ([n_cells], 0 or 1) says, made even: cells that hang on it by one edge
/// or none leave, cells that it leaves but one edge free join. Ring r + 1 holds the neighbours of
/// ring r that are in no ring before; cells of the last ring that hang by one edge are left out.
/// So the border runs evenly along the region. The same for any number of threads; linear.
/// Error(input) when nothing is inside, or the rings have no room: the outermost would be empty.
LimitedArea limited_area(parallel::Executor& exec, const Grid& grid, std::span<const char> inside,
                         const RingWidths& widths);

}  // namespace delos::domain
