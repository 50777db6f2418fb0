// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a model knows on its cells or on a lat-lon grid, as a raster that sources of spacing read.
#include <span>
#include <string>

#include "core/parallel.hpp"
#include "dual/grid.hpp"
#include "sizing/raster.hpp"

namespace delos {

/// The cell whose generator is nearest to a scaled surface point p, by a walk over neighbours from
/// `start`; of equals the one where the walk ends. About sqrt(n) steps from afar.
Index nearest_cell(const Grid& grid, const Vec3& p, Index start);

/// Rows and columns at most this far apart see every cell of the grid: the least spacing, between
/// 1/12 and 1 degree.
double cell_resolution_rad(const Grid& grid);

/// Values [n_cells] on the nodes of a global table with both poles. A node has the area-weighted
/// mean of the cells whose generators lie in its box, or, where cells are coarser than the table,
/// the value of the cell that holds it. NaN takes no part in means. `name` is for messages.
Raster raster_of_cells(parallel::Executor& exec, const Grid& grid, std::span<const double> values,
                       double resolution_rad, const std::string& name);

/// A table with both poles as it is.
Raster raster_of_nodes(LatLonField table, const std::string& name);

/// Values [n_lat, n_lon] of strictly rising or falling axes (longitudes within one turn), put in
/// order; periodic when the columns go round, a repeated last one is dropped. Error(input) when the
/// number of values does not fit the axes.
Raster raster_of_table(std::span<const double> lon_deg, std::span<const double> lat_deg,
                       std::span<const double> values, const std::string& name);

}  // namespace delos
