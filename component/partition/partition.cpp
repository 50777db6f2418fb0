// SPDX-License-Identifier: BSD-3-Clause
#include "partition/partition.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "geometry/point_order.hpp"
#include "partition/kway.hpp"

namespace delos {
namespace {

void check(const Grid& grid, const PartitionOptions& options) {
  DELOS_CHECK(options.n_parts >= 1, ErrorKind::config, "n_parts = ", options.n_parts,
              ": must be >= 1.");
  DELOS_CHECK(options.n_parts <= grid.n_cells(), ErrorKind::config, "the grid has ", grid.n_cells(),
              " cells, too few for ", options.n_parts,
              " parts of at least one: use fewer processes or a finer grid.");
  const std::span<const double> weight = options.cell_weight;
  if (weight.empty()) return;
  DELOS_CHECK(static_cast<std::int64_t>(weight.size()) == grid.n_cells(), ErrorKind::config,
              "there are ", weight.size(), " cell weights for ", grid.n_cells(),
              " cells: give one for each cell, or none.");
  const auto bad = std::find_if(weight.begin(), weight.end(),
                                [](double w) { return !(std::isfinite(w) && w >= 0.0); });
  DELOS_CHECK(bad == weight.end(), ErrorKind::config, "the weight of cell ", bad - weight.begin(),
              " is ", *bad, ": weights must be finite and >= 0.");
  DELOS_CHECK(std::any_of(weight.begin(), weight.end(), [](double w) { return w > 0.0; }),
              ErrorKind::config, "all cell weights are 0: give some cell work to do.");
}

/// Pieces of the Hilbert curve of equal weight, each of one cell at least.
std::vector<Index> along_curve(parallel::Executor& exec, const Grid& grid,
                               const PartitionOptions& options) {
  const std::int64_t n_cells = grid.n_cells(), n_parts = options.n_parts;
  const auto weight = [&](Index cell) {
    return options.cell_weight.empty() ? 1.0 : options.cell_weight[at(cell)];
  };
  const std::vector<Index> order = hilbert_order(exec, grid.cell_position);
  double total = 0.0;
  for (const Index cell : order) total += weight(cell);

  std::vector<Index> part(at(n_cells));
  std::int64_t current = 0, n_in_current = 0;
  double before = 0.0;
  for (std::int64_t k = 0; k < n_cells; ++k) {
    const Index cell = order[at(k)];
    const double middle = before + 0.5 * weight(cell);
    const bool is_due =
        middle * static_cast<double>(n_parts) >= total * static_cast<double>(current + 1);
    // The parts still to come need a cell each.
    const bool is_last_chance = n_cells - k == n_parts - current - 1;
    if (current + 1 < n_parts && n_in_current > 0 && (is_due || is_last_chance)) {
      ++current;
      n_in_current = 0;
    }
    part[at(cell)] = static_cast<Index>(current);
    ++n_in_current;
    before += weight(cell);
  }
  return part;
}

/// Whether a part has the work of so many of the heaviest cells that METIS can balance it; with a
/// handful it leaves parts empty, and prints.
bool suits_kway(const Grid& grid, const PartitionOptions& options) {
  constexpr double kFewest = 32.0;
  double sum = static_cast<double>(grid.n_cells()), heaviest = 1.0;
  if (!options.cell_weight.empty()) {
    sum = heaviest = 0.0;
    for (const double weight : options.cell_weight) {
      sum += weight;
      heaviest = std::max(heaviest, weight);
    }
  }
  return sum >= kFewest * heaviest * static_cast<double>(options.n_parts);
}

bool has_empty_part(const std::vector<Index>& part, std::int64_t n_parts) {
  std::vector<bool> is_used(at(n_parts), false);
  for (const Index p : part) is_used[at(p)] = true;
  return std::find(is_used.begin(), is_used.end(), false) != is_used.end();
}

}  // namespace

const char* to_string(PartitionMethod method) {
  switch (method) {
    case PartitionMethod::automatic:
      return "automatic";
    case PartitionMethod::kway:
      return "kway";
    case PartitionMethod::curve:
      return "curve";
  }
  return "unknown";
}

Partitioned partition_by(parallel::Executor& exec, const Grid& grid,
                         const PartitionOptions& options) {
  check(grid, options);
  if (options.n_parts == 1) {
    return {std::vector<Index>(at(grid.n_cells()), 0), PartitionMethod::curve};
  }
  const bool by_metis = options.method == PartitionMethod::kway ||
                        (options.method == PartitionMethod::automatic && kway::is_available());
  if (by_metis && (suits_kway(grid, options) || !kway::is_available())) {
    std::vector<Index> part =
        kway::partition(grid, static_cast<Index>(options.n_parts), options.cell_weight);
    if (!has_empty_part(part, options.n_parts)) return {std::move(part), PartitionMethod::kway};
  }
  return {along_curve(exec, grid, options), PartitionMethod::curve};
}

std::vector<Index> partition(parallel::Executor& exec, const Grid& grid,
                             const PartitionOptions& options) {
  return partition_by(exec, grid, options).part_of_cell;
}

}  // namespace delos
