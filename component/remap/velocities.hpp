// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Normal velocities from the edges of one grid to those of another.
#include <span>

#include "core/array.hpp"
#include "core/progress.hpp"
#include "remap/transfer.hpp"

namespace delos::remap {

enum class VelocityRoute {
  vectors,  ///< by the cells' Cartesian vectors
  /// The part without divergence by its stream function, so that it gets none; the rest as vectors.
  stream_function,
  /// Both parts by their potentials (Helmholtz): the one as above, the other by its velocity
  /// potential, then every cell gets the divergence that the old cells' is as a transferred field,
  /// whose sum is kept: within 1e-10 of velocity over spacing. To the order of `transfer`, limited
  /// by gradients if at all.
  helmholtz
};

struct VelocityOptions {
  VelocityRoute route = VelocityRoute::vectors;
  TransferOptions transfer;  ///< of the vectors' components
};

/// Grids whose cells a transfer was made for.
struct GridPair {
  const Grid& source;
  const Grid& target;
};

/// Normal components [n_edges of the target, n_levels] of the flow `normal` [n_edges of the source,
/// n_levels]. An edge between two unchanged cells keeps its value to the last bit (its sign where
/// the normal turned). Between grids with a border nothing flows through the target's border; by
/// vectors edges between bare cells get NaN; by the stream function an edge between unchanged cells
/// keeps its value unless a coast at it has another psi than before. Error(input) when a size does
/// not fit or for helmholtz with a border; Error(state) as Transfer::apply.
Array<double> transfer_velocities(Context& context, const Transfer& transfer, const GridPair& grids,
                                  std::span<const double> normal,
                                  const VelocityOptions& options = {});

}  // namespace delos::remap
