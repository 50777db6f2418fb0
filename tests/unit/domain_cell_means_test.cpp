// SPDX-License-Identifier: BSD-3-Clause
#include "domain/cell_means.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/elementary.hpp"
#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"

using namespace delos;

namespace {

/// f(unit vector) on the nodes of a table of one degree.
LatLonField table_of(const std::function<double(const Vec3&)>& f) {
  LatLonField field = make_table(kRadPerDeg);
  for (Index row = 0; row < field.n_rows(); ++row) {
    const auto lat = elementary::sincos(field.lat_rad(row));
    for (Index i = 0; i < field.n_lon; ++i) {
      const auto lon = elementary::sincos(field.lon_rad(i));
      field.values[field.at(row, i)] = f({lat.cos * lon.cos, lat.cos * lon.sin, lat.sin});
    }
  }
  return field;
}

domain::CellMeans means_of(const Grid& grid, const LatLonField& field, int threads = 1) {
  parallel::Executor exec(threads);
  Monitor monitor;
  Context context{exec, monitor};
  return domain::mean_over_cells(context, grid, field);
}

double total(const Array<double>& share, const Grid& grid) {
  double sum = 0.0;
  for (std::size_t i = 0; i < share.size(); ++i) sum += share[i] * grid.cell_area_m2[i];
  return sum;
}

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);

Grid sample_grid(int levels) {
  return samples::grid_of(kEarth, samples::shaken(kEarth, levels, 0.2, 7));
}

}  // namespace

TEST_CASE("the wet half of a globe is half of it, whichever way it lies") {
  const Grid grid = sample_grid(4);
  const double whole = total(Array<double>(grid.cell_area_m2.size(), 1.0), grid);
  // Through the poles, across the date line, and askew; the coast cuts through cells.
  for (const Vec3& up : {Vec3(0, 0, 1), Vec3(-1, 0, 0), Vec3(0.3, -0.5, 0.81)}) {
    const Vec3 axis = up.normalized();
    const auto means =
        means_of(grid, table_of([&](const Vec3& p) { return 4000.0 * axis.dot(p); }));
    CHECK(total(means.wet_fraction, grid) == doctest::Approx(0.5 * whole).epsilon(5e-4));
    for (std::size_t i = 0; i < grid.cell_position.size(); ++i) {
      const double here = 4000.0 * axis.dot(grid.cell_position[i]);
      CAPTURE(i);
      // The mean of a smooth field differs from its value at the generator by the offset of the
      // cell's middle, a few kilometres of 6371.
      REQUIRE(std::abs(means.elevation_m[i] - here) < 4000.0 * 0.03);
      if (here < -1000.0) {
        REQUIRE(means.wet_fraction[i] == 1.0);
        REQUIRE(means.wet_depth_m[i] == doctest::Approx(-means.elevation_m[i]).epsilon(1e-12));
      } else if (here > 1000.0) {
        REQUIRE(means.wet_fraction[i] == 0.0);
        REQUIRE(means.wet_depth_m[i] == 0.0);
      }
    }
  }
}

TEST_CASE("means over cells add up to the integral of the field") {
  // The integral of p.x^2 over the unit sphere is a third of its area.
  const Grid grid = sample_grid(4);
  const auto means = means_of(grid, table_of([](const Vec3& p) { return p.x() * p.x() + 1.0; }));
  double sum = 0.0, area = 0.0;
  for (std::size_t i = 0; i < means.elevation_m.size(); ++i) {
    sum += means.elevation_m[i] * grid.cell_area_m2[i];
    area += grid.cell_area_m2[i];
  }
  CHECK(sum / area == doctest::Approx(4.0 / 3.0).epsilon(1e-4));
}

TEST_CASE("cells much larger and much smaller than the table's are averaged alike") {
  const auto stripes =
      table_of([](const Vec3& p) { return std::abs(p.z()) < 0.25 ? -100.0 : 50.0; });
  for (const int levels : {1, 5}) {
    const Grid grid = samples::grid_of(kEarth, samples::bisected_icosahedron(kEarth, levels));
    const auto means = means_of(grid, stripes);
    double area = 0.0;
    for (const double a : grid.cell_area_m2) area += a;
    // The zone |z| < 1/4 has a quarter of the area; the zero lies within one step of its border.
    CHECK(total(means.wet_fraction, grid) / area == doctest::Approx(0.25).epsilon(0.04));
  }
}

TEST_CASE("what is missing is dry and does not count in the means") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Grid grid = sample_grid(3);
  const auto means =
      means_of(grid, table_of([&](const Vec3& p) { return p.x() > 0.0 ? nan : -10.0; }));
  for (std::size_t i = 0; i < grid.cell_position.size(); ++i) {
    const double x = grid.cell_position[i].x();
    CAPTURE(x);
    if (x > 0.2) {
      REQUIRE(means.wet_fraction[i] == 0.0);
      REQUIRE(std::isnan(means.elevation_m[i]));
    } else if (x < -0.2) {
      REQUIRE(means.wet_fraction[i] == 1.0);
    }
    if (means.wet_fraction[i] > 0.0) REQUIRE(means.wet_depth_m[i] == doctest::Approx(10.0));
  }
}

TEST_CASE("means over cells have the same bits for any number of threads") {
  const Grid grid = sample_grid(4);
  const auto field = table_of([](const Vec3& p) { return 100.0 * p.x() * p.y() - 20.0 * p.z(); });
  const auto one = means_of(grid, field, 1);
  for (const int threads : {2, 5, 8}) {
    const auto more = means_of(grid, field, threads);
    CHECK(more.wet_fraction == one.wet_fraction);
    CHECK(more.wet_depth_m == one.wet_depth_m);
    CHECK(more.elevation_m == one.elevation_m);
  }
}

TEST_CASE("an elevation without values is refused") {
  const Grid grid = sample_grid(1);
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  Raster raster;
  raster.source = "empty.nc:z";
  raster.lat_deg = {-90.0, 0.0, 90.0};
  raster.lon_deg = {0.0, 120.0, 240.0};
  raster.values.assign(9, std::numeric_limits<double>::quiet_NaN());
  testing::expect_error(ErrorKind::input, {"empty.nc:z", "no valid value"},
                        [&] { domain::mean_over_cells(context, grid, raster); });
}
