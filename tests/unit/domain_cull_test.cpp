// SPDX-License-Identifier: BSD-3-Clause
#include "domain/cull.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "dual/digest.hpp"
#include "dual/validate.hpp"
#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"

using namespace delos;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);

Grid whole_grid(const Ellipsoid& surface) {
  return samples::grid_of(surface, samples::shaken(surface, 3, 0.08, 5));
}

/// The cells with keep(position), the last first.
template <class Keep>
std::vector<Index> cells_where(const Grid& grid, Keep&& keep) {
  std::vector<Index> cells;
  for (auto cell = static_cast<Index>(grid.n_cells()); cell-- > 0;) {
    if (keep(grid.cell_position[static_cast<std::size_t>(cell)])) cells.push_back(cell);
  }
  return cells;
}

bool in_north(const Vec3& p) { return p.z() > 0.2 * p.x() - 0.1; }

domain::Culled culled(const Grid& grid, std::span<const Index> cells, int threads = 1) {
  parallel::Executor exec(threads);
  return domain::cull(exec, grid, cells);
}

void expect_sound(const Grid& grid) {
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  for (const BrokenRule& rule : check_grid(context, grid)) FAIL_CHECK(to_string(rule));
}

}  // namespace

TEST_CASE("a part of a grid keeps every identity that needs no missing cell") {
  for (const Ellipsoid& surface : {kEarth, Ellipsoid::wgs84()}) {
    const Grid grid = whole_grid(surface);
    REQUIRE(is_closed(grid));
    const auto cells = cells_where(grid, in_north);
    REQUIRE(cells.size() > 100);
    const domain::Culled part = culled(grid, cells);
    CHECK(part.grid.n_cells() == static_cast<std::int64_t>(cells.size()));
    CHECK_FALSE(is_closed(part.grid));
    // One body without holes: a disc.
    CHECK(part.grid.n_cells() - part.grid.n_edges() + part.grid.n_vertices() == 1);
    expect_sound(part.grid);
  }
}

TEST_CASE("what stays of a culled grid has its bits, and missing kites are 0") {
  const Grid grid = whole_grid(kEarth);
  const domain::Culled part = culled(grid, cells_where(grid, in_north));
  const Grid& g = part.grid;
  for (std::size_t i = 0; i < part.old_cell.size(); ++i) {
    const Index old = part.old_cell[i];
    CHECK(g.cell_area_m2[i] == grid.cell_area_m2[at(old)]);
    const auto now = g.vertices_on_cell.row(static_cast<std::int64_t>(i));
    const auto then = grid.vertices_on_cell.row(old);
    REQUIRE(now.size() == then.size());
    for (std::size_t j = 0; j < now.size(); ++j) CHECK(part.old_vertex[at(now[j])] == then[j]);
  }
  std::int64_t n_cut = 0;
  for (std::size_t i = 0; i < part.old_vertex.size(); ++i) {
    const auto old = at(part.old_vertex[i]);
    CHECK(g.vertex_position[i] == grid.vertex_position[old]);
    double sum = 0.0;
    for (std::size_t j = 0; j < 3; ++j) {
      const bool is_gone = g.cells_on_vertex[i][j] == kNone;
      n_cut += is_gone;
      CHECK(g.kite_area_m2[i][j] == (is_gone ? 0.0 : grid.kite_area_m2[old][j]));
      sum += g.kite_area_m2[i][j];
    }
    CHECK(g.triangle_area_m2[i] == sum);
  }
  CHECK(n_cut > 10);
}

TEST_CASE("an edge of a culled grid turns with its normal, and so do its weights") {
  const Grid grid = whole_grid(kEarth);
  const domain::Culled part = culled(grid, cells_where(grid, in_north));
  const Grid& g = part.grid;
  std::map<std::pair<Index, Index>, double> weights;  // of old edges
  for (Index edge = 0; edge < grid.n_edges(); ++edge) {
    const auto row = grid.edges_on_edge.row(edge);
    for (std::size_t j = 0; j < row.size(); ++j) {
      weights[{edge, row[j]}] = grid.weights_on_edge.row(edge)[j];
    }
  }
  std::int64_t n_border = 0, n_turned = 0;
  const auto sign = [&](std::size_t edge) {
    const Index now = part.old_cell[static_cast<std::size_t>(g.cells_on_edge[edge][0])];
    const auto old = static_cast<std::size_t>(part.old_edge[edge]);
    return grid.cells_on_edge[old][0] == now ? 1.0 : -1.0;
  };
  for (std::size_t edge = 0; edge < part.old_edge.size(); ++edge) {
    const Index old = part.old_edge[edge];
    n_turned += sign(edge) < 0.0;
    const bool is_border = g.cells_on_edge[edge][1] == kNone;
    n_border += is_border;
    const auto row = g.edges_on_edge.row(static_cast<std::int64_t>(edge));
    const auto full = static_cast<std::size_t>(grid.edges_on_edge.offsets.length_of(old));
    CHECK((is_border ? row.size() < full : row.size() == full));
    for (std::size_t j = 0; j < row.size(); ++j) {
      const auto other = static_cast<std::size_t>(row[j]);
      CHECK(g.weights_on_edge.row(static_cast<std::int64_t>(edge))[j] ==
            sign(edge) * sign(other) * weights.at({old, part.old_edge[other]}));
    }
  }
  CHECK(n_border > 10);
  CHECK(n_turned > 100);  // the order of the cells was reversed
}

TEST_CASE("all cells in their order give the same grid but for the numbers of its vertices") {
  const Grid grid = whole_grid(kEarth);
  std::vector<Index> all(static_cast<std::size_t>(grid.n_cells()));
  std::iota(all.begin(), all.end(), 0);
  const domain::Culled same = culled(grid, all);
  CHECK(is_closed(same.grid));
  expect_sound(same.grid);
  CHECK(same.grid.cells_on_edge == grid.cells_on_edge);
  CHECK(same.grid.cells_on_cell.values == grid.cells_on_cell.values);
  CHECK(same.grid.edges_on_edge.values == grid.edges_on_edge.values);
  CHECK(same.grid.weights_on_edge.values == grid.weights_on_edge.values);
}

TEST_CASE("cells that touch in a corner alone or not at all can be culled to") {
  const Grid grid = whole_grid(kEarth);
  // A lone cell and a pair on the other side.
  const Index pair = grid.cells_on_cell.row(300)[0];
  const domain::Culled part = culled(grid, std::vector<Index>{7, 300, pair});
  expect_sound(part.grid);
  const auto degree = [&](Index cell) { return grid.edges_on_cell.offsets.length_of(cell); };
  CHECK(part.grid.n_edges() == degree(7) + degree(300) + degree(pair) - 1);
  CHECK(part.grid.n_vertices() == degree(7) + degree(300) + degree(pair) - 2);
}

TEST_CASE("culling has the same bits for any number of threads") {
  const Grid grid = whole_grid(kEarth);
  const auto cells = cells_where(grid, in_north);
  const std::string one = digest(culled(grid, cells).grid);
  for (const int threads : {2, 5, 8}) CHECK(digest(culled(grid, cells, threads).grid) == one);
}

TEST_CASE("a list of cells that is no part of the grid is refused") {
  const Grid grid = whole_grid(kEarth);
  testing::expect_error(ErrorKind::internal, {"no cells"},
                        [&] { culled(grid, std::vector<Index>{}); });
  testing::expect_error(ErrorKind::internal, {"cell 5", "twice"}, [&] {
    culled(grid, std::vector<Index>{5, 6, 5});
  });
}
