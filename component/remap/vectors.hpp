// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Velocities: normal components at edges, and Cartesian vectors at cells, which transfer like three
// fields.
#include <span>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "dual/grid.hpp"
#include "remap/transfer.hpp"

namespace delos::remap {

/// Unit vector from an edge's first cell to its second, in the tangent plane at the edge.
Vec3 edge_normal(const Grid& grid, std::int64_t edge);

/// Vectors in the cells' tangent planes that fit the normal components [n_edges] around each cell
/// best, least squares weighted with dc dv: exact where the velocity is constant. What border edges
/// hold counts, so that 0 there turns the vectors along a coast. [n_cells]
Array<Vec3> cell_velocities(parallel::Executor& exec, const Grid& grid,
                            std::span<const double> normal);

/// Normal components [n_edges] of the mean of the two cells' vectors [n_cells]; that of the other
/// cell where one has none (NaN), 0 at a border.
Array<double> normal_velocities(parallel::Executor& exec, const Grid& grid,
                                std::span<const Vec3> cells);

/// Vectors [n_sources] on the target's cells, component by component, then turned back into the
/// tangent planes there. Momentum is kept before the turn. NaN in cells that no source covers.
Array<Vec3> transfer_vectors(parallel::Executor& exec, const Transfer& transfer, const Grid& target,
                             std::span<const Vec3> source, const TransferOptions& options = {});

/// Net outflow of every cell over its area, 1/s for m/s. [n_cells]
Array<double> divergence(parallel::Executor& exec, const Grid& grid,
                         std::span<const double> normal);

}  // namespace delos::remap
