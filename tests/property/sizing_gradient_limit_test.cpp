// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/gradient_limit.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/hash.hpp"
#include "sizing/nodes.hpp"
#include "sizing/raster.hpp"
#include "support/expect_error.hpp"

using namespace delos;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);
const Ellipsoid kTriaxial(Vec3(7645464.0, 6371220.0, 5096976.0), Vec3(0, 0, 0));

LatLonField random_field(std::uint64_t seed, double step_deg, double low_m, double high_m) {
  LatLonField field = make_table(step_deg * kRadPerDeg);
  for (std::size_t k = 0; k < field.values.size(); ++k) {
    // Mostly high, seldom low: cones of many sizes that meet.
    const double u = uniform01(seed, k);
    field.values[k] = low_m + (high_m - low_m) * (1.0 - u * u * u * u * u * u * u * u);
  }
  return field;
}

LatLonField limited(const Ellipsoid& surface, LatLonField field, double slope, int n_threads) {
  parallel::Executor exec(n_threads);
  Monitor monitor;
  Context context{exec, monitor};
  limit_gradient(context, surface, LatitudeKind::geodetic, slope, field);
  return field;
}

/// Largest |h(a) - h(b)| / |a - b| over neighbours along rows and columns, by chords.
double steepest(const Ellipsoid& surface, const LatLonField& field) {
  double worst = 0.0;
  const auto position = [&](Index row, Index column) {
    return Vec3(surface.scale_m() *
                surface.point({field.lon_rad(column), field.lat_rad(row)}, LatitudeKind::geodetic));
  };
  const auto ratio = [&](Index j0, Index i0, Index j1, Index i1) {
    const double rise = std::abs(field.values[field.at(j0, i0)] - field.values[field.at(j1, i1)]);
    const double run = (position(j0, i0) - position(j1, i1)).norm();
    if (run > 1.0) worst = std::max(worst, rise / run);
  };
  for (Index row = 0; row + 1 < field.n_rows(); ++row) {
    for (Index i = 0; i < field.n_lon; ++i) {
      if (row > 0) ratio(row, i, row, (i + 1) % field.n_lon);
      ratio(row, i, row + 1, i);
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("limiting never raises a value and bounds the slope between neighbours") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    CAPTURE(seed);
    const LatLonField before = random_field(seed, 1.0, 10e3, 240e3);
    for (const Ellipsoid& surface : {kEarth, Ellipsoid::wgs84(), kTriaxial}) {
      const LatLonField after = limited(surface, before, 0.15, 2);
      for (std::size_t k = 360; k + 360 < after.values.size(); ++k) {
        REQUIRE(after.values[k] <= before.values[k]);
      }
      // The steps are measured at a node, the chords between two: they differ by the change of
      // the metric over a cell, largest in the first rings round the poles.
      CHECK(steepest(surface, after) < 0.15 * 1.05);
    }
  }
}

TEST_CASE("limiting twice changes nothing") {
  for (const Ellipsoid& surface : {kEarth, kTriaxial}) {
    const LatLonField once = limited(surface, random_field(5, 1.0, 10e3, 240e3), 0.1, 2);
    CHECK(limited(surface, once, 0.1, 2).values == once.values);
  }
}

TEST_CASE("limiting gives the same bits for any number of threads") {
  for (const Ellipsoid& surface : {kEarth, kTriaxial}) {
    const LatLonField before = random_field(9, 0.5, 5e3, 400e3);
    const LatLonField one = limited(surface, before, 0.1, 1);
    for (const int n_threads : {2, 5, 8}) {
      CAPTURE(n_threads);
      CHECK(limited(surface, before, 0.1, n_threads).values == one.values);
    }
  }
}

TEST_CASE("a single low node makes a cone, over the poles and the date line") {
  const double slope = 0.1;
  for (const double lat : {0.0, -45.0, 80.0, 89.0, 90.0}) {
    LatLonField field = make_table(0.5 * kRadPerDeg);
    for (double& value : field.values) value = 1e7;
    const auto row = static_cast<Index>(std::lround((lat + 90.0) * 2.0));
    const Index column = field.n_lon - 3;
    field.values[field.at(row, column)] = 10e3;
    const NodeDirections nodes(field);
    const Vec3 source = nodes.direction(row, column);
    const LatLonField cone = limited(kEarth, field, slope, 2);
    double low = 1e9, high = -1e9;
    for (Index j = 0; j < cone.n_rows(); ++j) {
      for (Index i = 0; i < cone.n_lon; ++i) {
        const double d =
            kEarth.scale_m() * angle_of_chord2((nodes.direction(j, i) - source).squaredNorm());
        if (d < 1e6) continue;  // within 18 cells the scheme still shows the table's axes
        const double error = (cone.values[cone.at(j, i)] - 10e3) / (slope * d) - 1.0;
        low = std::min(low, error);
        high = std::max(high, error);
      }
    }
    CAPTURE(lat);
    CHECK(low > -0.005);
    CHECK(high < 0.05);
  }
}

TEST_CASE("a field within the bound is left as it is, bit for bit") {
  LatLonField field = make_table(1.0 * kRadPerDeg);
  for (Index row = 0; row < field.n_rows(); ++row) {
    for (Index i = 0; i < field.n_lon; ++i) {
      field.values[field.at(row, i)] = 60e3 + 0.05 * 6371220.0 * std::sin(field.lat_rad(row));
    }
  }
  for (double& value : field.values) value += 400e3;
  CHECK(limited(kEarth, field, 0.1, 2).values == field.values);
}

TEST_CASE("a gradient limit that is not positive is refused") {
  LatLonField field = random_field(1, 5.0, 1e3, 2e3);
  testing::expect_error(ErrorKind::config, {"gradient limit is -0.1", "> 0"},
                        [&] { limited(kEarth, field, -0.1, 1); });
}
