// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Divergent flow: transferred by its velocity potential, and given the divergence that it should
// have.
#include <span>

#include "core/array.hpp"
#include "core/progress.hpp"
#include "dual/grid.hpp"

namespace delos::remap {

/// chi at cells, m2/s, 0 in cell 0, of a flow [n_edges] that is its gradient: the normal velocity
/// at an edge is (chi[c1] - chi[c0]) / dc. Sums along a spanning tree.
Array<double> velocity_potential(const Grid& grid, std::span<const double> gradient);

/// Normal velocities [n_edges] of chi [n_cells].
Array<double> gradient_of(parallel::Executor& exec, const Grid& grid, std::span<const double> chi);

/// chi of the source grid at the target's cells: a quadratic fit to the cell there and two rings
/// of neighbours; in cells that both grids have, the value itself. [target.n_cells()]
Array<double> transfer_potential(parallel::Executor& exec, const Grid& source, const Grid& target,
                                 std::span<const double> chi);

/// What a flow should become.
struct WantedDivergence {
  std::span<const double> divergence_s;  ///< [n_cells] 1/s
  std::span<const char> is_free;         ///< [n_edges] velocities that may change
};

/// Adds to `normal` [n_edges] the gradient, on free edges, of the potential that gives every cell
/// with a free edge the wanted divergence, within 1e-12 of velocity over spacing: the nearest such
/// flow in the mean of squares weighted with dc dv. Conjugate gradients over those cells alone.
/// Error(input) when a connected part of them can't have it: what flows in over the other edges is
/// not what diverges inside.
void impose_divergence(Context& context, const Grid& grid, const WantedDivergence& wanted,
                       Array<double>& normal);

}  // namespace delos::remap
