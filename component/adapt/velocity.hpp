// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Velocities on a C-grid: from components along the edges' normals to vectors in the cells and
// back, and how fast vorticity changes.
#include <span>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "dual/grid.hpp"

namespace delos {

/// East and north [n_cells] of remap::cell_velocities() from normal components [n_edges].
void vectors_at_cells(parallel::Executor& exec, const Grid& grid, std::span<const double> normal,
                      std::span<double> east, std::span<double> north);

/// Components along the edges' normals of the mean of both cells' vectors.
Array<double> normals_at_edges(parallel::Executor& exec, const Grid& grid,
                               std::span<const double> east, std::span<const double> north);

/// Relative vorticity at the grid's vertices, 1/s: the circulation about the triangle over its area
/// (Ringler et al. 2010, doi:10.1016/j.jcp.2009.12.007, Eq. 23), exact for given circulations.
Array<double> relative_vorticity(parallel::Executor& exec, const Grid& grid,
                                 std::span<const double> normal);

/// |grad zeta| in the cells, 1/(m s), from normal velocities in m/s: the least-squares vector of
/// the differences of vorticity along the cell's edges.
Array<double> vorticity_gradient(parallel::Executor& exec, const Grid& grid,
                                 std::span<const double> normal);

}  // namespace delos
