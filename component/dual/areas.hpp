// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Areas of kites, triangles and cells.
#include "core/parallel.hpp"
#include "dual/grid.hpp"

namespace delos::dual {

/// Fills kite_area_m2, triangle_area_m2 and cell_area_m2. A kite is split along vertex-cell into
/// two triangles; all these triangles tile the surface once, so every sum closes to rounding even
/// where a kite is negative. On the sphere the two triangles (vertex, cell, edge) at an edge are
/// each other's mirror image, so that half of (vertex, cell, cell) stands for both.
void measure_areas(parallel::Executor& exec, Grid& grid);

}  // namespace delos::dual
