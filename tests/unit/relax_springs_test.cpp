// SPDX-License-Identifier: BSD-3-Clause
#include "relax/springs.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "triangulation/delaunay.hpp"
#include "triangulation/flip.hpp"
#include "triangulation/seeds.hpp"

using namespace delos;

namespace {

Mesh mesh_of(parallel::Executor& exec, const std::vector<Vec3>& points, double spacing) {
  Mesh mesh = delaunay(exec, points);
  for (Vertex& v : mesh.vertices) v.spacing = spacing;
  return mesh;
}

}  // namespace

TEST_CASE("rows hold every neighbour once, beyond the eighth in the overflow") {
  // A ring of twelve around the north pole, and the south pole: the poles have degree twelve.
  std::vector<Vec3> points{{0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 12; ++i) {
    points.emplace_back(std::cos(kPi * i / 6.0), std::sin(kPi * i / 6.0), 0.0);
  }
  parallel::Executor exec(1);
  const Mesh mesh = mesh_of(exec, points, 0.5);
  const NeighbourRows rows(exec, mesh);
  REQUIRE(rows.overflow_of(0) != nullptr);
  CHECK(rows.overflow_of(0)->neighbours.size() == 4);
  CHECK(rows.overflow().size() == 2);
  CHECK(rows.overflow_of(5) == nullptr);
  const auto& row = rows.row(5);
  CHECK(std::count(row.begin(), row.end(), 5) == 4);  // four neighbours, four empty places
}

TEST_CASE("rows renewed after flips hold what rows built anew hold") {
  parallel::Executor exec(1);
  Mesh mesh = mesh_of(exec, fibonacci_points(400), 0.2);
  NeighbourRows renewed(exec, mesh);
  // Flips that pile degree on vertex 7 until it overflows, then those that take it off again.
  for (int round = 0; round < 12; ++round) {
    CAPTURE(round);
    std::vector<Index> touched;
    for (Index tri = 0; tri < mesh.n_triangles() && touched.empty(); ++tri) {
      const int k = corner_at(mesh.triangle(tri), 7);
      const int side = round < 6 ? k : next_corner(k);
      if (k < 0 || !can_flip(mesh, tri, side)) continue;
      touched = {tri, mesh.triangle(tri).neighbour[static_cast<std::size_t>(side)]};
      flip(mesh, tri, side);
    }
    REQUIRE_FALSE(touched.empty());
    renewed.update(mesh, touched);
    const NeighbourRows fresh(exec, mesh);
    REQUIRE(renewed.overflow().size() == fresh.overflow().size());
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
      const auto all_of = [&](const NeighbourRows& rows) {
        std::vector<Index> all(rows.row(v).begin(), rows.row(v).end());
        if (const auto* more = rows.overflow_of(v)) {
          all.insert(all.end(), more->neighbours.begin(), more->neighbours.end());
        }
        std::sort(all.begin(), all.end());
        return all;
      };
      REQUIRE(all_of(renewed) == all_of(fresh));
    }
  }
}

TEST_CASE("an icosahedron with the right rest length stays where it is") {
  parallel::Executor exec(1);
  const std::vector<Vec3> points = icosahedral_points(1);
  const Ellipsoid sphere;
  const double edge = 4.0 / std::sqrt(10.0 + 2.0 * std::sqrt(5.0));
  Mesh mesh = mesh_of(exec, points, edge);
  Moving moving{NeighbourRows(exec, mesh)};
  const SpacingField spacing = SpacingField::constant(sphere, edge);
  spring_round(exec, {sphere, spacing}, moving, mesh);
  for (std::size_t v = 0; v < points.size(); ++v) {
    CHECK((points[v] - mesh.vertices[v].position()).norm() < 1e-14);
  }
}

TEST_CASE("springs pull the lengths of a disturbed grid together") {
  parallel::Executor exec(1);
  const Ellipsoid sphere;
  std::vector<Vec3> points = icosahedral_points(8);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double angle = 0.37 * static_cast<double>(i);
    points[i] = sphere.project(points[i] +
                               0.02 * Vec3(std::cos(angle), std::sin(2 * angle), std::sin(angle)));
  }
  Mesh mesh = mesh_of(exec, points, 0.14);
  Moving moving{NeighbourRows(exec, mesh)};
  const SpacingField spacing = SpacingField::constant(sphere, 0.14);
  // Spread of the edge lengths (their mean is set by the number of points).
  const auto energy = [&] {
    double sum = 0.0, squares = 0.0;
    for (const Triangle& t : mesh.triangles) {
      const double length = (mesh.position(t.vertex[0]) - mesh.position(t.vertex[1])).norm();
      sum += length;
      squares += length * length;
    }
    return squares - sum * sum / static_cast<double>(mesh.triangles.size());
  };
  const double before = energy();
  for (int round = 0; round < 20; ++round) spring_round(exec, {sphere, spacing}, moving, mesh);
  CHECK(energy() < 0.3 * before);
  for (const Vertex& v : mesh.vertices) CHECK(std::abs(v.position().norm() - 1.0) < 1e-15);
}
