// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// When two grids are the same.
#include <string>

#include "core/parallel.hpp"
#include "dual/grid.hpp"

namespace delos {

/// A digest (hex) of every array of the grid but edge_spacing_m, and of the surface: two grids are
/// "the same to the last bit" iff these agree. SHA-256 of the arrays' sizes in bytes, in the order
/// of their declaration, and of the SHA-256 of every MiB of each array, so that all threads help;
/// rows that a table shares with a former one count once.
std::string digest(parallel::Executor& exec, const Grid& grid);
/// The same by one thread.
std::string digest(const Grid& grid);

}  // namespace delos
