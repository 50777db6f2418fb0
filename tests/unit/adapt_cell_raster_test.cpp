// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/cell_raster.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"

using namespace delos;

namespace {

Grid grid_of_levels(int levels, const Ellipsoid& surface = Ellipsoid::sphere(6371220.0)) {
  return samples::grid_of(surface, samples::bisected_icosahedron(surface, levels));
}

double smooth_value(const Vec3& p) { return 2.0 + p.x() + 0.5 * p.y() * p.z(); }

std::vector<double> smooth_values(const Grid& grid) {
  std::vector<double> out;
  for (const Vec3& p : grid.cell_position) out.push_back(smooth_value(p));
  return out;
}

}  // namespace

TEST_CASE("a walk ends at the nearest cell from wherever it starts") {
  for (const Ellipsoid& surface : {Ellipsoid::sphere(6371220.0), Ellipsoid::wgs84(),
                                   Ellipsoid(Vec3(7.6e6, 6.4e6, 5.1e6), Vec3(0, 0, 0))}) {
    const Grid grid = grid_of_levels(3, surface);
    for (std::uint64_t k = 0; k < 300; ++k) {
      const Vec3 p = surface.project(
          Vec3(uniform01(1, k) - 0.5, uniform01(2, k) - 0.5, uniform01(3, k) - 0.5));
      double least = 10.0;
      for (const Vec3& q : grid.cell_position) least = std::min(least, (q - p).squaredNorm());
      const auto start = static_cast<Index>(k % at(grid.n_cells()));
      const Index cell = nearest_cell(grid, p, start);
      CHECK((grid.cell_position[at(cell)] - p).squaredNorm() == least);
    }
  }
}

TEST_CASE("on a table finer than the cells a node has its cell's value") {
  const Grid grid = grid_of_levels(2);  // 162 cells of about 16 degrees
  std::vector<double> number(at(grid.n_cells()));
  for (std::size_t i = 0; i < number.size(); ++i) number[i] = static_cast<double>(i);
  parallel::Executor exec(1);
  const Raster raster = raster_of_cells(exec, grid, number, 2.0 * kRadPerDeg, "number");
  CHECK(raster.n_lat() == 91);
  CHECK(raster.n_lon() == 180);
  CHECK(raster.periodic);
  for (std::size_t j = 0; j < raster.n_lat(); j += 3) {
    for (std::size_t i = 0; i < raster.n_lon(); i += 7) {
      const LonLat place{raster.lon_deg[i] * kRadPerDeg, raster.lat_deg[j] * kRadPerDeg};
      const Vec3 p = grid.surface.point(place, grid.latitude);
      const auto cell = static_cast<std::size_t>(raster.values[j * raster.n_lon() + i]);
      double least = 10.0;
      for (const Vec3& q : grid.cell_position) least = std::min(least, (q - p).norm());
      // The cell whose middle lies in the node's box may be a neighbour, by at most the box's size.
      CHECK((grid.cell_position[cell] - p).norm() < least + 3.0 * kRadPerDeg);
    }
  }
}

TEST_CASE("a raster of many cells keeps their area-weighted mean and smooth fields") {
  const Grid grid = grid_of_levels(5);  // 10 242 cells of about 2 degrees
  const std::vector<double> values = smooth_values(grid);
  for (const double resolution_deg : {1.0, 8.0}) {
    CAPTURE(resolution_deg);
    parallel::Executor exec(1);
    const Raster raster =
        raster_of_cells(exec, grid, values, resolution_deg * kRadPerDeg, "smooth");
    double worst = 0.0;
    for (std::size_t j = 0; j < raster.n_lat(); ++j) {
      for (std::size_t i = 0; i < raster.n_lon(); ++i) {
        const LonLat place{raster.lon_deg[i] * kRadPerDeg, raster.lat_deg[j] * kRadPerDeg};
        const double exact = smooth_value(grid.surface.point(place, grid.latitude));
        worst = std::max(worst, std::abs(raster.values[j * raster.n_lon() + i] - exact));
      }
    }
    CHECK(worst < 0.06);
  }
}

TEST_CASE("both poles are one value each, and a missing cell leaves its place to the others") {
  const Grid grid = grid_of_levels(5);
  std::vector<double> values = smooth_values(grid);
  const Index polar = nearest_cell(grid, grid.surface.project(Vec3(0, 0, 1)), 0);
  values[at(polar)] = std::nan("");
  parallel::Executor exec(1);
  const Raster raster = raster_of_cells(exec, grid, values, 6.0 * kRadPerDeg, "values");
  const std::size_t last = (raster.n_lat() - 1) * raster.n_lon();
  for (std::size_t i = 0; i < raster.n_lon(); ++i) {
    CHECK(raster.values[i] == raster.values[0]);
    CHECK(raster.values[last + i] == raster.values[last]);
  }
  CHECK(std::isfinite(raster.values[last]));
}

TEST_CASE("any number of threads gives the same raster") {
  const Grid grid = grid_of_levels(4);
  const std::vector<double> values = smooth_values(grid);
  parallel::Executor one(1);
  const Raster expected = raster_of_cells(one, grid, values, kRadPerDeg, "values");
  for (const int threads : {2, 5, 8}) {
    parallel::Executor exec(threads);
    CHECK(raster_of_cells(exec, grid, values, kRadPerDeg, "values").values == expected.values);
  }
}

TEST_CASE("a host's table is put in order") {
  const std::vector<double> lon{350.0, 260.0, 170.0, 80.0}, lat{60.0, 0.0, -60.0};
  std::vector<double> values;
  for (const double y : lat) {
    for (const double x : lon) values.push_back(1000.0 * y + x);
  }
  const Raster raster = raster_of_table(lon, lat, values, "table");
  CHECK(raster.lat_deg == std::vector<double>{-60.0, 0.0, 60.0});
  CHECK(raster.lon_deg == std::vector<double>{80.0, 170.0, 260.0, 350.0});
  CHECK(raster.periodic);
  CHECK(raster.values[0] == -60000.0 + 80.0);
  CHECK(raster.values[11] == 60000.0 + 350.0);
}

TEST_CASE("a repeated column is dropped, and parts of the globe are not periodic") {
  const std::vector<double> lat{0.0, 1.0}, round{180.0, 270.0, 360.0, 450.0, 540.0};
  const std::vector<double> part{0.0, 10.0, 20.0};
  const std::vector<double> ten(10, 1.0), six(6, 1.0);
  const Raster raster = raster_of_table(round, lat, ten, "round");
  CHECK(raster.lon_deg == std::vector<double>{-180.0, -90.0, 0.0, 90.0});
  CHECK(raster.periodic);
  CHECK(raster.values.size() == 8);
  CHECK(!raster_of_table(part, lat, six, "part").periodic);
  testing::expect_error(ErrorKind::input, {"part has 10 values", "3 longitudes"},
                        [&] { raster_of_table(part, lat, ten, "part"); });
}

TEST_CASE("the default resolution is the least spacing within bounds") {
  Grid grid = grid_of_levels(2);
  for (double& spacing_m : grid.cell_spacing_m) spacing_m = 50.0e3;
  CHECK(cell_resolution_rad(grid) == doctest::Approx(50.0 / 6371.22));
  grid.cell_spacing_m[3] = 1.0e3;
  CHECK(cell_resolution_rad(grid) == doctest::Approx(kRadPerDeg / 12.0));
  for (double& spacing_m : grid.cell_spacing_m) spacing_m = 900.0e3;
  CHECK(cell_resolution_rad(grid) == doctest::Approx(kRadPerDeg));
}
