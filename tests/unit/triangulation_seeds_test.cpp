// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/seeds.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "triangulation/delaunay.hpp"
#include "triangulation/validate.hpp"

using namespace delos;

namespace {

/// Number of vertices of each degree.
std::array<int, 12> degrees(const Mesh& mesh) {
  std::vector<int> degree(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const Index v : t.vertex) ++degree[static_cast<std::size_t>(v)];
  }
  std::array<int, 12> counts{};
  for (const int d : degree) ++counts[static_cast<std::size_t>(std::min(d, 11))];
  return counts;
}

}  // namespace

TEST_CASE("the icosahedral grid has 10 n^2 + 2 points, twelve of degree 5 and the rest of 6") {
  parallel::Executor exec(1);
  for (const std::int64_t n : {1, 2, 3, 4, 6, 7, 8, 12, 32}) {
    CAPTURE(n);
    const std::vector<Vec3> points = icosahedral_points(n);
    CHECK(points.size() == static_cast<std::size_t>(10 * n * n + 2));
    CHECK(points[0] == Vec3(0, 0, 1));
    CHECK(points[11] == Vec3(0, 0, -1));
    const Mesh mesh = delaunay(exec, points);
    CHECK(summary(validate(mesh, Ellipsoid())) == "");
    const auto counts = degrees(mesh);
    CHECK(counts[5] == 12);
    CHECK(counts[6] == static_cast<int>(points.size()) - 12);
  }
}

TEST_CASE("the points of a bisected icosahedron hold those of the coarser one") {
  const std::vector<Vec3> coarse = icosahedral_points(4);
  const std::vector<Vec3> fine = icosahedral_points(8);
  for (const Vec3& p : coarse) {
    const bool found = std::any_of(fine.begin(), fine.end(), [&](const Vec3& q) { return p == q; });
    REQUIRE(found);
  }
}

TEST_CASE("the cubed sphere has 6 n^2 + 2 points, symmetric to the last bit") {
  parallel::Executor exec(1);
  for (const std::int64_t n : {1, 2, 3, 8, 15}) {
    CAPTURE(n);
    const std::vector<Vec3> points = cubed_sphere_points(n);
    CHECK(points.size() == static_cast<std::size_t>(6 * n * n + 2));
    for (const Vec3& p : points) {
      const Vec3 mirrored(-p.x(), p.z(), p.y());
      REQUIRE(std::any_of(points.begin(), points.end(),
                          [&](const Vec3& q) { return (q - mirrored).norm() < 1e-15; }));
    }
    CHECK(summary(validate(delaunay(exec, points), Ellipsoid())) == "");
  }
}

TEST_CASE("spiral points are evenly spread") {
  parallel::Executor exec(1);
  const std::size_t n = 10000;
  const Mesh mesh = delaunay(exec, fibonacci_points(static_cast<std::int64_t>(n)));
  double shortest = std::numeric_limits<double>::max();
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      shortest = std::min(
          shortest, (mesh.position(t.vertex[k]) - mesh.position(t.vertex[(k + 1) % 3])).norm());
    }
  }
  CHECK(shortest > 0.8 * std::sqrt(4 * kPi / static_cast<double>(n)));
}

TEST_CASE("seeds come projected onto the ellipsoid and refuse impossible counts") {
  const Ellipsoid surface({7645.464e3, 6371.22e3, 5096.976e3}, {0, 0, 0});
  for (const auto& points : {icosahedral_points(5, surface), cubed_sphere_points(5, surface),
                             fibonacci_points(50, surface)}) {
    for (const Vec3& p : points) {
      REQUIRE(std::abs(p.cwiseProduct(surface.inverse_square()).dot(p) - 1) < 1e-15);
    }
  }
  CHECK_THROWS_AS(icosahedral_points(0), Error);
  CHECK_THROWS_AS(cubed_sphere_points(10000), Error);
  CHECK_THROWS_AS(fibonacci_points(3), Error);
}
