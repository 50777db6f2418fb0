// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Bodies of water: sea cells that are joined by sea cells.
#include <vector>

#include "domain/mask.hpp"

namespace delos::domain {

struct Body {
  Index first_cell = kNone;  ///< the lowest
  std::int64_t n_cells = 0;
  double area_m2 = 0.0;
};

struct Bodies {
  Array<Index> of_cell;      ///< [n_cells] its body, kNone on land
  std::vector<Body> bodies;  ///< in the order of their first cells
};

/// Joined means over an edge: cells of one vertex always share one. Linear, on one thread.
Bodies find_bodies(const Grid& grid, const Mask& sea);

/// Of the largest area; the first among equals. There must be one.
Index largest_body(const Bodies& bodies);

}  // namespace delos::domain
