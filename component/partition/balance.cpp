// SPDX-License-Identifier: BSD-3-Clause
#include "partition/balance.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace delos {

PartitionBalance measure_partition(const Grid& grid, std::span<const Index> part_of_cell,
                                   std::int64_t n_parts, std::span<const double> weight) {
  const auto part_of = [&](Index cell) { return part_of_cell[static_cast<std::size_t>(cell)]; };
  PartitionBalance out;
  std::int64_t n_inner = 0;
  for (const auto& [a, b] : grid.cells_on_edge) {
    if (a == kNone || b == kNone) continue;  // on a border
    ++n_inner;
    if (part_of(a) != part_of(b)) ++out.n_cut_edges;
  }
  if (n_inner > 0) {
    out.cut_share = static_cast<double>(out.n_cut_edges) / static_cast<double>(n_inner);
  }
  std::vector<double> load(static_cast<std::size_t>(n_parts), 0.0);
  for (std::size_t cell = 0; cell < part_of_cell.size(); ++cell) {
    load[static_cast<std::size_t>(part_of_cell[cell])] += weight.empty() ? 1.0 : weight[cell];
  }
  const double mean = std::accumulate(load.begin(), load.end(), 0.0) / static_cast<double>(n_parts);
  const auto [least, most] = std::minmax_element(load.begin(), load.end());
  out.heaviest = *most / mean;
  out.lightest = *least / mean;
  return out;
}

}  // namespace delos
