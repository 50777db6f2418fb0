// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a lat-lon elevation is on average over each Voronoi cell.
#include "core/array.hpp"
#include "core/progress.hpp"
#include "dual/grid.hpp"
#include "sizing/raster.hpp"

namespace delos::domain {

/// Means weighted by area, one of each a cell, over the parts of the cell where the elevation is
/// not missing. Wet is what lies below sea level.
struct CellMeans {
  Array<double> wet_fraction;  ///< wet share of the whole cell, in [0, 1]; missing counts as dry
  Array<double> wet_depth_m;   ///< of the wet part below sea level, > 0; 0 where nothing is wet
  Array<double> elevation_m;   ///< of the cell, positive up; NaN where all of it is missing
};

/// The elevation (m, positive up) is bilinear between the nodes of its raster, averaged over boxes
/// of one size first where the raster is uneven. Every cell is cut from its centre into triangles,
/// these into equal parts no wider than the raster's step and at least four; the middle of a part
/// stands for it. Poles and the date line are nothing special. Works on culled grids: looks at
/// positions and vertices_on_cell alone. The same bits for any number of threads; time in
/// proportion to the larger of cells and raster nodes. Advances the caller's phase by n_cells.
/// Error(input) for a raster of less than 2 x 2 nodes or without any value.
CellMeans mean_over_cells(Context& context, const Grid& grid, const Raster& elevation_m,
                          double sea_level_m = 0.0);

/// The nodes that a raster is averaged on for this.
LatLonField table_of(parallel::Executor& exec, const Raster& elevation_m);

/// The same of an elevation on the nodes of a table.
CellMeans mean_over_cells(Context& context, const Grid& grid, const LatLonField& elevation_m,
                          double sea_level_m = 0.0);

}  // namespace delos::domain
