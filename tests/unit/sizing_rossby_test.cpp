// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/rossby.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/expect_error.hpp"

using namespace delos;

namespace {

RasterStack stack_of(const std::vector<double>& profile) {
  RasterStack stack;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    Raster level;
    level.source = "made:profile";
    level.lat_deg = {-60, -30, -1, 0, 1, 30, 60};
    level.lon_deg = {0, 120, 240};
    level.periodic = true;
    level.values.assign(21, profile[k]);
    stack.depth_m.push_back(1000.0 * static_cast<double>(k));
    stack.levels.push_back(level);
  }
  return stack;
}

}  // namespace

TEST_CASE("density and potential temperature meet the published check values") {
  CHECK(sea_water_density(40, 40, 10000) == doctest::Approx(1059.82037).epsilon(1e-8));
  CHECK(sea_water_density(0, 5, 0) == doctest::Approx(999.96675).epsilon(1e-8));
  CHECK(sea_water_density(35, 5, 10000) == doctest::Approx(1069.48914).epsilon(1e-8));
  CHECK(potential_temperature(40, 40, 10000, 0) == doctest::Approx(36.89073).epsilon(1e-7));
  CHECK(potential_temperature(35, 10, 500, 500) == doctest::Approx(10.0).epsilon(1e-14));
}

TEST_CASE("the Rossby radius falls with latitude and joins its equatorial form continuously") {
  parallel::Executor exec(2);
  const Raster radius = rossby_radius(exec, stack_of({15, 5, 3, 2}), stack_of({35, 35, 35, 35}));
  const auto row = [&](std::size_t j) { return radius.values[3 * j]; };
  CHECK(row(0) == doctest::Approx(row(6)));
  CHECK(row(5) / row(6) ==
        doctest::Approx(std::sin(60 * kRadPerDeg) / std::sin(30 * kRadPerDeg)).epsilon(1e-12));
  // Near the equator only beta counts: c = 2 beta L^2 there, c = |f| L at 30 degrees.
  const double c = row(5) * 2.0 * 7.292115e-5 * 0.5;
  CHECK(row(3) == doctest::Approx(std::sqrt(c / (2 * 2 * 7.292115e-5 / 6371220.0))));
  CHECK(row(2) == doctest::Approx(row(3)).epsilon(1e-3));
}

TEST_CASE("water of one kind has no Rossby radius, and spacing takes the floor") {
  parallel::Executor exec(1);
  RossbySource source;
  // Warm over cold turned round: unstable everywhere.
  source.temperature_degc = std::make_shared<RasterStack>(stack_of({2, 5, 15}));
  source.salinity_psu = std::make_shared<RasterStack>(stack_of({35, 35, 35}));
  source.factor = 2.0;
  source.min_radius_m = 4.0e3;
  LatLonField field = make_table(5.0 * kRadPerDeg);
  fill_rossby(exec, source, field);
  for (const double h : field.values) REQUIRE(h == doctest::Approx(8.0e3));
}

TEST_CASE("stacks that do not belong together are refused") {
  parallel::Executor exec(1);
  testing::expect_error(ErrorKind::input, {"made:profile", "differ"}, [&] {
    rossby_radius(exec, stack_of({15, 5, 3}), stack_of({35, 35}));
  });
}
