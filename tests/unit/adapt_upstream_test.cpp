// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/upstream.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "adapt/cell_raster.hpp"
#include "core/types.hpp"
#include "support/expect_error.hpp"

using namespace delos;

namespace {

constexpr double kRadius_m = 6371220.0;
constexpr double kDegree_m = kRadius_m * kRadPerDeg;

/// A table of 1 degree from a function of lon and lat in degrees.
template <class Function>
Raster raster(const Function& function) {
  LatLonField table = make_table(kRadPerDeg);
  for (Index j = 0; j < table.n_rows(); ++j) {
    for (Index i = 0; i < table.n_lon; ++i) {
      table.values[table.at(j, i)] =
          function(table.lon_rad(i) * kDegPerRad, table.lat_rad(j) * kDegPerRad);
    }
  }
  return raster_of_nodes(std::move(table), "test");
}

Raster uniform(double value) {
  return raster([=](double, double) { return value; });
}

/// One node of 1 in a sea of zeros.
Raster spike(double lon_deg, double lat_deg) {
  return raster([=](double lon, double lat) {
    return std::abs(lon - lon_deg) < 0.5 && std::abs(lat - lat_deg) < 0.5 ? 1.0 : 0.0;
  });
}

double at(const Raster& raster, double lon_deg, double lat_deg) {
  const auto row = static_cast<std::size_t>(std::lround(lat_deg + 90.0));
  const auto column = static_cast<std::size_t>(std::lround(lon_deg + 180.0)) % 360;
  return raster.values[row * 360 + column];
}

Raster spread(const Raster& signal, const Raster& east, const Raster& north,
              const UpstreamOptions& options, int threads = 1) {
  parallel::Executor exec(threads);
  return spread_upstream(exec, signal, {east, north}, options, kRadius_m);
}

}  // namespace

TEST_CASE("a signal is spread against an eastward flow, and falls off with the way") {
  const Raster signal = spike(10.0, 0.0), east = uniform(0.5), north = uniform(0.0);
  const Raster found = spread(signal, east, north, {.length_m = 10.0 * kDegree_m});
  CHECK(at(found, 10.0, 0.0) == 1.0);
  for (const double way : {2.0, 5.0, 8.0}) {
    CAPTURE(way);
    // The node is met up to half a degree before it.
    CHECK(at(found, 10.0 - way, 0.0) == doctest::Approx(1.0 - 0.1 * way).epsilon(0.08));
  }
  CHECK(at(found, -1.0, 0.0) == 0.0);
  CHECK(at(found, 11.0, 0.0) == 0.0);
  CHECK(at(found, 5.0, 2.0) == 0.0);
  // By time: 10 degrees at half a metre a second.
  const Raster timed = spread(signal, east, north, {.time_s = 20.0 * kDegree_m});
  CHECK(at(timed, 5.0, 0.0) == doctest::Approx(at(found, 5.0, 0.0)));
}

TEST_CASE("paths cross the date line, follow the meridians and know the narrow columns") {
  const Raster none = uniform(0.0);
  const UpstreamOptions reach{.length_m = 10.0 * kDegree_m};
  const Raster over = spread(spike(-178.0, 0.0), uniform(1.0), none, reach);
  CHECK(at(over, 178.0, 0.0) == doctest::Approx(0.6).epsilon(0.1));
  const Raster northward = spread(spike(30.0, 20.0), none, uniform(0.2), reach);
  CHECK(at(northward, 30.0, 15.0) == doctest::Approx(0.5).epsilon(0.1));
  CHECK(at(northward, 30.0, 21.0) == 0.0);
  // At 60 degrees a degree of longitude is half as long.
  const Raster far = spread(spike(30.0, 60.0), uniform(1.0), none, reach);
  CHECK(at(far, 20.0, 60.0) == doctest::Approx(0.5).epsilon(0.1));
}

TEST_CASE("a flow that is still, missing or at a pole ends a path") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const UpstreamOptions reach{.length_m = 10.0 * kDegree_m};
  const Raster signal = spike(10.0, 0.0), north = uniform(0.0);
  const Raster still = spread(signal, uniform(1e-4), north, reach);
  CHECK(at(still, 9.0, 0.0) == 0.0);
  const Raster walled =
      spread(signal, raster([=](double lon, double) { return lon > 5.5 && lon < 7.5 ? nan : 1.0; }),
             north, reach);
  CHECK(at(walled, 9.0, 0.0) > 0.8);
  CHECK(at(walled, 4.0, 0.0) == 0.0);
  // A missing signal stays so, and hides nothing that lies behind it.
  const Raster gap = raster([=](double lon, double lat) {
    return lat == 0.0 && lon == 8.0 ? nan : std::abs(lon - 10.0) < 0.5 ? 1.0 : 0.0;
  });
  const Raster seen = spread(gap, uniform(1.0), north, reach);
  CHECK(at(seen, 6.0, 0.0) == doctest::Approx(0.6).epsilon(0.1));
  const Raster polar = spread(spike(0.0, 89.0), uniform(1.0), uniform(1.0), reach);
  for (const double value : polar.values) CHECK_FALSE(value > 1.0);
}

TEST_CASE("any number of threads spreads upstream to the same bits, without a reach none does") {
  const auto wave = [](double lon, double lat) {
    return std::sin(0.1 * lon) * std::cos(0.05 * lat);
  };
  const Raster signal = raster([&](double lon, double lat) { return std::abs(wave(lat, lon)); });
  const Raster east = raster(wave),
               north = raster([&](double lon, double lat) { return 0.3 * wave(2.0 * lat, lon); });
  const UpstreamOptions reach{.time_s = 30.0 * 86400.0};
  const Raster expected = spread(signal, east, north, reach);
  for (const int threads : {2, 5, 8}) {
    CHECK(spread(signal, east, north, reach, threads).values == expected.values);
  }
  testing::expect_error(ErrorKind::config, {"upstream", "> 0"},
                        [&] { spread(signal, east, north, {}); });
}
