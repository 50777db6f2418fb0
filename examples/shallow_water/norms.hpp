// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How far one field is from another: Williamson et al. 1992, Eqs. 82 and 83.
#include <delos/delos.hpp>
#include <vector>

namespace shallow_water {

/// Relative to the norm of what is true.
struct Norms {
  double l2 = 0.0, largest = 0.0;
};

/// Both [n_cells], weighted by the cells' areas.
Norms error_norms(const delos::Grid& grid, const std::vector<double>& found,
                  const std::vector<double>& truth);

}  // namespace shallow_water
