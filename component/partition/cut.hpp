// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Cuts a part with its halo out of a grid.
#include <memory>
#include <span>
#include <vector>

#include "dual/grid.hpp"
#include "partition/subgrid.hpp"

namespace delos {

struct CutOptions {
  Index n_parts = 1;
  Index n_halo_layers = 1;  ///< >= 1: the tangential velocity at owned edges needs one
};

/// Cuts one part after the other out of one grid. Holds scratch arrays of 28 bytes a cell; refers
/// to the grid and to part_of_cell, which must outlive it. One thread at a time.
class Cutter {
 public:
  /// Error(config) for no halo layer or a part out of range.
  Cutter(const Grid& grid, std::span<const Index> part_of_cell, const CutOptions& options);
  ~Cutter();
  Cutter(const Cutter&) = delete;
  Cutter& operator=(const Cutter&) = delete;

  /// Linear in the size of the part with its halo.
  Subgrid cut(Index part);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace delos
