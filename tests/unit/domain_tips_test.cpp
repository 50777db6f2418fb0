// SPDX-License-Identifier: BSD-3-Clause
#include "domain/tips.hpp"

#include <doctest/doctest.h>

#include "support/sample_grids.hpp"
#include "support/sample_meshes.hpp"

using namespace delos;

namespace {

/// A hemisphere of sea, and one cell across its coast of that kind too: a tip.
struct Example {
  Grid grid;
  domain::Mask sea;
  std::vector<double> wet;
  Index tip = kNone;

  explicit Example(bool tip_is_sea) {
    const Ellipsoid earth = Ellipsoid::sphere(6371220.0);
    grid = samples::grid_of(earth, samples::bisected_icosahedron(earth, 3));
    const auto n = static_cast<std::size_t>(grid.n_cells());
    sea.assign(n, 0);
    for (std::size_t i = 0; i < n; ++i) sea[i] = (grid.cell_position[i].x() > 0.2) == tip_is_sea;
    if (!tip_is_sea) {
      for (std::size_t i = 0; i < n; ++i) sea[i] = grid.cell_position[i].x() <= 0.2;
    }
    wet.assign(sea.begin(), sea.end());
    // Far from the other side but for one neighbour or two.
    const auto kind = static_cast<std::uint8_t>(tip_is_sea ? 1 : 0);
    for (Index cell = 0; cell < grid.n_cells() && tip == kNone; ++cell) {
      int n_same = 0;
      for (const Index other : grid.cells_on_cell.row(cell)) n_same += sea[at(other)] == kind;
      if (sea[at(cell)] != kind && n_same == 2) tip = cell;
    }
    REQUIRE(tip != kNone);
    sea[at(tip)] = kind;
  }

  std::int64_t clear(double margin) {
    return domain::clear_tips(
        {wet, 0.5, margin},
        [&](Index cell, std::vector<Index>& around) {
          const auto row = grid.cells_on_cell.row(cell);
          around.assign(row.begin(), row.end());
        },
        sea);
  }
};

}  // namespace

TEST_CASE("a tip changes its kind where its wet share is doubtful, and nothing else does") {
  for (const bool is_sea : {true, false}) {
    CAPTURE(is_sea);
    Example example(is_sea);
    example.wet[at(example.tip)] = is_sea ? 0.6 : 0.4;
    const domain::Mask before = example.sea;
    CHECK(example.clear(0.05) == 0);
    CHECK(example.clear(0.2) == 1);
    for (std::size_t i = 0; i < before.size(); ++i) {
      CHECK((example.sea[i] != before[i]) == (static_cast<Index>(i) == example.tip));
    }
  }
}

TEST_CASE("a straight coast stays, however doubtful its cells are") {
  Example example(true);
  example.sea[at(example.tip)] = 0;
  example.wet.assign(example.wet.size(), 0.5);
  const domain::Mask before = example.sea;
  example.clear(0.2);
  std::int64_t n = 0;
  for (std::size_t i = 0; i < before.size(); ++i) n += example.sea[i] != before[i];
  CHECK(n <= 2);  // pentagons of the icosahedron stand where they stand
}
