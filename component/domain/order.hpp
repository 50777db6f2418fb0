// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// In which order the cells of a domain stand in memory.
#include <vector>

#include "domain/mask.hpp"

namespace delos::domain {

enum class CellOrder {
  kept,     ///< as in the whole grid
  hilbert,  ///< along a Hilbert curve
  metis     ///< METIS's parts one after the other, along a Hilbert curve within each
};

/// The cells of `sea`, ordered. `n_parts` >= 2 is for metis alone: the parts stand in the order in
/// which the curve reaches them. Error(config) where metis is asked for and was not built in, or
/// there are fewer cells than parts.
std::vector<Index> order_cells(parallel::Executor& exec, const Grid& grid, const Mask& sea,
                               CellOrder order, std::int64_t n_parts = 0);

}  // namespace delos::domain
