// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How good a partition is.
#include <span>

#include "dual/grid.hpp"

namespace delos {

struct PartitionBalance {
  std::int64_t n_cut_edges = 0;  ///< between cells of two parts: what halos exchange across
  double cut_share = 0.0;        ///< of the edges between two cells
  double heaviest = 0.0;         ///< largest load of a part over the mean load: 1 = ideal
  double lightest = 0.0;         ///< smallest load over the mean load
};

/// Linear. `part_of_cell` [n_cells] in [0, n_parts); `weight` as in PartitionOptions::cell_weight.
PartitionBalance measure_partition(const Grid& grid, std::span<const Index> part_of_cell,
                                   std::int64_t n_parts, std::span<const double> weight = {});

}  // namespace delos
