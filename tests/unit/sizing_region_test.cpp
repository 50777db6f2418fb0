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

Region disc(double lon_deg, double lat_deg, double radius_deg) {
  return RegionDisc{{lon_deg * kRadPerDeg, lat_deg * kRadPerDeg}, radius_deg * kRadPerDeg};
}

/// 20 by 20 degrees over the date line with a hole of 4 by 4 in its middle.
Region box_over_date_line() {
  PolygonSet set;
  set.source = "box";
  set.rings = {{{170, 190, 190, 170}, {-10, -10, 10, 10}, 0},
               {{178, 182, 182, 178}, {-2, -2, 2, 2}, 0}};
  return std::make_shared<const PolygonSet>(set);
}

bool is_inside(const Region& region, double lon_deg, double lat_deg) {
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

TEST_CASE("outside a region the spacing stays for eight rings and then grows at its rate") {
  parallel::Executor exec(2);
  LatLonField field = make_table(0.25 * kRadPerDeg), distance = field;
  std::fill(field.values.begin(), field.values.end(), 50e3);
  distance_to_region(exec, disc(0, 0, 20), distance);
  coarsen_outside(exec, kEarth, distance, {}, field);
  const double metres = kEarth.scale_m() * kRadPerDeg;
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const double d = distance.values[i] * kDegPerRad * metres;
    if (d <= 8.0 * 50e3) CHECK(field.values[i] == 50e3);
    if (d > 40.0 * metres) CHECK(field.values[i] > 0.3 * (d - 8.0 * 50e3));
    CHECK(field.values[i] <= 0.4 * kEarth.scale_m());
  }
}

TEST_CASE("regions that make no sense are refused") {
  parallel::Executor exec(1);
  const LonLat place{0.0, 0.0};
  expect_error(ErrorKind::config, {"radius is 0 deg"}, [&] {
    inside_region(exec, disc(0, 0, 0), {&place, 1});
  });
  expect_error(ErrorKind::input, {"holds no polygon"}, [&] {
    inside_region(exec, Region(std::shared_ptr<const PolygonSet>()), {&place, 1});
  });
}
