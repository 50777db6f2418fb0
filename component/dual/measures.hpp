// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Longitudes and latitudes, areas, lengths and angles of a connected grid.
#include "core/parallel.hpp"
#include "dual/grid.hpp"

namespace delos::dual {

/// Fills the three lon_lat arrays; longitudes in [0, 2 pi).
void locate(parallel::Executor& exec, Grid& grid);

/// Fills kite_area_m2, triangle_area_m2 and cell_area_m2. A kite is split along vertex-cell into
/// two triangles; all these triangles tile the surface once, so every sum closes to rounding even
/// where a kite is negative.
void measure_areas(parallel::Executor& exec, Grid& grid);

/// Fills cell_distance_m, vertex_distance_m and edge_angle_rad.
void measure_edges(parallel::Executor& exec, Grid& grid);

}  // namespace delos::dual
