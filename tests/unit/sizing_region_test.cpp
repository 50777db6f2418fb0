// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/region.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/expect_error.hpp"

using namespace delos;
using testing::expect_error;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);

RegionShape disc(double lon_deg, double lat_deg, double radius_deg) {
  return RegionDisc{{lon_deg * kRadPerDeg, lat_deg * kRadPerDeg}, radius_deg * kRadPerDeg};
}

/// 20 by 20 degrees over the date line with a hole of 4 by 4 in its middle.
RegionShape box_over_date_line() {
  PolygonSet set;
  set.source = "box";
  set.rings = {{{170, 190, 190, 170}, {-10, -10, 10, 10}, 0},
               {{178, 182, 182, 178}, {-2, -2, 2, 2}, 0}};
  return std::make_shared<const PolygonSet>(set);
}

bool is_inside(const RegionShape& region, double lon_deg, double lat_deg) {
  parallel::Executor exec(1);
  const LonLat place{lon_deg * kRadPerDeg, lat_deg * kRadPerDeg};
  return inside_region(exec, region, {&place, 1})[0] != 0;
}

}  // namespace

TEST_CASE("a disc over the pole and a polygon over the date line hold what lies in them") {
  CHECK(is_inside(disc(30, 85, 10), -150, 86));
  CHECK_FALSE(is_inside(disc(30, 85, 10), -150, 84));
  CHECK(is_inside(box_over_date_line(), 175, 5));
  CHECK(is_inside(box_over_date_line(), -175, 5));
  CHECK(is_inside(box_over_date_line(), 185, 5));
  CHECK_FALSE(is_inside(box_over_date_line(), 180, 0));
  CHECK_FALSE(is_inside(box_over_date_line(), -165, 5));
  CHECK_FALSE(is_inside(box_over_date_line(), 0, 5));
}

TEST_CASE("distances are 0 in the region and angles outside") {
  parallel::Executor exec(2);
  LatLonField distance = make_table(1.0 * kRadPerDeg);
  distance_to_region(exec, disc(0, 90, 10), distance);
  for (Index row = 0; row < distance.n_rows(); ++row) {
    const double wanted = std::max(0.0, 80.0 - distance.lat_rad(row) * kDegPerRad);
    CHECK(distance.values[distance.at(row, 7)] * kDegPerRad == doctest::Approx(wanted));
  }
  distance_to_region(exec, box_over_date_line(), distance);
  const auto at = [&](Index lon, Index lat) {
    return distance.values[distance.at(lat + 90, lon + 180)] * kDegPerRad;
  };
  CHECK(at(175, 5) == 0.0);
  CHECK(at(-175, 5) == 0.0);
  CHECK(at(160, 0) == doctest::Approx(10.0).epsilon(0.01));
  CHECK(at(-160, 0) == doctest::Approx(10.0).epsilon(0.01));
}

TEST_CASE("outside a region the spacing stays for its rings and one more, then grows at its rate") {
  parallel::Executor exec(2);
  LatLonField field = make_table(0.25 * kRadPerDeg), distance = field;
  std::fill(field.values.begin(), field.values.end(), 50e3);
  distance_to_region(exec, disc(0, 0, 20), distance);
  coarsen_outside(exec, kEarth, distance, {}, field);
  const double step_m = 0.25 * kRadPerDeg * kEarth.scale_m(), kept_m = 8.0 * 50e3;
  std::int64_t n_wrong = 0;
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const double behind_m = distance.values[i] * kEarth.scale_m() - step_m - kept_m;
    const double wanted = 50e3 + std::max(0.0, 0.12 * behind_m);
    if (std::abs(field.values[i] - wanted) > 1e-9 * wanted) ++n_wrong;
  }
  CHECK(n_wrong == 0);
}

TEST_CASE("a budget of a region counts its cells and its rings alone") {
  parallel::Executor exec(2);
  LatLonField field = make_table(0.25 * kRadPerDeg), distance = field;
  std::fill(field.values.begin(), field.values.end(), 50e3);
  distance_to_region(exec, disc(20, 30, 10), distance);
  drop_outside(exec, kEarth, distance, {}, field);
  const double n = expected_vertices(
      exec, kEarth, SpacingField::table(exec, kEarth, LatitudeKind::geodetic, field));
  const double radius = 10.0 * kRadPerDeg + 6.5 * 50e3 / kEarth.scale_m();
  const double cell = 0.5 * std::sqrt(3.0) * std::pow(50e3 / kEarth.scale_m(), 2);
  CHECK(n == doctest::Approx(2.0 * kPi * (1.0 - std::cos(radius)) / cell).epsilon(0.03));
}

TEST_CASE("regions that make no sense are refused") {
  const auto polygon = [](std::vector<double> lon, std::vector<double> lat) {
    PolygonSet set;
    set.source = "outline";
    set.rings = {{std::move(lon), std::move(lat), 0}};
    return RegionShape(std::make_shared<const PolygonSet>(set));
  };
  expect_error(ErrorKind::config, {"radius is 0 deg"}, [&] { check_region(disc(0, 0, 0)); });
  expect_error(ErrorKind::config, {"below 180 deg"}, [&] { check_region(disc(0, 0, 180)); });
  expect_error(ErrorKind::input, {"holds no polygon"},
               [&] { check_region(RegionShape(std::shared_ptr<const PolygonSet>())); });
  expect_error(ErrorKind::input, {"outline", "crosses itself", "lon 5"}, [&] {
    check_region(polygon({0, 10, 0, 10}, {0, 10, 10, 0}));
  });
  check_region(polygon({0, 10, 10, 0}, {0, 0, 10, 10}));
  check_region(box_over_date_line());
  check_region(disc(0, 0, 120));                               // more than a hemisphere
  check_region(polygon({0, 90, 180, 270}, {60, 55, 60, 65}));  // round the pole
}
