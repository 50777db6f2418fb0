// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The stack of layers below each sea cell: z levels with a partial bottom cell.
#include <cstdint>
#include <span>

#include "core/array.hpp"
#include "core/progress.hpp"
#include "domain/levels.hpp"
#include "dual/grid.hpp"

namespace delos::domain {

struct StackOptions {
  std::int64_t min_levels = 3;  ///< of a sea cell
  bool has_partial_bottom = true;
  double min_fraction = 0.1;  ///< least part of its level that a partial bottom cell fills
};

/// Layers of every cell.
struct Stack {
  Levels levels;
  Array<Index> n_layers;         ///< [n_cells] the layers 0 .. n_layers - 1 are wet; 0 on land
  Array<double> bottom_depth_m;  ///< [n_cells] positive down; 0 on land

  /// At rest; 0 below the bottom.
  double thickness_m(std::int64_t cell, std::int64_t k) const {
    const std::int64_t n = n_layers[static_cast<std::size_t>(cell)];
    if (k >= n) return 0.0;
    return k + 1 < n ? levels.thickness_m(k)
                     : bottom_depth_m[static_cast<std::size_t>(cell)] - levels.top_m(k);
  }
};

struct StackReport {
  std::int64_t n_wet = 0;
  std::int64_t n_layers = 0;  ///< in all cells together
  std::int64_t n_full = 0;    ///< cells whose bottom layer is whole
  double min_bottom_layer_m = 0.0;
  double volume_m3 = 0.0;
};

/// The bottom is where `depth_m` has it (0 = land), but no layer is thinner than min_fraction of
/// its level (Adcroft, Hill & Marshall 1997, doi:10.1175/1520-0493(1997)125<2293:ROTBSC>2.0.CO;2):
/// a bottom cell that would be is made that thick, or left out, whichever is nearer.
/// Without partial cells the bottom goes to the nearest interface. A sea cell has min_levels whole
/// levels at least. Depths below the lowest interface end there. The same for any number of
/// threads. Error(config) for more min_levels than levels.
Stack build_stack(Context& context, const Levels& levels, std::span<const double> depth_m,
                  const StackOptions& options);

/// The stack above bottoms that build_stack() gave.
Stack stack_above(const Levels& levels, Array<double> bottom_depth_m);

/// Sums over the cells of the grid.
StackReport measure_stack(Context& context, const Grid& grid, const Stack& stack);

}  // namespace delos::domain
