// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/coastline.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <map>

using namespace delos;
using namespace delos::pictures;

namespace {

/// One-degree raster whose elevation falls with the distance (degrees) from an island's middle.
Raster island(double lon_deg, double lat_deg, double radius_deg) {
  Raster raster;
  raster.source = "island";
  raster.periodic = true;
  for (int i = 0; i < 180; ++i) raster.lat_deg.push_back(-89.5 + i);
  for (int j = 0; j < 360; ++j) raster.lon_deg.push_back(0.5 + j);
  for (const double lat : raster.lat_deg) {
    for (const double lon : raster.lon_deg) {
      const double east = std::remainder(lon - lon_deg, 360.0);
      raster.values.push_back(100.0 * (radius_deg - std::hypot(east, lat - lat_deg)));
    }
  }
  return raster;
}

}  // namespace

TEST_CASE("an island's coastline is closed and as long as it is round, over the date line too") {
  for (const double lon : {40.0, 180.0, -179.0}) {
    CAPTURE(lon);
    const LandMask mask(island(lon, 10.0, 20.0));
    CHECK(mask.is_land(lon > 179.0 ? 179.9 : lon, 10.0));
    CHECK_FALSE(mask.is_land(std::remainder(lon + 25.0, 360.0), 10.0));
    std::map<std::pair<long, long>, int> ends;
    double length_deg = 0.0;
    for (const Segment& piece : mask.coastline()) {
      length_deg += std::hypot(piece.to.x - piece.from.x, piece.to.y - piece.from.y);
      for (const Point& end : {piece.from, piece.to}) {
        const double east = std::remainder(end.x, 360.0);
        ++ends[{std::lround(std::abs(east) > 179.9999999 ? 180e6 : 1e6 * east),
                std::lround(1e6 * end.y)}];
      }
    }
    for (const auto& [where, count] : ends) CHECK(count == 2);
    CHECK(length_deg == doctest::Approx(2.0 * 3.14159265 * 20.0).epsilon(0.01));
  }
}

TEST_CASE("what a raster does not cover or marks missing is sea") {
  Raster raster = island(40.0, 10.0, 20.0);
  raster.values.assign(raster.values.size(), 500.0);
  raster.values[90 * 360 + 200] = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(LandMask(raster).is_land(-159.5, 0.5));
  CHECK(LandMask(raster).is_land(-150.0, 0.5));

  Raster regional;
  regional.lat_deg = {10.0, 20.0};
  regional.lon_deg = {350.0, 360.0, 370.0};
  regional.values.assign(6, 100.0);
  const LandMask mask(regional);
  CHECK(mask.is_land(0.0, 15.0));
  CHECK(mask.is_land(-9.0, 11.0));
  CHECK_FALSE(mask.is_land(60.0, 15.0));
  CHECK_FALSE(mask.is_land(0.0, 40.0));
}
