// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The depth of each sea cell, made fit for a model.
#include <cstdint>
#include <span>

#include "core/array.hpp"
#include "core/progress.hpp"
#include "domain/cell_means.hpp"
#include "dual/grid.hpp"

namespace delos::domain {

struct BathymetryOptions {
  double min_depth_m = 10.0;
  double max_depth_m = 1e5;  ///< of the lowest level
  /// Bound on |a - b| / (a + b) of the depths of neighbours (Beckmann & Haidvogel 1993); 0: none.
  double max_r_factor = 0.0;
  int max_rounds = 1000;
};

struct BathymetryReport {
  std::int64_t n_wet = 0;
  std::int64_t n_deepened = 0;  ///< to min_depth_m
  std::int64_t n_cut = 0;       ///< to max_depth_m
  std::int64_t n_smoothed = 0;  ///< cells that the r-factor changed
  int rounds = 0;
  double r_factor_before = 0.0, r_factor = 0.0;  ///< largest
  double wet_volume_m3 = 0.0;  ///< of the elevation below sea level, in all cells of the grid
  double volume_m3 = 0.0;      ///< of the cells, each wet all over
};

struct ShapedDepth {
  Array<double> depth_m;  ///< [n_cells] positive down; 0 on land
  BathymetryReport report;
};

/// Depth of the wet part of each cell that is wet, no less and no more than the bounds. Then, for
/// max_r_factor, pairs of neighbours above it exchange volume until they are at it: the sum of
/// area times depth stays, to rounding, and so do the least and the largest depth (Mellor, Ezer &
/// Oey 1994, doi:10.1175/1520-0426(1994)011<1126:TPGCOS>2.0.CO;2). The pairs take turns in the
/// order of the edges, rounds follow until none is above, so that the result does not depend on
/// threads; max_rounds reached shows in the report. `is_wet` [n_cells], 1 or 0. Land is no
/// neighbour.
ShapedDepth shape_bathymetry(Context& context, const Grid& grid, const CellMeans& means,
                             std::span<const std::uint8_t> is_wet,
                             const BathymetryOptions& options);

}  // namespace delos::domain
