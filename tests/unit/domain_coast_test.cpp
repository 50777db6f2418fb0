// SPDX-License-Identifier: BSD-3-Clause
#include "domain/coast.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "domain/transects.hpp"
#include "support/sample_grids.hpp"

using namespace delos;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);
constexpr double kEquator = 2.0 * kPi * 6371220.0;

Grid made_grid() { return samples::grid_of(kEarth, samples::shaken(kEarth, 4, 0.08, 3)); }

struct Sea {
  domain::Mask mask;
  Array<double> wet;
  void set(Index cell, bool is_sea) {
    mask[at(cell)] = is_sea;
    wet[at(cell)] = is_sea ? 1.0 : 0.0;
  }
};

// All south of 2 degrees: between two rows of cells, of which one lies on the equator.
Sea southern(const Grid& grid) {
  Sea sea{domain::Mask(grid.cell_position.size()), Array<double>(grid.cell_position.size())};
  for (Index cell = 0; cell < grid.n_cells(); ++cell) {
    sea.set(cell, grid.cell_lon_lat[at(cell)].lat_rad < 2.0 * kRadPerDeg);
  }
  return sea;
}

domain::CoastReport measured(const Grid& grid, const Sea& sea, int threads = 1) {
  parallel::Executor exec(threads);
  return domain::measure_coast(exec, grid, sea.mask, sea.wet, 0.5);
}

Index cell_at(const Grid& grid, double lon_deg, double lat_deg) {
  return domain::cell_at(
      grid, grid.surface.point({lon_deg * kRadPerDeg, lat_deg * kRadPerDeg}, grid.latitude));
}

}  // namespace

TEST_CASE("the coast of half a globe is a stair about the equator without tips") {
  const Grid grid = made_grid();
  const domain::CoastReport coast = measured(grid, southern(grid));
  CHECK(coast.n_edges > 2 * 70);
  CHECK(coast.line_m > 0.99 * kEquator);
  CHECK(coast.line_m < 1.15 * kEquator);
  CHECK(coast.length_m > 1.1 * kEquator);
  CHECK(coast.length_m < 1.45 * kEquator);
  CHECK(coast.mean_turn_deg > 50.0);
  CHECK(coast.mean_turn_deg < 70.0);
  CHECK(coast.stair_share > 0.2);
  // Half a side of a hexagon.
  const double side_m = coast.length_m / static_cast<double>(coast.n_edges);
  CHECK(coast.step_m == doctest::Approx(0.5 * side_m).epsilon(0.1));
  CHECK(coast.n_sea_tips == 0);
  CHECK(coast.n_land_tips == 0);
  CHECK(coast.offset_m == 0.0);
  CHECK(coast.sharpest_sea.angle_deg > 90.0);
  CHECK(coast.sharpest_land.angle_deg < 270.0);
}

TEST_CASE("the line is where the wet share passes that of a sea cell, whatever the cells are") {
  const Grid grid = made_grid();
  Sea sea = southern(grid);
  // Falling by one over 20 degrees, so that no cell along the coast is all wet or all dry.
  for (Index cell = 0; cell < grid.n_cells(); ++cell) {
    const double lat_deg = grid.cell_lon_lat[at(cell)].lat_rad * kDegPerRad;
    sea.wet[at(cell)] = std::clamp(0.5 - (lat_deg - 2.0) / 20.0, 0.0, 1.0);
  }
  const domain::CoastReport coast = measured(grid, sea);
  CHECK(coast.line_m == doctest::Approx(kEquator).epsilon(0.005));
  CHECK(coast.length_m > 1.15 * coast.line_m);
  CHECK(coast.offset_m > 1e4);
}

TEST_CASE("islands, ponds and tips of one cell are counted, and where the sharpest corner is") {
  const Grid grid = made_grid();
  Sea sea = southern(grid);
  const domain::CoastReport before = measured(grid, sea);
  sea.set(cell_at(grid, 50.0, -45.0), false);
  sea.set(cell_at(grid, 50.0, 45.0), true);
  const domain::CoastReport coast = measured(grid, sea);
  CHECK(coast.n_land_tips == before.n_land_tips + 1);
  CHECK(coast.n_sea_tips == before.n_sea_tips + 1);
  CHECK(coast.n_edges > before.n_edges + 10);
  CHECK(coast.line_m > before.line_m);
  // The sharpest corner has the angle that its cell or cells leave.
  CHECK(coast.sharpest_land.angle_deg >= before.sharpest_land.angle_deg);
}

TEST_CASE("what is dry of the sea and wet of the land is the offset of the coast") {
  const Grid grid = made_grid();
  Sea sea = southern(grid);
  const double length = measured(grid, sea).length_m;
  double area = 0.0;
  for (Index cell = 0; cell < grid.n_cells(); ++cell) {
    const auto row = grid.cells_on_cell.row(cell);
    const bool is_coastal = std::any_of(row.begin(), row.end(), [&](Index other) {
      return sea.mask[at(other)] != sea.mask[at(cell)];
    });
    if (!is_coastal || sea.mask[at(cell)] == 0) continue;
    sea.wet[at(cell)] = 0.9;
    area += 0.1 * grid.cell_area_m2[at(cell)];
  }
  const domain::CoastReport coast = measured(grid, sea);
  CHECK(coast.offset_m == doctest::Approx(area / length).epsilon(1e-12));
}

TEST_CASE("a globe of sea has no coast, and no number of threads changes a bit") {
  const Grid grid = made_grid();
  Sea sea = southern(grid);
  const domain::CoastReport one = measured(grid, sea);
  for (const int threads : {2, 5, 8}) {
    const domain::CoastReport other = measured(grid, sea, threads);
    CHECK(other.length_m == one.length_m);
    CHECK(other.line_m == one.line_m);
    CHECK(other.offset_m == one.offset_m);
    CHECK(other.mean_turn_deg == one.mean_turn_deg);
  }
  for (Index cell = 0; cell < grid.n_cells(); ++cell) sea.set(cell, true);
  CHECK(measured(grid, sea).n_edges == 0);
}
