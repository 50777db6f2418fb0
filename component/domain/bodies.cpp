// SPDX-License-Identifier: BSD-3-Clause
#include "domain/bodies.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace delos::domain {
Bodies find_bodies(const Grid& grid, const Mask& sea) {
  Bodies out;
  out.of_cell.assign(sea.size(), kNone);
  std::vector<Index> front;
  for (Index first = 0; first < grid.n_cells(); ++first) {
    if (sea[at(first)] == 0 || out.of_cell[at(first)] != kNone) continue;
    const auto id = static_cast<Index>(out.bodies.size());
    Body body{first, 0, 0.0};
    out.of_cell[at(first)] = id;
    front.assign(1, first);
    while (!front.empty()) {
      const Index cell = front.back();
      front.pop_back();
      ++body.n_cells;
      body.area_m2 += grid.cell_area_m2[at(cell)];
      for (const Index next : grid.cells_on_cell.row(cell)) {
        if (next == kNone || sea[at(next)] == 0 || out.of_cell[at(next)] != kNone) continue;
        out.of_cell[at(next)] = id;
        front.push_back(next);
      }
    }
    out.bodies.push_back(body);
  }
  return out;
}

Index largest_body(const Bodies& bodies) {
  DELOS_ASSERT(!bodies.bodies.empty());
  const auto largest =
      std::max_element(bodies.bodies.begin(), bodies.bodies.end(),
                       [](const Body& a, const Body& b) { return a.area_m2 < b.area_m2; });
  return static_cast<Index>(largest - bodies.bodies.begin());
}

}  // namespace delos::domain
