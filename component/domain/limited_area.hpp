// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The cells of a regional grid with the rings that limited-area models drive it through.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "dual/grid.hpp"

namespace delos::domain {

/// Rings around the inside, from the innermost: MPAS relaxes towards the driving model in five and
/// takes its values in the two outermost ("bdyMaskCell" of its limited-area files).
inline constexpr int kRelaxationRings = 5;
inline constexpr int kBoundaryRings = 7;

struct LimitedArea {
  std::vector<Index> cells;        ///< ids, ascending: what cull() takes
  std::vector<std::int32_t> ring;  ///< of each: 0 inside, 1..5 relaxation, 6 and 7 specified
  std::array<std::int64_t, kBoundaryRings + 1> n_cells{};  ///< by ring
};

/// Ring r + 1 holds the neighbours of ring r that are in no ring before, ring 0 is what `inside`
/// ([n_cells], 0 or 1) says; so the border runs evenly along the region, seven cells from it. The
/// same for any number of threads; linear. Error(input) when nothing is inside, or the rings have
/// no room: the outermost would be empty or the region has the whole grid.
LimitedArea limited_area(const Grid& grid, std::span<const char> inside);

}  // namespace delos::domain
