// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Every identity that a C-grid promises, checked on the arrays alone: for tests, for `delos check`
// and for grids that came from a file.
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "dual/grid.hpp"

namespace delos {

/// A rule that a grid breaks. Ids are of cells, edges or vertices, as the rule says.
struct BrokenRule {
  std::string rule;
  std::int64_t n_broken = 0;
  std::vector<Index> ids;  ///< the first eight
  double worst = 0.0;      ///< the largest error, in the rule's own measure; 1 for yes-or-no rules
};

/// Every broken rule, none for a right grid. `tolerance` is relative and for lengths, areas and
/// angles; 1e-6 suits grids written by the converter of MPAS-Tools. When sizes or ids are wrong
/// nothing else is looked at. A grid with a border (kNone in its tables) is judged by what holds
/// there: sums over the surface and what needs a missing cell are left out. Linear; the same answer
/// for any number of threads.
std::vector<BrokenRule> check_grid(Context& context, const Grid& grid, double tolerance = 1e-9);

/// One line, e.g. "kites are positive: 3 broken, ids 17 40 41, worst 2.1e-3".
std::string to_string(const BrokenRule& rule);

}  // namespace delos
