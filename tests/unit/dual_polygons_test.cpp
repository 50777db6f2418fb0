// SPDX-License-Identifier: BSD-3-Clause
#include "dual/polygons.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "domain/cull.hpp"
#include "dual/validate.hpp"
#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"

using namespace delos;
using delos::testing::expect_error;

namespace {

/// Cells of a cap, a ring with an island's hole, and one that hangs on the cap by two corners.
Grid part_of(const Ellipsoid& surface) {
  const Grid whole = samples::grid_of(surface, samples::shaken(surface, 3, 0.08, 5));
  std::vector<Index> cells;
  for (Index cell = 0; cell < whole.n_cells(); ++cell) {
    const Vec3 p = whole.cell_position[at(cell)].normalized();
    if ((p.z() > 0.2 * p.x() - 0.1 && p.y() < 0.95) || p.z() < -0.97) cells.push_back(cell);
  }
  parallel::Executor exec(1);
  return domain::cull(exec, whole, cells).grid;
}

CellPolygons polygons_of(const Grid& grid) {
  return {grid.surface, grid.latitude, grid.cell_position, grid.vertex_position,
          grid.vertices_on_cell};
}

Grid rebuilt(const CellPolygons& cells, int threads = 1) {
  parallel::Executor exec(threads);
  return grid_of_polygons(exec, cells);
}

std::vector<std::string> broken_rules(const Grid& grid) {
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  std::vector<std::string> out;
  for (const BrokenRule& rule : check_grid(context, grid)) out.push_back(to_string(rule));
  return out;
}

template <class Numbers>
double worst_relative(const Numbers& made, const Numbers& expected) {
  REQUIRE(made.size() == expected.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < made.size(); ++i) {
    worst = std::max(worst, std::abs(made[i] - expected[i]) / std::abs(expected[i]));
  }
  return worst;
}

}  // namespace

TEST_CASE("the polygons of a culled grid give back its tables and measures") {
  for (const Ellipsoid& surface : {Ellipsoid::sphere(6371220.0), Ellipsoid::wgs84(),
                                   Ellipsoid(Vec3(1.2, 1.0, 0.8), Vec3::Zero())}) {
    CAPTURE(surface.radii().transpose());
    const Grid grid = part_of(surface);
    const Grid made = rebuilt(polygons_of(grid));
    CHECK(made.cells_on_edge == grid.cells_on_edge);
    CHECK(made.vertices_on_edge == grid.vertices_on_edge);
    CHECK(made.edges_on_cell.values == grid.edges_on_cell.values);
    CHECK(made.cells_on_cell.values == grid.cells_on_cell.values);
    CHECK(made.edges_on_edge.values == grid.edges_on_edge.values);
    CHECK(made.vertices_on_cell.offsets == grid.vertices_on_cell.offsets);
    CHECK(worst_relative(made.cell_area_m2, grid.cell_area_m2) < 1e-12);
    CHECK(worst_relative(made.triangle_area_m2, grid.triangle_area_m2) < 1e-12);
    CHECK(worst_relative(made.vertex_distance_m, grid.vertex_distance_m) < 1e-12);
    CHECK(worst_relative(made.cell_distance_m, grid.cell_distance_m) < 1e-10);
    CHECK(worst_relative(made.weights_on_edge.values, grid.weights_on_edge.values) < 1e-8);
    double worst_place = 0.0;
    for (std::size_t i = 0; i < made.edge_position.size(); ++i) {
      worst_place = std::max(worst_place, (made.edge_position[i] - grid.edge_position[i]).norm());
    }
    CHECK(worst_place < 1e-11);
    CHECK(broken_rules(made) ==
          broken_rules(grid));  // some triangles of the triaxial one are obtuse
  }
}

TEST_CASE("grids of polygons have the same bits for any number of threads") {
  const CellPolygons cells = polygons_of(part_of(Ellipsoid::wgs84()));
  const Grid one = rebuilt(cells);
  for (const int threads : {2, 5}) {
    const Grid other = rebuilt(cells, threads);
    CHECK(other.weights_on_edge.values == one.weights_on_edge.values);
    CHECK(other.cell_area_m2 == one.cell_area_m2);
    CHECK(other.cell_distance_m == one.cell_distance_m);
  }
}

TEST_CASE("polygons that are no Voronoi cells are refused with their ids") {
  const CellPolygons sound = polygons_of(part_of(Ellipsoid::sphere(1.0)));
  const auto refused = [](const CellPolygons& cells, std::initializer_list<std::string> parts) {
    expect_error(ErrorKind::input, parts, [&] { rebuilt(cells); });
  };
  CellPolygons turned = sound;
  std::ranges::reverse(turned.corners_on_cell.row(7));
  refused(turned, {"two on one side", "8"});
  CellPolygons lone = sound;
  lone.corner.push_back(lone.corner.front());
  refused(lone, {text("corner ", lone.corner.size()), "belongs to no cell"});
  // Four squares around a corner, then two of them that meet there alone.
  CellPolygons squares;
  const auto point = [](double x, double y) { return Vec3(x, y, 1.0).normalized(); };
  for (const double y : {-0.1, 0.0, 0.1}) {
    for (const double x : {-0.1, 0.0, 0.1}) squares.corner.push_back(point(x, y));
  }
  for (const auto& [x, y] :
       {std::array{-0.05, -0.05}, {0.05, -0.05}, {-0.05, 0.05}, {0.05, 0.05}}) {
    squares.centre.push_back(point(x, y));
  }
  squares.corners_on_cell = {RowOffsets(Array<std::int64_t>{0, 4, 8, 12, 16}),
                             {0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 7, 6, 4, 5, 8, 7}};
  refused(squares, {"corner 5", "more than three cells"});
  squares.corner = {squares.corner[0], squares.corner[1], squares.corner[4], squares.corner[3],
                    squares.corner[5], squares.corner[8], squares.corner[7]};
  squares.centre = {squares.centre[0], squares.centre[3]};
  squares.corners_on_cell = {RowOffsets(Array<std::int64_t>{0, 4, 8}), {0, 1, 2, 3, 2, 4, 5, 6}};
  refused(squares, {"more than three edges meet at corner 3", "cells 1 and 2"});
}
