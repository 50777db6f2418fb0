// SPDX-License-Identifier: BSD-3-Clause
#include "domain/order.hpp"

#include <algorithm>

#include "domain/cull.hpp"
#include "geometry/point_order.hpp"
#include "partition/partition.hpp"

namespace delos::domain {
namespace {

// Cells ordered by their part, parts by their first cell in `cells`.
std::vector<Index> by_part(parallel::Executor& exec, const Grid& grid,
                           const std::vector<Index>& cells, std::int64_t n_parts) {
  PartitionOptions options;
  options.n_parts = n_parts;
  options.method = PartitionMethod::kway;
  const std::vector<Index> part = partition(exec, cull(exec, grid, cells).grid, options);
  std::vector<std::int64_t> rank(at(n_parts), -1);
  std::int64_t next = 0;
  for (const Index p : part) {
    if (rank[at(p)] < 0) rank[at(p)] = next++;
  }
  std::vector<Index> slots(cells.size());
  for (std::size_t i = 0; i < slots.size(); ++i) slots[i] = static_cast<Index>(i);
  std::stable_sort(slots.begin(), slots.end(),
                   [&](Index a, Index b) { return rank[at(part[at(a)])] < rank[at(part[at(b)])]; });
  for (Index& slot : slots) slot = cells[at(slot)];
  return slots;
}

}  // namespace

std::vector<Index> order_cells(parallel::Executor& exec, const Grid& grid, const Mask& sea,
                               CellOrder order, std::int64_t n_parts) {
  std::vector<Index> cells;
  std::vector<Vec3> places;
  for (Index cell = 0; cell < grid.n_cells(); ++cell) {
    if (sea[at(cell)] == 0) continue;
    cells.push_back(cell);
    places.push_back(grid.cell_position[at(cell)]);
  }
  if (order == CellOrder::kept) return cells;
  std::vector<Index> along = hilbert_order(exec, places);
  for (Index& slot : along) slot = cells[at(slot)];
  return order == CellOrder::metis ? by_part(exec, grid, along, n_parts) : along;
}

}  // namespace delos::domain
