// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/conformal.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>

#include "core/hash.hpp"
#include "support/expect_error.hpp"

using delos::Ellipsoid;
using delos::ErrorKind;
using delos::LatitudeKind;
using delos::SphereMap;
using delos::SphereMapKind;
using delos::Vec3;

namespace {

constexpr std::uint64_t kSeed = 20260131;

Ellipsoid body(double a, double b, double c) { return {Vec3(a, b, c), Vec3(0, 0, 0)}; }

Vec3 random_vector(std::uint64_t id, std::uint64_t first_round) {
  Vec3 v;
  for (int axis = 0; axis < 3; ++axis) {
    v[axis] = 2.0 * delos::uniform01(kSeed, id, first_round + static_cast<unsigned>(axis)) - 1.0;
  }
  return v;
}

/// Spread over the surface; one in four each near a symmetry plane.
Vec3 random_point(const Ellipsoid& surface, std::uint64_t id) {
  Vec3 v = random_vector(id, 0);
  if (id % 4 < 3) v[static_cast<int>(id % 4)] *= 1e-6;
  return surface.project(v);
}

double angle_at(const Vec3& p, const Vec3& q, const Vec3& r) {
  const Vec3 u = q - p, v = r - p;
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// Largest change of a corner of triangles of about `size` that are not thin.
double worst_angle_change(const Ellipsoid& surface, const SphereMap& map, double size) {
  double worst = 0.0;
  for (std::uint64_t id = 0; id < 4000; ++id) {
    const Vec3 p = random_point(surface, id);
    const Vec3 q = surface.project(p + size * random_vector(id, 3));
    const Vec3 r = surface.project(p + size * random_vector(id, 6));
    const double shortest = std::min({(q - p).norm(), (r - p).norm(), (q - r).norm()});
    if (shortest < 0.3 * size) continue;
    worst = std::max(worst, std::abs(angle_at(p, q, r) - angle_at(map(p), map(q), map(r))));
  }
  return worst;
}

/// The umbilics of a body with sorted radii a > b > c (one in the first octant).
Vec3 umbilic(double a, double b, double c) {
  return {a * std::sqrt((a * a - b * b) / (a * a - c * c)), 0.0,
          c * std::sqrt((b * b - c * c) / (a * a - c * c))};
}

}  // namespace

TEST_CASE("the conformal map keeps angles to the order of the size of the triangle") {
  for (const Vec3& radii : {Vec3(1.2, 1.0, 0.8), Vec3(1.0, 0.7, 0.4), Vec3(0.5, 1.3, 0.9),
                            Vec3(1.0, 1.0, 0.8), Vec3(0.8, 1.0, 1.0), Vec3(1.0, 1.0, 1.25)}) {
    CAPTURE(radii.transpose());
    const Ellipsoid surface(radii, Vec3(0, 0, 0));
    const SphereMap map(surface, SphereMapKind::conformal);
    const double coarse = worst_angle_change(surface, map, 1e-2);
    const double fine = worst_angle_change(surface, map, 1e-4);
    CHECK(coarse < 6e-2);
    CHECK(fine < 2e-2 * coarse);
  }
}

TEST_CASE("the image has length 1 and octants, axes and planes stay where they are") {
  const Ellipsoid surface = body(1.2, 1.0, 0.8);
  const SphereMap map(surface);
  CHECK(map.kind() == SphereMapKind::conformal);
  for (std::uint64_t id = 0; id < 1000; ++id) {
    const Vec3 p = random_point(surface, id);
    const Vec3 image = map(p);
    CHECK(std::abs(image.norm() - 1.0) < 1e-15);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 mirrored = p;
      mirrored[axis] = -p[axis];
      Vec3 expected = image;
      expected[axis] = -image[axis];
      CHECK(map(mirrored) == expected);
      Vec3 flat = p;
      flat[axis] = 0.0;
      CHECK(map(surface.project(flat))[axis] == 0.0);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 end = Vec3::Unit(axis) * surface.radii()[axis];
    CHECK((map(end) - Vec3::Unit(axis)).norm() < 1e-15);
  }
}

TEST_CASE("the triaxial map is smooth across the umbilics") {
  const double a = 1.2, b = 1.0, c = 0.8;
  const Ellipsoid surface = body(a, b, c);
  const SphereMap map(surface);
  const Vec3 centre = umbilic(a, b, c) / a;
  REQUIRE((surface.project(centre) - centre).norm() < 1e-15);
  const Vec3 normal = surface.normal(centre);
  const Vec3 east = normal.cross(Vec3::UnitY()).normalized(), north = normal.cross(east);
  for (const double size : {1e-2, 1e-3, 1e-5}) {
    CAPTURE(size);
    const auto image = [&](double x, double y) -> Vec3 {
      return map(surface.project(centre + size * (x * east + y * north)));
    };
    // Second differences of a smooth map fall with the square of the step.
    CHECK((image(1, 0) + image(-1, 0) - 2.0 * image(0, 0)).norm() < 4.0 * size * size + 1e-15);
    CHECK((image(0, 1) + image(0, -1) - 2.0 * image(0, 0)).norm() < 4.0 * size * size + 1e-15);
    const double right_angle = angle_at(image(0, 0), image(1, 0), image(0, 1));
    CHECK(std::abs(right_angle - 0.5 * delos::kPi) < 2.0 * size);
  }
}

TEST_CASE("the map is one to one: no small triangle turns over and the images cover the sphere") {
  const Ellipsoid surface = body(1.0, 0.7, 0.4);
  const SphereMap map(surface);
  const int n_lon = 120, n_lat = 60;
  const auto image = [&](int i, int j) {
    const double lon = 2.0 * delos::kPi * i / n_lon, lat = delos::kPi * (j + 0.5) / n_lat;
    return map(surface.project(
        Vec3(std::sin(lat) * std::cos(lon), std::sin(lat) * std::sin(lon), std::cos(lat))));
  };
  const Ellipsoid sphere;
  double area = 0.0, smallest = 1.0;
  const auto count = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
    const double part = sphere.triangle_area(p, q, r);
    smallest = std::min(smallest, part);
    area += part;
  };
  for (int i = 0; i < n_lon; ++i) {
    for (int j = 0; j + 1 < n_lat; ++j) {
      count(image(i, j), image(i, j + 1), image(i + 1, j + 1));
      count(image(i, j), image(i + 1, j + 1), image(i + 1, j));
    }
    count(Vec3(0, 0, 1), image(i, 0), image(i + 1, 0));
    count(Vec3(0, 0, -1), image(i + 1, n_lat - 1), image(i, n_lat - 1));
  }
  CHECK(smallest > 0.0);
  CHECK(area == doctest::Approx(4.0 * delos::kPi).epsilon(1e-12));
}

TEST_CASE("a nearly round equator gives the conformal latitude of the spheroid") {
  const Ellipsoid spheroid = body(1.0, 1.0, 0.8), nearly = body(1.0, 1.0 - 1e-9, 0.8);
  const SphereMap exact(spheroid, SphereMapKind::conformal), general(nearly);
  const double e = 0.6;  // sqrt(1 - 0.8^2)
  for (std::uint64_t id = 0; id < 1000; ++id) {
    const Vec3 p = random_point(spheroid, id);
    const Vec3 image = exact(p);
    CHECK((general(nearly.project(p)) - image).norm() < 1e-8);
    // Snyder 1987, Eq. 3-1, where it is well conditioned
    const double s = spheroid.normal(p)[2];
    if (std::abs(s) > 0.999) continue;
    const double isometric = std::atanh(s) - e * std::atanh(e * s);
    CHECK(image[2] == doctest::Approx(std::tanh(isometric)).epsilon(1e-12));
    CHECK(std::atan2(image[1], image[0]) == doctest::Approx(std::atan2(p[1], p[0])).epsilon(1e-14));
  }
}

TEST_CASE("on the Earth longitude and geodetic latitude stay what they are") {
  const Ellipsoid earth = Ellipsoid::wgs84();
  const SphereMap map(earth);
  CHECK(map.kind() == SphereMapKind::lon_lat);
  const Ellipsoid sphere = map.sphere();
  CHECK(sphere.is_sphere());
  CHECK(sphere.scale_m() == doctest::Approx(6371007.181).epsilon(1e-9));  // authalic radius
  for (std::uint64_t id = 0; id < 1000; ++id) {
    const Vec3 p = random_point(earth, id);
    const auto before = earth.lon_lat(p, LatitudeKind::geodetic);
    const auto after = sphere.lon_lat(map(p), LatitudeKind::geodetic);
    CHECK(std::abs(after.lat_rad - before.lat_rad) < 1e-15);
    CHECK(std::abs(std::remainder(after.lon_rad - before.lon_rad, 2.0 * delos::kPi)) < 1e-15);
  }
  CHECK(worst_angle_change(earth, map, 1e-4) < 0.4 * delos::kRadPerDeg);
}

TEST_CASE("a sphere is mapped to itself") {
  const Ellipsoid sphere = Ellipsoid::sphere(6371220.0);
  const SphereMap map(sphere);
  CHECK(map.sphere().scale_m() == 6371220.0);
  const Vec3 p = sphere.project(Vec3(0.3, -0.5, 0.7));
  CHECK((map(p) - p).norm() < 1e-15);
  CHECK(map.stretch(p) == 1.0);
}

TEST_CASE("the stretch squared integrates to the area of the unit sphere") {
  const Ellipsoid surface = body(1.2, 1.0, 0.8);
  const SphereMap map(surface);
  const auto point = [&](double lon, double lat) {
    return surface.project(
        Vec3(std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)));
  };
  const int n = 40;
  double area = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double step = 0.5 * delos::kPi / n, lon = i * step, lat = j * step;
      const Vec3 p = point(lon, lat), q = point(lon + step, lat), r = point(lon + step, lat + step),
                 s = point(lon, lat + step);
      const double stretch = map.stretch(point(lon + 0.5 * step, lat + 0.5 * step));
      area += stretch * stretch * (surface.triangle_area(p, q, r) + surface.triangle_area(p, r, s));
    }
  }
  CHECK(8.0 * area == doctest::Approx(4.0 * delos::kPi).epsilon(1e-3));
}

TEST_CASE("many points give the same bits for any number of threads") {
  const Ellipsoid surface = body(1.2, 1.0, 0.8);
  const SphereMap map(surface);
  std::vector<Vec3> points;
  for (std::uint64_t id = 0; id < 20000; ++id) points.push_back(random_point(surface, id));
  delos::parallel::Executor one(1), four(4);
  const auto a = delos::map_to_sphere(one, map, points);
  const auto b = delos::map_to_sphere(four, map, points);
  CHECK(std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0);
  CHECK(a[17] == map(points[17]));
}

TEST_CASE("what a map can't do is refused") {
  using delos::testing::expect_error;
  expect_error(ErrorKind::config, {"no symmetry axis along z", "conformal"},
               [] { SphereMap(body(1.2, 1.0, 0.8), SphereMapKind::lon_lat); });
  expect_error(ErrorKind::config, {"too flat", "UGRID"}, [] { SphereMap(body(1.0, 0.5, 0.001)); });
}
