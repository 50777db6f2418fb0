// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Flow without divergence: transferred by its stream function, so that none is made.
#include <span>

#include "core/array.hpp"
#include "core/progress.hpp"
#include "dual/grid.hpp"
#include "remap/overlap.hpp"

namespace delos::remap {

/// psi at grid vertices, m2/s: the normal velocity at an edge is -(psi[v1] - psi[v0]) / dv, that of
/// up x grad psi.
struct StreamFunction {
  /// [n_vertices], 0 at vertex 0. With a border it is one number on each connected coast, 0 on the
  /// longest of each body.
  Array<double> psi;
  /// Part of the flow, root of mean square over that of the flow, which no stream function has: its
  /// divergent part. Rounding for a flow without divergence.
  double remainder = 0.0;
};

/// The stream function whose flow is nearest to `normal` [n_edges] in the mean of squares weighted
/// with dc dv (the Helmholtz projection). A sum along a spanning tree, which is the answer when the
/// flow has no divergence; else conjugate gradients go on from it. What flows through a border
/// counts as part of the remainder, but is not in its number.
StreamFunction stream_function(Context& context, const Grid& grid, std::span<const double> normal);

/// Normal velocities [n_edges] of psi [n_vertices]: outflows telescope, so their sum over a cell is
/// rounding.
Array<double> flow_of(parallel::Executor& exec, const Grid& grid, std::span<const double> psi);

/// psi of the source grid at the target's vertices: a quadratic fit to the corners of the source
/// cell there and of its neighbours, so that velocities are good to second order; at vertices that
/// both grids have, the value itself. [target.n_vertices()]
Array<double> transfer_stream_function(parallel::Executor& exec, const Grid& source,
                                       const Grid& target, std::span<const double> psi);

/// The same where one of the grids has a border: psi on the source's land is its coast's. A coast
/// of the target gets that of the source's coast that most of its vertices lie at, so that what
/// flows between two coasts that both grids have is kept to the last bit; one that lies at none
/// gets the mean along it. `overlaps` are those of the grids' cells.
Array<double> transfer_stream_function(parallel::Executor& exec, const Overlaps& overlaps,
                                       const Grid& source, const Grid& target,
                                       std::span<const double> psi);

}  // namespace delos::remap
