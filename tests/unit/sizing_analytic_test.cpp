// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/analytic.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "sizing/nodes.hpp"
#include "support/expect_error.hpp"

using namespace delos;

namespace {

double value_at(const LatLonField& field, double lon_deg, double lat_deg) {
  const auto row = static_cast<Index>(std::lround((lat_deg + 90.0) / 180.0 * field.n_lat_cells));
  const auto column = static_cast<Index>(std::lround((lon_deg + 180.0) / 360.0 * field.n_lon));
  return field.values[field.at(row, column % field.n_lon)];
}

RegionEdge edge(double width_deg, Transition transition) {
  return {15.0e3, 150.0e3, width_deg * kRadPerDeg, transition};
}

PolygonSet square(double west, double east, double south, double north) {
  return {"square", {{{west, east, east, west}, {south, south, north, north}}}};
}

}  // namespace

TEST_CASE("a latitude profile passes through its points and stays between them") {
  parallel::Executor exec(2);
  LatLonField field = make_table(1.0 * kRadPerDeg);
  for (const bool cubic : {false, true}) {
    fill_latitude_profile(exec, {{-60, 0, 20, 60}, {30e3, 60e3, 60e3, 20e3}, cubic}, field);
    CHECK(value_at(field, 10, -80) == doctest::Approx(30e3));
    CHECK(value_at(field, 10, 0) == doctest::Approx(60e3));
    CHECK(value_at(field, -170, 10) == doctest::Approx(60e3));
    CHECK(value_at(field, 10, 60) == doctest::Approx(20e3));
    for (double lat = -60; lat < 0; lat += 1) {
      CHECK(value_at(field, 0, lat) <= value_at(field, 0, lat + 1));
    }
  }
  testing::expect_error(ErrorKind::config, {"ascend"}, [&] {
    fill_latitude_profile(exec, {{10, 0}, {1e3, 1e3}}, field);
  });
  testing::expect_error(ErrorKind::config, {"-5", "> 0"}, [&] {
    fill_latitude_profile(exec, {{0, 10}, {-5, 1e3}}, field);
  });
}

TEST_CASE("a disc is round over the pole and the date line") {
  parallel::Executor exec(2);
  LatLonField field = make_table(1.0 * kRadPerDeg);
  fill_disc(exec, {180.0, 80.0, 15.0 * kRadPerDeg, edge(10.0, Transition::linear)}, field);
  CHECK(value_at(field, 0.0, 86.0) == doctest::Approx(15e3));  // 14 degrees over the pole
  CHECK(value_at(field, 179.0, 66.0) == doctest::Approx(15e3));
  CHECK(value_at(field, -180.0, 60.0) == doctest::Approx(82.5e3));
  CHECK(value_at(field, 0.0, 80.0) == doctest::Approx(82.5e3));
  CHECK(value_at(field, 0.0, 0.0) == doctest::Approx(150e3));
}

TEST_CASE("transitions have their formulas") {
  parallel::Executor exec(1);
  LatLonField field = make_table(1.0 * kRadPerDeg);
  fill_disc(exec, {0.0, 0.0, 10.0 * kRadPerDeg, edge(8.0, Transition::smooth)}, field);
  CHECK(value_at(field, 12.0, 0.0) == doctest::Approx(15e3 + 135e3 * (3.0 / 16 - 2.0 / 64)));
  fill_disc(exec, {0.0, 0.0, 10.0 * kRadPerDeg, edge(8.0, Transition::gaussian)}, field);
  CHECK(value_at(field, 18.0, 0.0) == doctest::Approx(150e3 - 135e3 * std::exp(-0.5)));
  fill_disc(exec, {0.0, 0.0, 10.0 * kRadPerDeg, edge(0.0, Transition::smooth)}, field);
  CHECK(value_at(field, 11.0, 0.0) == doctest::Approx(150e3));
}

TEST_CASE("where a disc does not reach, nodes have what its formula gives, to the last bit") {
  parallel::Executor exec(2);
  LatLonField field = make_table(2.0 * kRadPerDeg);
  const NodeDirections nodes(field);
  const Vec3 centre = unit_vector(-40.0, 35.0);
  for (const double outside_m : {240e3, 41e3, 40e3, 10e3}) {
    for (const double width : {0.01, 0.2, 2.0}) {
      const RegionEdge gaussian{40e3, outside_m, width, Transition::gaussian};
      fill_disc(exec, {-40.0, 35.0, 0.1, gaussian}, field);
      for (Index row = 0; row < field.n_rows(); ++row) {
        for (Index i = 0; i < field.n_lon; ++i) {
          const double angle = angle_of_chord2((nodes.direction(row, i) - centre).squaredNorm());
          const double t = (angle - 0.1) / width;
          const double h = outside_m - (outside_m - 40e3) * elementary::exp(-0.5 * t * t);
          REQUIRE(field.values[field.at(row, i)] == (t <= 0.0 ? 40e3 : h));
        }
      }
    }
  }
}

TEST_CASE("a box may cross the date line and measures distance on the sphere") {
  parallel::Executor exec(2);
  LatLonField field = make_table(1.0 * kRadPerDeg);
  const BoxSource box{170.0, -160.0, -10.0, 60.0, edge(10.0, Transition::linear)};
  fill_box(exec, box, field);
  CHECK(value_at(field, -180.0, 0.0) == doctest::Approx(15e3));
  CHECK(value_at(field, -161.0, 59.0) == doctest::Approx(15e3));
  CHECK(value_at(field, 165.0, 0.0) == doctest::Approx(15e3 + 135e3 * 0.5));
  CHECK(value_at(field, -180.0, 65.0) == doctest::Approx(15e3 + 135e3 * 0.5));
  CHECK(value_at(field, 0.0, 0.0) == doctest::Approx(150e3));
  // Over the pole: from (0, 85) to the top of the box at (180, 60) it is 35 degrees.
  const BoxSource wide{170.0, -160.0, -10.0, 60.0, edge(70.0, Transition::linear)};
  fill_box(exec, wide, field);
  CHECK(value_at(field, 0.0, 85.0) == doctest::Approx(15e3 + 135e3 * 0.5).epsilon(0.01));
}

TEST_CASE("rings of a polygon follow the even-odd rule, polygons are united") {
  parallel::Executor exec(2);
  const LatLonField like = make_table(1.0 * kRadPerDeg);
  const auto inside = [&](const PolygonSet& set, double lon, double lat) {
    const std::vector<char> mask = inside_polygons(exec, set, like);
    LatLonField field = like;
    for (std::size_t k = 0; k < mask.size(); ++k) field.values[k] = mask[k];
    return value_at(field, lon, lat) != 0.0;
  };
  const PolygonSet over = square(170.5, 190.5, -10.5, 10.5);
  CHECK(inside(over, 175, 0));
  CHECK(inside(over, -175, 0));
  CHECK_FALSE(inside(over, -165, 0));
  PolygonSet holed = square(-20.5, 20.5, -20.5, 20.5);
  holed.rings.push_back(square(-5.5, 5.5, -5.5, 5.5).rings[0]);
  CHECK(inside(holed, 10, 0));
  CHECK_FALSE(inside(holed, 0, 0));
  PolygonSet overlapping = holed;
  overlapping.rings[1].polygon = 1;  // no hole but a polygon of its own
  CHECK(inside(overlapping, 10, 0));
  CHECK(inside(overlapping, 0, 0));
  const PolygonSet cap{"cap", {{{-180, -90, 0, 90, 179}, {-70, -65, -70, -65, -70}, 0}}};
  CHECK(inside(cap, 37, -90));
  CHECK(inside(cap, 179.0, -80));
  CHECK_FALSE(inside(cap, 37, -50));
}

TEST_CASE("a polygon passes into its surroundings over its width") {
  parallel::Executor exec(2);
  LatLonField field = make_table(0.5 * kRadPerDeg);
  PolygonSource source{std::make_shared<PolygonSet>(square(170, 190, -10, 10)),
                       edge(10.0, Transition::linear)};
  fill_polygon(exec, source, field);
  CHECK(value_at(field, -175, 0) == doctest::Approx(15e3));
  CHECK(value_at(field, 165, 0) == doctest::Approx(82.5e3).epsilon(0.02));
  CHECK(value_at(field, 0, 0) == doctest::Approx(150e3));
  source.polygons = std::make_shared<PolygonSet>();
  testing::expect_error(ErrorKind::input, {"no polygon"},
                        [&] { fill_polygon(exec, source, field); });
}
