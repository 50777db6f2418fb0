// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/spacing.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/hash.hpp"
#include "sizing/raster.hpp"
#include "support/expect_error.hpp"

using namespace delos;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);

LatLonField wavy_table() {
  LatLonField field = make_table(1.0 * kRadPerDeg);
  for (Index row = 0; row < field.n_rows(); ++row) {
    for (Index i = 0; i < field.n_lon; ++i) {
      field.values[field.at(row, i)] =
          60000.0 + 20000.0 * std::cos(field.lat_rad(row)) * std::sin(2.0 * field.lon_rad(i)) +
          15000.0 * std::sin(field.lat_rad(row));
    }
  }
  return field;
}

std::vector<Vertex> random_vertices(const Ellipsoid& surface, std::uint64_t n) {
  std::vector<Vertex> vertices;
  for (std::uint64_t id = 0; id < n; ++id) {
    const Vec3 p(uniform01(7, id, 0) - 0.5, uniform01(7, id, 1) - 0.5, uniform01(7, id, 2) - 0.5);
    const Vec3 q = surface.project(p);
    vertices.push_back({q[0], q[1], q[2], 0.0});
  }
  return vertices;
}

}  // namespace

TEST_CASE("a batch of lookups has the bits of single lookups") {
  const SpacingField field = SpacingField::table(kEarth, LatitudeKind::geodetic, wavy_table());
  for (const std::uint64_t n : {1u, 7u, 8u, 255u, 256u, 257u, 5000u}) {
    std::vector<Vertex> vertices = random_vertices(kEarth, n);
    field.evaluate(vertices);
    for (const Vertex& v : vertices) REQUIRE(v.spacing == field.at(v.x, v.y, v.z));
  }
}

TEST_CASE("a lookup follows the latitude kind of the table") {
  const Ellipsoid body(Vec3(7645464.0, 6371220.0, 5096976.0), Vec3(0, 0, 0));
  for (const LatitudeKind kind :
       {LatitudeKind::geodetic, LatitudeKind::geocentric, LatitudeKind::parametric}) {
    const LatLonField table = wavy_table();
    const SpacingField field = SpacingField::table(body, kind, table);
    for (const Index row : {0, 1, 17, 90, 179, 180}) {
      for (const Index column : {0, 1, 200, 359}) {
        const Vec3 p = body.point({table.lon_rad(column), table.lat_rad(row)}, kind);
        const bool is_pole = row == 0 || row == 180;
        const double expected = table.values[table.at(row, is_pole ? 0 : column)];
        CHECK(field.at(p[0], p[1], p[2]) * body.scale_m() ==
              doctest::Approx(expected).epsilon(1e-8));
      }
    }
  }
}

TEST_CASE("the field is continuous over the date line and defined at the poles") {
  const SpacingField field = SpacingField::table(kEarth, LatitudeKind::geodetic, wavy_table());
  const double east = field.at(-1.0, 1e-12, 0.3), west = field.at(-1.0, -1e-12, 0.3);
  CHECK(east == doctest::Approx(west).epsilon(1e-9));
  CHECK(std::isfinite(field.at(0.0, 0.0, 1.0)));
  CHECK(std::isfinite(field.at(-0.0, -0.0, -1.0)));
}

TEST_CASE("a table comes back in metres, a constant as a table of one value") {
  const LatLonField table = wavy_table();
  const LatLonField back = SpacingField::table(kEarth, LatitudeKind::geodetic, table).to_table();
  REQUIRE(back.values.size() == table.values.size());
  CHECK(back.values[5000] == doctest::Approx(table.values[5000]).epsilon(1e-15));
  const SpacingField constant = SpacingField::constant(kEarth, 30000.0);
  CHECK(constant.is_constant());
  CHECK(constant.to_table().values[17] == doctest::Approx(30000.0).epsilon(1e-15));
}

TEST_CASE("unusable spacings are refused with their value and place") {
  using testing::expect_error;
  for (const double bad : {0.0, -500.0, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    expect_error(ErrorKind::config, {"spacing", "> 0"},
                 [&] { SpacingField::constant(kEarth, bad); });
    LatLonField table = wavy_table();
    table.values[table.at(100, 270)] = bad;
    expect_error(ErrorKind::input, {"lon 90", "lat 10", "> 0"},
                 [&] { SpacingField::table(kEarth, LatitudeKind::geodetic, table); });
  }
}

TEST_CASE("expected vertices of a constant are the area over two triangles a vertex") {
  parallel::Executor exec(2);
  LatLonField table = make_table(1.0 * kRadPerDeg);
  for (double& value : table.values) value = 60000.0;
  for (const Ellipsoid& body :
       {kEarth, Ellipsoid::wgs84(), Ellipsoid(Vec3(7.6e6, 6.4e6, 5.1e6), Vec3(0, 0, 0))}) {
    const double area_m2 = body.area() * body.scale_m() * body.scale_m();
    const double expected = 2.0 / std::sqrt(3.0) * area_m2 / 3.6e9;
    const SpacingField constant = SpacingField::constant(body, 60000.0);
    CHECK(expected_vertices(exec, body, constant) == doctest::Approx(expected).epsilon(1e-12));
    for (const LatitudeKind kind :
         {LatitudeKind::geodetic, LatitudeKind::geocentric, LatitudeKind::parametric}) {
      CHECK(expected_vertices(exec, body, SpacingField::table(body, kind, table)) ==
            doctest::Approx(expected).epsilon(1e-4));
    }
  }
}

TEST_CASE("expected vertices stay right where neighbouring rows differ a thousandfold") {
  parallel::Executor exec(1);
  LatLonField table = make_table(1.0 * kRadPerDeg);
  std::vector<double> of_row;
  for (Index row = 0; row < table.n_rows(); ++row) {
    of_row.push_back(uniform01(3, static_cast<std::uint64_t>(row)) < 0.5 ? 1.0e3 : 1.0e6);
    std::fill_n(table.values.data() + table.at(row, 0), table.n_lon, of_row.back());
  }
  const SpacingField field = SpacingField::table(kEarth, LatitudeKind::geodetic, table);
  // Midpoint sums over 1/20000 of a row.
  const int n = 20000;
  const double step = kPi / table.n_lat_cells / n;
  double brute = 0.0;
  for (Index row = 0; row < table.n_lat_cells; ++row) {
    const auto k = static_cast<std::size_t>(row);
    for (int part = 0; part < n; ++part) {
      const double t = (part + 0.5) / n;
      const double h = of_row[k] + t * (of_row[k + 1] - of_row[k]);
      brute += std::cos(table.lat_rad(row) + (part + 0.5) * step) / (h * h);
    }
  }
  const double radius_m = kEarth.scale_m();
  brute *= step * 2.0 * kPi * radius_m * radius_m * 2.0 / std::sqrt(3.0);
  CHECK(expected_vertices(exec, kEarth, field) == doctest::Approx(brute).epsilon(1e-3));
}
