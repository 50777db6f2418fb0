// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sets of cells, and what changes the set of sea cells.
#include <cstdint>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "dual/grid.hpp"

namespace delos::domain {

/// 1 for the cells of a set, else 0; [n_cells].
using Mask = Array<std::uint8_t>;

std::int64_t count(parallel::Executor& exec, const Mask& mask);

/// The cells whose wet share is at least `least_wet`.
Mask wet_cells(parallel::Executor& exec, const Array<double>& wet_fraction, double least_wet);

struct PruneOptions {
  /// A sea cell with one sea neighbour or none: nothing flows through it. Inlets one cell wide go
  /// with it, cell by cell from their end.
  bool bays = false;
  /// A sea cell between whose sea neighbours land lies on two sides or more: a channel one cell
  /// wide, or the only cell between two islands. What it joined may fall apart. Sides where all
  /// sea is kept don't count: the mouth of a passage is no channel.
  bool channels = false;
};

struct PruneReport {
  std::int64_t n_bays = 0, n_channels = 0;  ///< cells removed
};

/// Takes bays and channels out of `sea`, in rounds until there are none; never a cell of `keep`.
/// Every round judges all cells by the sea as it was before: the order of cells is nothing to it.
PruneReport prune(parallel::Executor& exec, const Grid& grid, const PruneOptions& options,
                  const Mask& keep, Mask& sea);

}  // namespace delos::domain
