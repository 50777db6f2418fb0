// SPDX-License-Identifier: BSD-3-Clause
#include "partition/partition.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "partition/balance.hpp"
#include "partition/kway.hpp"
#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"

using namespace delos;
using delos::testing::expect_error;

namespace {

Grid bisected(int levels) {
  const Ellipsoid surface;
  return samples::grid_of(surface, samples::bisected_icosahedron(surface, levels));
}

std::vector<PartitionMethod> methods() {
  std::vector<PartitionMethod> out{PartitionMethod::automatic, PartitionMethod::curve};
  if (kway::is_available()) out.push_back(PartitionMethod::kway);
  return out;
}

std::vector<double> loads(const std::vector<Index>& part, std::int64_t n_parts,
                          const std::vector<double>& weight) {
  std::vector<double> out(static_cast<std::size_t>(n_parts), 0.0);
  for (std::size_t i = 0; i < part.size(); ++i) out[static_cast<std::size_t>(part[i])] += weight[i];
  return out;
}

/// The grid without what lies across the edges of one cell: a hole, and one cell cut off.
Grid with_borders_around(Grid grid, Index cell) {
  for (auto& ends : grid.cells_on_edge) {
    if (ends[0] != cell && ends[1] != cell) continue;
    ends = {std::min(ends[0], ends[1]) == cell ? cell : std::min(ends[0], ends[1]), kNone};
  }
  for (Index i = 0; i < grid.n_cells(); ++i) {
    for (Index& neighbour : grid.cells_on_cell.row(i)) {
      if (i == cell || neighbour == cell) neighbour = kNone;
    }
  }
  return grid;
}

}  // namespace

TEST_CASE("parts are of equal weight, and none is empty") {
  parallel::Executor exec(2);
  const Grid grid = bisected(4);
  const auto n_cells = static_cast<std::size_t>(grid.n_cells());
  std::vector<double> layers(n_cells);
  for (std::size_t i = 0; i < n_cells; ++i) {
    // Land on one side of the globe, then shallow to deep.
    layers[i] = std::max(0.0, std::floor(60.0 * grid.cell_position[i].x()));
  }
  const std::vector<double> ones(n_cells, 1.0);
  for (const PartitionMethod method : methods()) {
    for (const std::int64_t n_parts : {1, 2, 3, 7, 16}) {
      CAPTURE(to_string(method));
      CAPTURE(n_parts);
      const auto shares = [&](const std::vector<double>& weight) {
        const auto load = loads(partition(exec, grid, {n_parts, method, weight}), n_parts, weight);
        double sum = 0.0;
        for (const double l : load) sum += l;
        const auto [least, most] = std::minmax_element(load.begin(), load.end());
        return std::pair{*least * static_cast<double>(n_parts) / sum,
                         *most * static_cast<double>(n_parts) / sum};
      };
      CHECK(shares(ones).first > 0.93);
      CHECK(shares(ones).second < 1.04);
      CHECK(shares(layers).first > 0.75);
      CHECK(shares(layers).second < 1.25);
    }
  }
}

TEST_CASE("every cell can have a part of its own") {
  parallel::Executor exec(1);
  const Grid grid = bisected(1);
  std::vector<double> uneven(static_cast<std::size_t>(grid.n_cells()), 0.0);
  uneven[3] = 1.0;
  for (const PartitionMethod method : methods()) {
    CAPTURE(to_string(method));
    for (std::int64_t n_parts = 1; n_parts <= grid.n_cells(); ++n_parts) {
      CAPTURE(n_parts);
      for (const std::span<const double> weight : {std::span<const double>(), {uneven}}) {
        std::vector<int> n_in(static_cast<std::size_t>(n_parts), 0);
        for (const Index p : partition(exec, grid, {n_parts, method, weight})) {
          REQUIRE((p >= 0 && p < n_parts));
          ++n_in[static_cast<std::size_t>(p)];
        }
        CHECK(*std::min_element(n_in.begin(), n_in.end()) >= 1);
      }
    }
  }
}

TEST_CASE("borders are as short as a part's shape allows") {
  parallel::Executor exec(1);
  const Grid grid = bisected(5);  // 10 242 cells
  constexpr std::int64_t kParts = 16;
  // A round patch of 3 r^2 hexagons has 12 r + 6 edges around it: r = 14.6, two patches an edge.
  constexpr double kRound = kParts * (12 * 14.6 + 6) / 2.0;
  for (const PartitionMethod method : methods()) {
    CAPTURE(to_string(method));
    const auto part = partition(exec, grid, {kParts, method, {}});
    const double bound = (method == PartitionMethod::curve || !kway::is_available()) ? 1.5 : 1.2;
    CHECK(static_cast<double>(measure_partition(grid, part, kParts).n_cut_edges) < bound * kRound);
  }
}

TEST_CASE("a grid with a border and two pieces is cut by its inner edges") {
  parallel::Executor exec(1);
  const Grid whole = bisected(4);
  const Grid grid = with_borders_around(whole, 100);
  for (const PartitionMethod method : methods()) {
    CAPTURE(to_string(method));
    const auto made = partition_by(exec, grid, {4, method, {}});
    const PartitionBalance balance = measure_partition(grid, made.part_of_cell, 4);
    std::int64_t n_cut = 0;
    for (Index cell = 0; cell < grid.n_cells(); ++cell) {
      for (const Index other : grid.cells_on_cell.row(cell)) {
        n_cut += other > cell && made.part_of_cell[static_cast<std::size_t>(other)] !=
                                     made.part_of_cell[static_cast<std::size_t>(cell)];
      }
    }
    CHECK(balance.n_cut_edges == n_cut);
    CHECK(balance.cut_share ==
          static_cast<double>(n_cut) /
              static_cast<double>(whole.n_edges() - whole.cells_on_cell.offsets.length_of(100)));
    CHECK(balance.heaviest < 1.05);
  }
}

TEST_CASE("the balance is told by weight, and by which method") {
  parallel::Executor exec(1);
  const Grid grid = bisected(1);
  std::vector<Index> part(static_cast<std::size_t>(grid.n_cells()), 0);
  std::vector<double> weight(part.size(), 0.0);
  part[3] = 1;
  weight[3] = 3.0;
  weight[5] = 1.0;
  const PartitionBalance balance = measure_partition(grid, part, 2, weight);
  CHECK(balance.heaviest == 1.5);
  CHECK(balance.lightest == 0.5);
  CHECK(balance.n_cut_edges == grid.cells_on_cell.offsets.length_of(3));
  CHECK(partition_by(exec, grid, {2, PartitionMethod::curve, {}}).method == PartitionMethod::curve);
  // Too few cells a part for METIS.
  CHECK(partition_by(exec, grid, {8, PartitionMethod::automatic, {}}).method ==
        PartitionMethod::curve);
  if (kway::is_available()) {
    CHECK(partition_by(exec, bisected(3), {2, PartitionMethod::automatic, {}}).method ==
          PartitionMethod::kway);
  }
}

TEST_CASE("a partition is the same again, whatever the threads and the host's random numbers") {
  const Grid grid = bisected(4);
  for (const PartitionMethod method : methods()) {
    CAPTURE(to_string(method));
    parallel::Executor one(1);
    const auto first = partition(one, grid, {6, method, {}});
    for (const int threads : {2, 5}) {
      parallel::Executor exec(threads);
      std::srand(static_cast<unsigned>(threads));
      std::srand(7);
      const int expected = std::rand();
      const int expected_next = std::rand();
      std::srand(7);
      CHECK(std::rand() == expected);
      CHECK(partition(exec, grid, {6, method, {}}) == first);
      CHECK(std::rand() == expected_next);
    }
  }
}

TEST_CASE("a partition that can't be is refused with what to do") {
  parallel::Executor exec(1);
  const Grid grid = bisected(0);
  const auto refused = [&](std::int64_t n_parts, const std::vector<double>& weight,
                           const std::string& message) {
    expect_error(ErrorKind::config, {message}, [&] {
      static_cast<void>(partition(exec, grid, {n_parts, PartitionMethod::curve, weight}));
    });
  };
  refused(0, {}, "n_parts = 0: must be >= 1");
  refused(13, {}, "the grid has 12 cells, too few for 13 parts");
  refused(2, {1.0, 2.0}, "there are 2 cell weights for 12 cells");
  std::vector<double> weight(12, 1.0);
  weight[5] = -1.0;
  refused(2, weight, "the weight of cell 5 is -1: weights must be finite and >= 0");
  weight[5] = std::numeric_limits<double>::quiet_NaN();
  refused(2, weight, "the weight of cell 5 is");
  refused(2, std::vector<double>(12, 0.0), "all cell weights are 0");
  if (!kway::is_available()) {
    expect_error(ErrorKind::config, {"built without METIS"}, [&] {
      static_cast<void>(partition(exec, grid, {2, PartitionMethod::kway, {}}));
    });
  }
}
