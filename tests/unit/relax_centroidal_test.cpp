// SPDX-License-Identifier: BSD-3-Clause
#include "relax/centroidal.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

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

/// A generator at the north pole, six around it, nearer on the side of +x.
std::vector<Vec3> lopsided_hexagon(const Ellipsoid& sphere, double lean) {
  std::vector<Vec3> points{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  for (int i = 0; i < 6; ++i) {
    const double angle = kPi * i / 3.0, r = 0.1 * (1.0 - lean * std::cos(angle));
    points.push_back(sphere.project({r * std::cos(angle), r * std::sin(angle), 1.0}));
  }
  return points;
}

/// Root mean square of the distances from generator to centroid, over the spacing.
double offset(const Ellipsoid& surface, const Mesh& mesh, const NeighbourRows& rows) {
  double squares = 0.0;
  for (Index v = 0; v < mesh.n_vertices(); ++v) {
    const Vec3 centroid = surface.project(cell_centroid(surface, mesh.vertices, rows, v));
    squares += (centroid - mesh.position(v)).squaredNorm();
  }
  return std::sqrt(squares / mesh.n_vertices()) / mesh.vertices[0].spacing;
}

}  // namespace

TEST_CASE(
    "the centroid of a regular cell is its generator, that of a lopsided one is farther off") {
  parallel::Executor exec(1);
  const Ellipsoid sphere;
  const auto centroid = [&](double lean) {
    const Mesh mesh = mesh_of(exec, lopsided_hexagon(sphere, lean), 0.1);
    return cell_centroid(sphere, mesh.vertices, NeighbourRows(exec, mesh), 0);
  };
  CHECK(centroid(0.0).head<2>().norm() < 1e-15);
  CHECK(centroid(0.2).x() < -1e-3);
  CHECK(std::abs(centroid(0.2).y()) < 1e-15);
}

TEST_CASE("the centroid leans to where the spacing is fine, by the fourth power") {
  parallel::Executor exec(1);
  const Ellipsoid sphere;
  Mesh mesh = mesh_of(exec, lopsided_hexagon(sphere, 0.0), 0.1);
  const double per_length = 0.5;  // of the spacing, relative
  for (Vertex& v : mesh.vertices) v.spacing = 0.1 * (1.0 - per_length * v.x);
  // For density 1 + 4 g x in a hexagon of inradius r, the centroid is at 4 g <x^2>, <x^2> = 5
  // r^2/18; here r is half of the distance of the neighbours.
  const double r = 0.05;
  const double expected = 4.0 * per_length * 5.0 / 18.0 * r * r;
  const Vec3 found = cell_centroid(sphere, mesh.vertices, NeighbourRows(exec, mesh), 0);
  CHECK(found.x() == doctest::Approx(expected).epsilon(0.02));
}

TEST_CASE("a vertex of more than eight neighbours counts as its own centroid") {
  std::vector<Vec3> points{{0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 12; ++i) {
    points.emplace_back(std::cos(kPi * i / 6.0), std::sin(kPi * i / 6.0), 0.1);
    points.back().normalize();
  }
  parallel::Executor exec(1);
  const Mesh mesh = mesh_of(exec, points, 0.5);
  const Ellipsoid sphere;
  CHECK(cell_centroid(sphere, mesh.vertices, NeighbourRows(exec, mesh), 0) == Vec3(0, 0, 1));
}

TEST_CASE("rounds bring the generators of a bisected icosahedron to the centroids") {
  parallel::Executor exec(1);
  const Ellipsoid sphere;
  const double spacing = 0.15;
  Mesh mesh = mesh_of(exec, icosahedral_points(8), spacing);
  const SpacingField field = SpacingField::constant(sphere, spacing);
  Moving moving{NeighbourRows(exec, mesh)};
  const double before = offset(sphere, mesh, moving.rows);
  constexpr int kRounds = 60;
  for (int round = 0; round < kRounds; ++round) {
    centroidal_round(exec, {sphere, field}, centroidal_momentum(kRounds), moving, mesh);
    std::vector<Index> flipped;
    restore_delaunay_everywhere(exec, mesh, sphere, &flipped);
    moving.rows.update(mesh, flipped);
  }
  const double after = offset(sphere, mesh, moving.rows);
  CHECK(before > 1e-3);
  CHECK(after < 0.01 * before);
}
