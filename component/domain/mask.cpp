// SPDX-License-Identifier: BSD-3-Clause
#include "domain/mask.hpp"

#include <algorithm>
#include <vector>

namespace delos::domain {
namespace {

constexpr std::int64_t kMaskGrain = 4096;  // cells; tenths of a millisecond

// What surrounds a cell: sea neighbours, and the runs in which they stand around it. A run of kept
// cells alone is no run: where a passage opens into the sea, its mouth is no channel.
struct Shore {
  int n_sea = 0, n_runs = 0;
};

Shore shore_of(const Grid& grid, const Mask& keep, const Mask& sea, std::int64_t cell) {
  const auto neighbours = grid.cells_on_cell.row(cell);
  const auto is_sea = [&](Index neighbour) {
    return neighbour != kNone && sea[at(neighbour)] != 0;
  };
  const auto is_free = [&](Index neighbour) {
    return is_sea(neighbour) && keep[at(neighbour)] == 0;
  };
  Shore shore;
  shore.n_sea = static_cast<int>(std::count_if(neighbours.begin(), neighbours.end(), is_sea));
  // From a neighbour on land, so that no run is cut in two.
  const auto land = std::find_if_not(neighbours.begin(), neighbours.end(), is_sea);
  const auto start = land == neighbours.end() ? 0 : land - neighbours.begin();
  bool is_counted = false;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const Index neighbour = neighbours[(at(start) + i) % neighbours.size()];
    const bool begins = is_free(neighbour) && !is_counted;
    shore.n_runs += begins;
    is_counted = is_sea(neighbour) && (is_counted || begins);
  }
  return shore;
}

}  // namespace

std::int64_t count(parallel::Executor& exec, const Mask& mask) {
  return parallel::reduce(
      exec, static_cast<std::int64_t>(mask.size()), kMaskGrain, std::int64_t{0},
      [&](std::int64_t begin, std::int64_t end) {
        std::int64_t n = 0;
        for (std::int64_t i = begin; i < end; ++i) n += mask[at(i)];
        return n;
      },
      [](std::int64_t a, std::int64_t b) { return a + b; });
}

Mask wet_cells(parallel::Executor& exec, const Array<double>& wet_fraction, double least_wet) {
  Mask sea(wet_fraction.size());
  parallel::for_index(exec, static_cast<std::int64_t>(sea.size()), kMaskGrain,
                      [&](std::int64_t i) { sea[at(i)] = wet_fraction[at(i)] >= least_wet; });
  return sea;
}

PruneReport prune(parallel::Executor& exec, const Grid& grid, const PruneOptions& options,
                  const Mask& keep, Mask& sea) {
  struct Removal {
    Index cell;
    bool is_bay;
  };
  PruneReport report;
  if (!options.bays && !options.channels) return report;
  while (true) {
    const auto removals = parallel::collect<Removal>(
        exec, grid.n_cells(), kMaskGrain, [&](std::int64_t begin, std::int64_t end, auto& found) {
          for (std::int64_t i = begin; i < end; ++i) {
            if (sea[at(i)] == 0 || keep[at(i)] != 0) continue;
            const Shore shore = shore_of(grid, keep, sea, i);
            const bool is_bay = options.bays && shore.n_sea <= 1;
            const bool is_channel = options.channels && shore.n_runs >= 2;
            if (is_bay || is_channel) found.push_back({static_cast<Index>(i), is_bay});
          }
        });
    if (removals.empty()) return report;
    for (const Removal& removal : removals) {
      sea[at(removal.cell)] = 0;
      ++(removal.is_bay ? report.n_bays : report.n_channels);
    }
  }
}

}  // namespace delos::domain
