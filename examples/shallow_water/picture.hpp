// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Maps of a field above maps of its grid, and their animation.
#include <delos/delos.hpp>
#include <string>
#include <vector>

#include "cases.hpp"

namespace shallow_water {

/// A PNG of the field [n_cells] (above: negative blue, positive red) and of the grid (below), every
/// pixel in the colour of the cell that it lies in; small cells are dark.
std::string draw(const delos::Grid& grid, const std::vector<double>& field, const View& view,
                 const std::string& title);

/// One animated PNG of PNGs of equal size, 0.2 s each, again and again.
std::string animate(const std::vector<std::string>& pictures);

}  // namespace shallow_water
