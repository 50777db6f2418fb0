// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Partitions that a user asks for, with what the report says of them.
#include <span>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "dual/grid.hpp"
#include "metrics/report.hpp"
#include "partition/balance.hpp"
#include "partition/partition.hpp"

namespace delos {

/// A grid cut into n_parts.
struct GridPartition {
  std::int64_t n_parts = 1;
  PartitionMethod method = PartitionMethod::automatic;  ///< the one that gave it: kway or curve
  std::vector<Index> part_of_cell;                      ///< [n_cells], base 0
  PartitionBalance balance;
};

struct PartitionWishes {
  std::vector<std::int64_t> n_parts;  ///< each >= 2, none twice
  PartitionMethod method = PartitionMethod::automatic;
};

/// Error(config) when about `n_cells` cells are too few for one of the numbers of parts, or the
/// method is not in this library: said before the grid is made.
void check_partitions(const PartitionWishes& wishes, double n_cells);

/// Phase "partition": one for each number of parts, in their order. `weight` as in
/// PartitionOptions::cell_weight. Errors as partition().
std::vector<GridPartition> make_partitions(Context& context, const Grid& grid,
                                           const PartitionWishes& wishes,
                                           std::span<const double> weight = {});

ReportPartition report_entry(const GridPartition& partition);

/// "16 parts (kway): 4.2 % of the edges cut, the heaviest 1.02 of the mean"
std::string describe(const GridPartition& partition);

}  // namespace delos
