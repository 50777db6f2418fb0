// SPDX-License-Identifier: BSD-3-Clause
#include "domain/fit.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "core/elementary.hpp"
#include "sizing/raster.hpp"
#include "support/sample_meshes.hpp"

using namespace delos;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);

// 2562 cells of 4.5 degrees.
Mesh made_mesh() { return samples::bisected_icosahedron(kEarth, 4); }

// Sea south of a coast that goes up and down in waves of 120 degrees.
LatLonField waves() {
  LatLonField field = make_table(kRadPerDeg);
  for (Index row = 0; row < field.n_rows(); ++row) {
    for (Index column = 0; column < field.n_lon; ++column) {
      const double lon = 2.0 * kPi * column / field.n_lon;
      field.values[field.at(row, column)] = field.lat_rad(row) - 0.35 * elementary::sin(3.0 * lon);
    }
  }
  return field;
}

domain::FitReport fit(const LatLonField& elevation, Mesh& mesh, int threads = 1) {
  parallel::Executor exec(threads);
  Monitor monitor;
  Context context{exec, monitor};
  const Phase phase(monitor, "fit", mesh.n_vertices());
  domain::FitOptions options;
  options.surface = kEarth;
  return domain::fit_to_coast(context, {elevation}, options, mesh);
}

double least_cosine(const Mesh& mesh) {
  double least = 1.0;
  for (const Triangle& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 corner = mesh.position(triangle.vertex[k]);
      const Vec3 p = mesh.position(triangle.vertex[(k + 1) % 3]) - corner;
      const Vec3 q = mesh.position(triangle.vertex[(k + 2) % 3]) - corner;
      least = std::min(least, p.dot(q) / (p.norm() * q.norm()));
    }
  }
  return least;
}

}  // namespace

TEST_CASE("a fitted coast has less area on its wrong side, and its triangles stay acute") {
  const LatLonField elevation = waves();
  Mesh mesh = made_mesh();
  const Mesh before = mesh;
  const domain::FitReport report = fit(elevation, mesh);
  CHECK(report.n_moved > 150);
  CHECK(report.n_moved < 800);
  CAPTURE(report.misplaced_before_m2);
  CAPTURE(report.misplaced_after_m2);
  CHECK(report.misplaced_after_m2 < 0.6 * report.misplaced_before_m2);
  CHECK(least_cosine(mesh) >= 0.139);  // 82 degrees
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    REQUIRE(mesh.triangles[i].vertex == before.triangles[i].vertex);
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    REQUIRE(mesh.vertices[i].spacing == before.vertices[i].spacing);
  }
}

TEST_CASE("vertices away from the coast and fixed ones stay where they are") {
  const LatLonField elevation = waves();
  Mesh mesh = made_mesh();
  mesh.fixed.offsets.assign(at(mesh.n_vertices() / 2) + 1, 0);  // no edges
  const Mesh before = mesh;
  const domain::FitReport report = fit(elevation, mesh);
  CHECK(report.n_moved > 0);
  for (Index i = 0; i < mesh.n_vertices(); ++i) {
    const Vec3 p = before.position(i);
    const bool is_far = std::abs(p.z()) > 0.75;
    if (before.fixed.has_vertex(i) || is_far) REQUIRE(mesh.position(i) == p);
  }
}

TEST_CASE("a coast is fitted with the same bits for any number of threads") {
  const LatLonField elevation = waves();
  Mesh one = made_mesh();
  fit(elevation, one);
  for (const int threads : {2, 5, 8}) {
    Mesh other = made_mesh();
    fit(elevation, other, threads);
    CHECK(digest(other) == digest(one));
  }
}

TEST_CASE("without a coast nothing moves") {
  LatLonField elevation = waves();
  std::fill(elevation.values.begin(), elevation.values.end(), -1.0);
  Mesh mesh = made_mesh();
  const std::string before = digest(mesh);
  const domain::FitReport report = fit(elevation, mesh);
  CHECK(report.n_moved == 0);
  CHECK(report.misplaced_before_m2 == 0.0);
  CHECK(digest(mesh) == before);
}
