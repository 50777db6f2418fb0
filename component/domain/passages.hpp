// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Passages that reach the open sea.
#include <functional>
#include <vector>

#include "domain/mask.hpp"
#include "dual/grid.hpp"

namespace delos::domain {

/// The sea before bays and channels were taken out of it, and which bodies of a sea are kept, as a
/// mask of their cells.
struct SeaAround {
  const Mask& before;
  std::function<Mask(const Mask& sea)> kept;
};

/// Gives back of the sea before pruning what the passages need to lead somewhere: the shortest way
/// from an end that stands alone to the nearest sea beyond the passage, then that from a passage
/// whose body is not kept to one that is. `sea` holds the cells of all passages; so does the sea
/// before. A passage that no way joins stays as it is. Returns the number of cells given back.
std::int64_t join_passages(const Grid& grid, const SeaAround& around,
                           const std::vector<std::vector<Index>>& passages, Mask& sea);

}  // namespace delos::domain
