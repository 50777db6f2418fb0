// SPDX-License-Identifier: BSD-3-Clause
#include "domain/passages.hpp"

#include <algorithm>

#include "domain/transects.hpp"

namespace delos::domain {
namespace {

bool is_among(const std::vector<Index>& cells, Index cell) {
  return std::find(cells.begin(), cells.end(), cell) != cells.end();
}

std::int64_t open(const std::vector<Index>& way, Mask& sea) {
  std::int64_t n_opened = 0;
  for (const Index cell : way) {
    n_opened += sea[at(cell)] == 0;
    sea[at(cell)] = 1;
  }
  return n_opened;
}

// From an end of a passage to the sea beyond it.
std::int64_t join_end(const Grid& grid, const Mask& before, const std::vector<Index>& passage,
                      Index end, Mask& sea) {
  const auto is_beyond = [&](Index cell) { return sea[at(cell)] != 0 && !is_among(passage, cell); };
  const auto is_open = [&](Index cell) {
    return before[at(cell)] != 0 && !is_among(passage, cell);
  };
  const auto way = shortest_way(grid, {end}, is_beyond, is_open);
  return way ? open(*way, sea) : 0;
}

}  // namespace

std::int64_t join_passages(const Grid& grid, const SeaAround& around,
                           const std::vector<std::vector<Index>>& passages, Mask& sea) {
  std::int64_t n_opened = 0;
  for (const std::vector<Index>& passage : passages) {
    if (passage.empty()) continue;
    for (const Index end : {passage.front(), passage.back()}) {
      n_opened += join_end(grid, around.before, passage, end, sea);
    }
  }
  Mask kept = passages.empty() ? Mask{} : around.kept(sea);
  const auto is_kept = [&](Index cell) { return kept[at(cell)] != 0; };
  const auto is_open = [&](Index cell) { return around.before[at(cell)] != 0; };
  for (const std::vector<Index>& passage : passages) {
    if (std::any_of(passage.begin(), passage.end(), is_kept)) continue;
    const auto way = shortest_way(grid, passage, is_kept, is_open);
    if (!way) continue;
    n_opened += open(*way, sea);
    kept = around.kept(sea);
  }
  return n_opened;
}

}  // namespace delos::domain
