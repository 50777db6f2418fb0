// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/whole_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/types.hpp"
#include "dual/build.hpp"

namespace delos {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// The cells without a value that lie beside `cells`, each once, in the order in which they are
/// met.
std::vector<Index> outside_of(const Grid& grid, const std::vector<Index>& cells,
                              std::vector<char>& is_reached) {
  std::vector<Index> out;
  for (const Index cell : cells) {
    for (const Index next : grid.cells_on_cell.row(cell)) {
      if (is_reached[at(next)] != 0) continue;
      is_reached[at(next)] = 1;
      out.push_back(next);
    }
  }
  return out;
}

double mean_of_neighbours(const Grid& grid, Index cell, const Array<double>& values) {
  double sum = 0.0;
  int n = 0;
  for (const Index next : grid.cells_on_cell.row(cell)) {
    if (std::isnan(values[at(next)])) continue;
    sum += values[at(next)];
    ++n;
  }
  return sum / n;
}

}  // namespace

const Grid& WholeGrid::grid() {
  if (!is_culled()) return *product_.grid;
  if (!made_) {
    const Phase phase(context_.monitor, "dual", product_.mesh.n_vertices());
    made_ =
        build_grid(context_, product_.settings.surface, product_.settings.latitude, product_.mesh);
  }
  return *made_;
}

Array<double> WholeGrid::spread(std::span<const double> values) const {
  if (!is_culled()) return {values.begin(), values.end()};
  Array<double> out;
  out.assign(at(product_.mesh.n_vertices()), kNoValue);
  const Array<Index>& cells = product_.domain->cells;
  for (std::size_t i = 0; i < values.size(); ++i) out[at(cells[i])] = values[i];
  return out;
}

Array<double> WholeGrid::flooded(std::span<const double> values) {
  Array<double> out = spread(values);
  if (!is_culled()) return out;
  const Grid& whole = grid();
  const Array<Index>& cells = product_.domain->cells;
  std::vector<char> is_reached(out.size(), 0);
  for (const Index cell : cells) is_reached[at(cell)] = 1;
  std::vector<Index> ring = outside_of(whole, {cells.begin(), cells.end()}, is_reached);
  std::vector<double> means;
  while (!ring.empty()) {
    // By the ring before alone: the order within a ring does not matter.
    means.clear();
    for (const Index cell : ring) means.push_back(mean_of_neighbours(whole, cell, out));
    for (std::size_t i = 0; i < ring.size(); ++i) out[at(ring[i])] = means[i];
    ring = outside_of(whole, ring, is_reached);
  }
  return out;
}

void WholeGrid::pick(std::span<const double> all, std::span<double> values) const {
  if (!is_culled()) {
    std::copy(all.begin(), all.end(), values.begin());
    return;
  }
  const Array<Index>& cells = product_.domain->cells;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = all[at(cells[i])];
}

}  // namespace delos
