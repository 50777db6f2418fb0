// SPDX-License-Identifier: BSD-3-Clause
#include "dual/validate.hpp"

#include "dual/rules.hpp"

namespace delos {

std::vector<BrokenRule> check_grid(Context& context, const Grid& grid, double tolerance) {
  std::vector<BrokenRule> broken;
  dual::Rules rules(context, broken);
  rules.check("the sizes of the arrays agree", 1, 0.0,
              [&](std::int64_t) { return dual::unless(dual::has_sizes(grid)); });
  if (!rules.all_hold()) return broken;
  if (is_closed(grid)) {
    rules.check("cells - edges + vertices = 2", 1, 0.0, [&](std::int64_t) {
      return std::abs(static_cast<double>(grid.n_cells() - grid.n_edges() + grid.n_vertices() - 2));
    });
  }
  dual::check_ids(grid, rules);
  if (!rules.all_hold()) return broken;
  dual::check_order(grid, rules);
  dual::check_geometry(grid, tolerance, rules);
  dual::check_areas(context, grid, tolerance, rules);
  dual::check_weights(context, grid, tolerance, rules);
  return broken;
}

std::string to_string(const BrokenRule& rule) {
  std::string out = text(rule.rule, ": ", rule.n_broken, " broken, ids");
  for (const Index id : rule.ids) out += text(" ", id);
  return out + text(", worst ", rule.worst);
}

}  // namespace delos
