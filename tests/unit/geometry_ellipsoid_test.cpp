// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/ellipsoid.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/hash.hpp"

using namespace delos;

namespace {

Vec3 random_direction(std::uint64_t seed, std::uint64_t id) {
  for (std::uint64_t round = 0;; ++round) {
    const Vec3 p(2 * uniform01(seed, id, 3 * round) - 1, 2 * uniform01(seed, id, 3 * round + 1) - 1,
                 2 * uniform01(seed, id, 3 * round + 2) - 1);
    if (p.squaredNorm() < 1 && p.squaredNorm() > 0.01) return p.normalized();
  }
}

const Ellipsoid kUnit;
const Ellipsoid kWgs84 = Ellipsoid::wgs84();
const Ellipsoid kTriaxial({7645.464e3, 6371.22e3, 5096.976e3}, {0, 0, 0});

/// The octahedron's faces split n times, on the surface.
std::vector<std::array<Vec3, 3>> octahedral_triangles(const Ellipsoid& surface, int n) {
  std::vector<std::array<Vec3, 3>> faces;
  for (const double x : {1.0, -1.0}) {
    for (const double y : {1.0, -1.0}) {
      for (const double z : {1.0, -1.0}) {
        const Vec3 a = surface.project(Vec3(x, 0, 0));
        const Vec3 b = surface.project(Vec3(0, y, 0));
        const Vec3 c = surface.project(Vec3(0, 0, z));
        if (x * y * z > 0) {
          faces.push_back({a, b, c});
        } else {
          faces.push_back({a, c, b});
        }
      }
    }
  }
  for (int level = 0; level < n; ++level) {
    std::vector<std::array<Vec3, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const Vec3 ab = surface.project(a + b);
      const Vec3 bc = surface.project(b + c);
      const Vec3 ca = surface.project(c + a);
      finer.push_back({a, ab, ca});
      finer.push_back({b, bc, ab});
      finer.push_back({c, ca, bc});
      finer.push_back({ab, bc, ca});
    }
    faces = std::move(finer);
  }
  return faces;
}

double relative(double got, double want) { return std::abs(got - want) / std::abs(want); }

}  // namespace

TEST_CASE("an ellipsoid scales its radii and refuses impossible ones") {
  CHECK(kUnit.is_sphere());
  CHECK(Ellipsoid::sphere(6371e3).is_sphere());
  CHECK_FALSE(kWgs84.is_sphere());
  CHECK(kTriaxial.radii().maxCoeff() == 1);
  CHECK(kTriaxial.scale_m() == 7645.464e3);
  CHECK(Ellipsoid({2, 1, 1}, {5, 6, 7}).to_metres({1, 0, 0}) == Vec3(7, 6, 7));
  CHECK_THROWS_AS(Ellipsoid({1, 0, 1}, {0, 0, 0}), Error);
  CHECK_THROWS_AS(Ellipsoid({1, -2, 1}, {0, 0, 0}), Error);
  CHECK_THROWS_AS(Ellipsoid({1, std::nan(""), 1}, {0, 0, 0}), Error);
  CHECK_THROWS_AS(Ellipsoid({1, 1, 1}, {0, 0, std::nan("")}), Error);
}

TEST_CASE("longitude and latitude of all three kinds return to the point they came from") {
  for (const Ellipsoid* surface : {&kUnit, &kWgs84, &kTriaxial}) {
    for (const auto kind :
         {LatitudeKind::geodetic, LatitudeKind::geocentric, LatitudeKind::parametric}) {
      for (std::uint64_t i = 0; i < 300; ++i) {
        const Vec3 p = surface->project(random_direction(5, i));
        const LonLat at = surface->lon_lat(p, kind);
        REQUIRE((surface->point(at, kind) - p).norm() < 1e-15);
      }
    }
  }
}

TEST_CASE("latitude kinds mean what they say") {
  const LonLat at{0.7, 0.6};
  const Vec3 geodetic = kWgs84.point(at, LatitudeKind::geodetic);
  CHECK(std::asin(kWgs84.normal(geodetic).z()) == doctest::Approx(0.6).epsilon(1e-14));
  const Vec3 geocentric = kWgs84.point(at, LatitudeKind::geocentric);
  CHECK(std::asin(geocentric.normalized().z()) == doctest::Approx(0.6).epsilon(1e-14));
  const Vec3 parametric = kTriaxial.point(at, LatitudeKind::parametric);
  CHECK(parametric.z() == doctest::Approx(kTriaxial.radii().z() * std::sin(0.6)).epsilon(1e-14));
  // tan(geocentric) = (1 - e^2) tan(geodetic) on a spheroid.
  const double flat = kWgs84.radii().z() * kWgs84.radii().z();
  CHECK(std::tan(kWgs84.lon_lat(geodetic, LatitudeKind::geocentric).lat_rad) ==
        doctest::Approx(flat * std::tan(0.6)).epsilon(1e-14));
}

TEST_CASE("longitudes and latitudes of many points have the bits of one at a time") {
  std::vector<Vec3> points = {{1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {-1, 0, 0}, {-1, -0.0, 0}};
  for (std::uint64_t i = 0; i < 400; ++i) points.push_back(random_direction(15, i));
  std::vector<LonLat> places(points.size());
  for (const LatitudeKind kind :
       {LatitudeKind::geodetic, LatitudeKind::geocentric, LatitudeKind::parametric}) {
    for (Vec3& point : points) point = kTriaxial.project(point);
    kTriaxial.lon_lat(points, kind, places);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const LonLat one = kTriaxial.lon_lat(points[i], kind);
      REQUIRE(one.lon_rad == places[i].lon_rad);
      REQUIRE(one.lat_rad == places[i].lat_rad);
    }
  }
}

TEST_CASE("poles and date line have their longitudes and latitudes") {
  CHECK(kUnit.lon_lat({0, 0, 1}, LatitudeKind::geodetic).lat_rad == kPi / 2);
  CHECK(kUnit.lon_lat({0, 0, -1}, LatitudeKind::geodetic).lat_rad == -kPi / 2);
  CHECK(kUnit.lon_lat({-1, 0, 0}, LatitudeKind::geodetic).lon_rad == kPi);
  CHECK(kUnit.lon_lat({-1, -0.0, 0}, LatitudeKind::geodetic).lon_rad == kPi);
  CHECK(kUnit.lon_lat({0, -1, 0}, LatitudeKind::geodetic).lon_rad == -kPi / 2);
}

TEST_CASE("the ball centre is on the surface, on its side, and as far from all three corners") {
  for (const Ellipsoid* surface : {&kUnit, &kWgs84, &kTriaxial}) {
    for (std::uint64_t i = 0; i < 300; ++i) {
      const double size = i % 2 == 0 ? 0.3 : 1e-3;
      const Vec3 p = random_direction(11, i);
      const Vec3 a = surface->project(p + size * random_direction(12, i));
      Vec3 b = surface->project(p + size * random_direction(13, i));
      Vec3 c = surface->project(p + size * random_direction(14, i));
      if (a.dot((b - a).cross(c - a)) < 0) std::swap(b, c);
      if ((b - a).cross(c - a).norm() < 0.1 * size * size) continue;
      const Vec3 centre = surface->ball_centre(a, b, c);
      REQUIRE(std::abs(centre.cwiseProduct(surface->inverse_square()).dot(centre) - 1) < 1e-15);
      REQUIRE(centre.dot((b - a).cross(c - a)) > 0);
      REQUIRE(std::abs((centre - a).norm() - (centre - b).norm()) < 4e-15 / size);
      REQUIRE(std::abs((centre - a).norm() - (centre - c).norm()) < 4e-15 / size);
    }
  }
}

TEST_CASE("arcs of the sphere are great circles from a nanometre to the antipode") {
  for (const double angle : {1e-15, 1e-9, 1e-3, 0.2, 1.0, 1.5, 3.0, 3.14159}) {
    const Vec3 b(std::cos(angle), std::sin(angle), 0);
    CHECK(relative(kUnit.arc_length({1, 0, 0}, b), angle) < (angle > 3 ? 1e-14 : 1e-15));
  }
  CHECK(kUnit.arc_length({1, 0, 0}, {-1, 0, 0}) == kPi);
}

TEST_CASE("arcs of the ellipsoid add up and match the meridian of WGS 84") {
  // Quarter meridian of WGS 84: 10 001 965.729 m (the quadrant of the standard ellipsoid).
  const double quarter =
      kWgs84.scale_m() * kWgs84.arc_length(kWgs84.project({1, 0, 0}), kWgs84.project({0, 0, 1}));
  CHECK(std::abs(quarter - 10001965.729) < 1e-3);
  CHECK(relative(kWgs84.arc_length({1, 0, 0}, {0, 1, 0}), kPi / 2) < 1e-14);
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Vec3 a = kTriaxial.project(random_direction(21, i));
    const Vec3 b = kTriaxial.project(a + 0.1 * random_direction(22, i));
    const double whole = kTriaxial.arc_length(a, b);
    double parts = 0;
    Vec3 from = a;
    for (int k = 1; k <= 7; ++k) {
      const Vec3 to = k == 7 ? b : kTriaxial.project(a + (b - a) * (k / 7.0));
      parts += kTriaxial.arc_length(from, to);
      from = to;
    }
    REQUIRE(relative(parts, whole) < 1e-14);
  }
}

TEST_CASE("the areas of all triangles sum to the area of the surface") {
  for (const Ellipsoid* surface : {&kUnit, &kWgs84, &kTriaxial}) {
    for (const int level : {0, 2, 6}) {
      double sum = 0;
      for (const auto& [a, b, c] : octahedral_triangles(*surface, level)) {
        sum += surface->triangle_area(a, b, c);
      }
      CHECK(relative(sum, surface->area()) < 1e-13);
    }
  }
}

TEST_CASE("the area of a spheroid is the closed form and that of a sphere 4 pi") {
  CHECK(kUnit.area() == 4 * kPi);
  const auto closed = [](double r) {
    const double e = std::sqrt(1 - r * r);
    return 2 * kPi * (1 + r * r / e * std::atanh(e));
  };
  CHECK(relative(kWgs84.area(), closed(kWgs84.radii().z())) < 2e-14);  // atanh(e) / e cancels
  const Ellipsoid flat({1, 1, 0.3}, {0, 0, 0});
  CHECK(relative(flat.area(), closed(0.3)) < 2e-15);
  const Ellipsoid lying({1, 0.3, 1}, {0, 0, 0});
  CHECK(relative(lying.area(), closed(0.3)) < 2e-15);
}

TEST_CASE("a triangle's area changes sign with its orientation and keeps digits when tiny") {
  const Vec3 a(1, 0, 0);
  const double h = 1e-7;
  const Vec3 b = kUnit.project(Vec3(1, h, 0));
  const Vec3 c = kUnit.project(Vec3(1, 0, h));
  CHECK(relative(kUnit.triangle_area(a, b, c), 0.5 * h * h) < 1e-12);
  CHECK(kUnit.triangle_area(a, c, b) == -kUnit.triangle_area(a, b, c));
  CHECK(relative(kUnit.triangle_area({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), kPi / 2) < 1e-15);
}

TEST_CASE("the area of a small ellipsoidal triangle is right to its last digits") {
  for (std::uint64_t i = 0; i < 50; ++i) {
    const Vec3 a = kTriaxial.project(random_direction(31, i));
    const Vec3 b = kTriaxial.project(a + 0.02 * random_direction(32, i));
    const Vec3 c = kTriaxial.project(a + 0.02 * random_direction(33, i));
    const Vec3 ab = kTriaxial.project(a + b);
    const Vec3 bc = kTriaxial.project(b + c);
    const Vec3 ca = kTriaxial.project(c + a);
    const double whole = kTriaxial.triangle_area(a, b, c);
    const double parts = kTriaxial.triangle_area(a, ab, ca) + kTriaxial.triangle_area(b, bc, ab) +
                         kTriaxial.triangle_area(c, ca, bc) + kTriaxial.triangle_area(ab, bc, ca);
    REQUIRE(std::abs(whole - parts) < 1e-17);
  }
}

TEST_CASE("the areas of a fan are those of its triangles") {
  const Ellipsoid flat({1, 1, 0.3}, {0, 0, 0});
  for (const Ellipsoid* surface : {&kUnit, &kWgs84, &kTriaxial, &flat}) {
    for (const double size : {1e-6, 1e-3, 0.005, 0.1}) {  // the last one is not small
      for (std::uint64_t i = 0; i < 20; ++i) {
        const Vec3 centre = surface->project(random_direction(41, i));
        std::array<Vec3, 6> ring;
        for (std::size_t k = 0; k < 6; ++k) {
          ring[k] = surface->project(centre + size * random_direction(42, 6 * i + k));
        }
        const auto areas = surface->fan_areas(centre, ring);
        for (std::size_t k = 0; k < 6; ++k) {
          const double one = surface->triangle_area(centre, ring[k], ring[(k + 1) % 6]);
          REQUIRE(std::abs(areas[k] - one) <= 1e-13 * std::abs(one) + 1e-16 * size);
        }
      }
    }
  }
}

TEST_CASE("small triangles, which take a lower rule, add up to large ones") {
  for (const Ellipsoid* surface : {&kWgs84, &kTriaxial}) {
    // 4^8 and 4^3 triangles of an octahedron's face: sides of about 0.006 and 0.2.
    const auto fine = octahedral_triangles(*surface, 8);
    const auto coarse = octahedral_triangles(*surface, 3);
    const std::size_t n_parts = fine.size() / coarse.size();
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      const auto& [a, b, c] = coarse[i];
      double sum = 0;
      for (std::size_t k = 0; k < n_parts; ++k) {
        const auto& [p, q, r] = fine[i * n_parts + k];
        sum += surface->triangle_area(p, q, r);
      }
      REQUIRE(relative(sum, surface->triangle_area(a, b, c)) < 2e-14);
    }
  }
}
