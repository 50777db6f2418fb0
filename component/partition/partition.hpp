// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which part (process) each cell of a grid belongs to.
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "dual/grid.hpp"

namespace delos {

enum class PartitionMethod {
  automatic,  ///< kway where the library was built with METIS, else curve
  kway,       ///< METIS, multilevel k-way: short borders; curve where parts have less work than
              ///< 32 of the heaviest cells
  curve       ///< pieces of a Hilbert curve: cheap, the same with any library
};
const char* to_string(PartitionMethod method);

struct PartitionOptions {
  std::int64_t n_parts = 1;
  PartitionMethod method = PartitionMethod::automatic;
  /// Work of each cell, e.g. its number of wet layers: [n_cells], finite, >= 0, not all 0; empty =
  /// 1 each.
  std::span<const double> cell_weight = {};
};

struct Partitioned {
  std::vector<Index> part_of_cell;
  PartitionMethod method;  ///< the one that gave them: kway or curve
};

/// Part of each cell, [n_cells] in [0, n_parts), no part empty. The same for any number of threads;
/// `curve` on any machine, `kway` with one version of METIS. Parts of `kway` are connected where
/// METIS finds them so. Linear but for the logarithm of n_parts.
/// Error(config) for fewer cells than parts, weights that can't be used, or `kway` without METIS.
Partitioned partition_by(parallel::Executor& exec, const Grid& grid,
                         const PartitionOptions& options);
/// The parts alone.
std::vector<Index> partition(parallel::Executor& exec, const Grid& grid,
                             const PartitionOptions& options);

}  // namespace delos
