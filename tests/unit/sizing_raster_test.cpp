// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/raster.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "support/expect_error.hpp"

using namespace delos;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Cell-centred or node-centred raster of f(lon, lat) in degrees.
Raster raster_of(double lat0, double lon0, double step, std::size_t n_lat, std::size_t n_lon,
                 bool periodic, const std::function<double(double, double)>& f) {
  Raster raster;
  raster.source = "made:f";
  raster.periodic = periodic;
  for (std::size_t j = 0; j < n_lat; ++j) raster.lat_deg.push_back(lat0 + step * double(j));
  for (std::size_t i = 0; i < n_lon; ++i) raster.lon_deg.push_back(lon0 + step * double(i));
  for (const double lat : raster.lat_deg) {
    for (const double lon : raster.lon_deg) raster.values.push_back(f(lon, lat));
  }
  return raster;
}

double smooth_function(double lon, double lat) {
  return 100.0 + 10.0 * std::cos(lat * kRadPerDeg) * std::sin(lon * kRadPerDeg) + 0.1 * lat;
}

}  // namespace

TEST_CASE("a raster is interpolated across its seam and to both poles") {
  parallel::Executor exec(2);
  LatLonField field = make_table(0.5 * kRadPerDeg);
  // Cell centres from 20.5 to 379.5 east, as climatologies have them.
  sample(exec, raster_of(-89.5, 20.5, 1.0, 180, 360, true, smooth_function), field);
  for (Index row = 0; row < field.n_rows(); ++row) {
    for (Index i = 0; i < field.n_lon; ++i) {
      const double lon = field.lon_rad(i) * kDegPerRad, lat = field.lat_rad(row) * kDegPerRad;
      REQUIRE(field.values[field.at(row, i)] ==
              doctest::Approx(smooth_function(lon, lat)).epsilon(2e-3));
    }
  }
}

TEST_CASE("a raster finer than the table is averaged") {
  parallel::Executor exec(2);
  LatLonField field = make_table(1.0 * kRadPerDeg);
  const Raster fine = raster_of(-89.95, -179.95, 0.1, 1800, 3600, true, [](double lon, double) {
    return std::floor(lon * 10.0 + 0.25) / 2.0 == std::floor(std::floor(lon * 10.0 + 0.25) / 2.0)
               ? 0.0
               : 2.0;
  });
  sample(exec, fine, field);
  for (const double value : field.values) REQUIRE(value == doctest::Approx(1.0).epsilon(1e-9));
}

TEST_CASE("missing values stay missing where they prevail, and beyond a regional raster") {
  parallel::Executor exec(1);
  LatLonField field = make_table(1.0 * kRadPerDeg);
  sample(exec,
         raster_of(-30.0, 10.0, 1.0, 61, 81, false,
                   [](double lon, double) { return lon < 40.0 ? kNan : lon; }),
         field);
  CHECK(std::isnan(field.values[field.at(90, 180 + 20)]));
  CHECK(field.values[field.at(90, 180 + 60)] == doctest::Approx(60.0));
  CHECK(std::isnan(field.values[field.at(90, 180 + 100)]));
  CHECK(std::isnan(field.values[field.at(150, 180 + 60)]));
  fill_nearest(exec, "made:f", field);
  CHECK(field.values[field.at(90, 180 + 20)] == doctest::Approx(40.0));
  CHECK(field.values[field.at(90, 180 + 100)] == doctest::Approx(90.0));
}

TEST_CASE("a raster without a valid value is refused by name") {
  parallel::Executor exec(1);
  LatLonField field = make_table(1.0 * kRadPerDeg);
  testing::expect_error(ErrorKind::input, {"made:f", "no valid value"}, [&] {
    sample(exec, raster_of(-89.5, 0.5, 1.0, 180, 360, true, [](double, double) { return kNan; }),
           field);
  });
  testing::expect_error(ErrorKind::resource, {"2^31", "coarser"}, [] { make_table(1e-6); });
}

TEST_CASE("smoothing a spike gives a Gaussian of the asked width, at the pole as at the equator") {
  parallel::Executor exec(2);
  const double sigma = 5.0 * kRadPerDeg;
  for (const Index peak : {Index{180}, Index{340}, Index{360}}) {
    LatLonField field = make_table(0.5 * kRadPerDeg);
    const double peak_lat = field.lat_rad(peak);
    for (Index i = 0; i < (peak == 360 ? field.n_lon : 1); ++i) {
      field.values[field.at(peak, i)] = 1.0;
    }
    smooth(exec, sigma, field);
    double mass = 0.0, moment = 0.0;
    for (Index row = 0; row < field.n_rows(); ++row) {
      const double lat = field.lat_rad(row);
      for (Index i = 0; i < field.n_lon; ++i) {
        const double weight = std::cos(lat) * field.values[field.at(row, i)];
        const double cosine =
            std::sin(lat) * std::sin(peak_lat) +
            std::cos(lat) * std::cos(peak_lat) * std::cos(field.lon_rad(i) - field.lon_rad(0));
        mass += weight;
        moment += weight * (2.0 - 2.0 * cosine);
      }
    }
    CAPTURE(peak);
    CHECK(moment / mass == doctest::Approx(2.0 * sigma * sigma).epsilon(0.05));
  }
}

TEST_CASE("smoothing keeps constants, bounds, the mean and missing values") {
  parallel::Executor exec(2);
  LatLonField field = make_table(1.0 * kRadPerDeg);
  for (std::size_t k = 0; k < field.values.size(); ++k) field.values[k] = k % 3 == 0 ? 4.0 : 1.0;
  for (Index row = 60; row < 90; ++row) {
    for (Index i = 20; i < 50; ++i) field.values[field.at(row, i)] = kNan;
  }
  smooth(exec, 3.0 * kRadPerDeg, field);
  for (Index row = 0; row < field.n_rows(); ++row) {
    for (Index i = 0; i < field.n_lon; ++i) {
      const double value = field.values[field.at(row, i)];
      const bool is_hole = row >= 60 && row < 90 && i >= 20 && i < 50;
      REQUIRE(std::isnan(value) == is_hole);
      if (!is_hole) REQUIRE((value >= 1.0 - 1e-9 && value <= 4.0 + 1e-9));
    }
  }
  LatLonField flat = make_table(1.0 * kRadPerDeg);
  for (double& value : flat.values) value = 7.0;
  smooth(exec, 3.0 * kRadPerDeg, flat);
  for (const double value : flat.values) REQUIRE(value == doctest::Approx(7.0).epsilon(1e-9));
}
