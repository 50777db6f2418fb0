// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/delaunay.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "triangulation/seeds.hpp"
#include "triangulation/validate.hpp"

using namespace delos;

namespace {

std::string message_of(const std::vector<Vec3>& points) {
  parallel::Executor exec(1);
  try {
    delaunay(exec, points);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::input);
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::vector<Vec3> kOctahedron = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                       {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};

}  // namespace

TEST_CASE("four points give the tetrahedron") {
  parallel::Executor exec(1);
  const std::vector<Vec3> points = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const Mesh mesh = delaunay(exec, points);
  CHECK(mesh.n_triangles() == 4);
  const Ellipsoid surface;
  CHECK(summary(validate(mesh, surface, {2.0, true, 10})) == "");
}

TEST_CASE("the octahedron, in which no four points enclose the centre, is triangulated") {
  parallel::Executor exec(1);
  const Mesh mesh = delaunay(exec, kOctahedron);
  CHECK(mesh.n_triangles() == 8);
  CHECK(summary(validate(mesh, Ellipsoid())) == "");
}

TEST_CASE("vertex i is point i") {
  parallel::Executor exec(1);
  const std::vector<Vec3> points = fibonacci_points(1000);
  const Mesh mesh = delaunay(exec, points);
  for (Index i = 0; i < 1000; ++i) CHECK(mesh.position(i) == points[static_cast<std::size_t>(i)]);
  CHECK(summary(validate(mesh, Ellipsoid())) == "");
}

TEST_CASE("a duplicate is refused with both indices") {
  std::vector<Vec3> points = fibonacci_points(500);
  points[321] = points[17];
  CHECK(contains(message_of(points), "points 17 and 321 are the same point"));
}

TEST_CASE("points in a half-space, or on its border, are refused") {
  std::vector<Vec3> points;
  for (const Vec3& p : fibonacci_points(2000)) {
    if (p.z() > 0.1) points.push_back(p);
  }
  CHECK(contains(message_of(points), "one side of a plane"));
  std::vector<Vec3> half_octahedron = kOctahedron;
  half_octahedron.pop_back();
  CHECK(contains(message_of(half_octahedron), "one side of a plane"));
  CHECK(contains(message_of({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}), "in one plane"));
  CHECK(contains(message_of({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}), "at least 4"));
}

TEST_CASE("a coordinate that is not finite is refused with its index") {
  std::vector<Vec3> points = fibonacci_points(100);
  points[42].y() = std::numeric_limits<double>::quiet_NaN();
  CHECK(contains(message_of(points), "point 42"));
}

TEST_CASE("a point inside the hull of its neighbours is refused") {
  std::vector<Vec3> points = fibonacci_points(200);
  points[50] *= 0.5;
  CHECK(contains(message_of(points), "inside the hull"));
}
