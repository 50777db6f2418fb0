// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/quality.hpp"

#include <doctest/doctest.h>

#include "metrics/report.hpp"
#include "support/sample_meshes.hpp"

using namespace delos;

namespace {

Quality measure(const Ellipsoid& surface, const Mesh& mesh, int threads = 1) {
  parallel::Executor exec(threads);
  Monitor monitor;
  Context context{exec, monitor};
  return measure_quality(context, surface, mesh);
}

}  // namespace

TEST_CASE("the icosahedron is perfect but for its twelve vertices of degree five") {
  const Ellipsoid surface = Ellipsoid::sphere(6371220.0);
  const Quality q = measure(surface, samples::bisected_icosahedron(surface, 0));
  CHECK(q.n_vertices == 12);
  CHECK(q.n_edges == 30);
  CHECK(q.euler == 2);
  CHECK(q.n_non_delaunay == 0);
  CHECK(q.n_degenerate == 0);
  CHECK(q.area_length_min.value == doctest::Approx(1.0).epsilon(1e-14));
  CHECK(q.area_length_p01 == doctest::Approx(1.0).epsilon(1e-14));
  CHECK(q.angle_min_deg.value == doctest::Approx(60.0).epsilon(1e-13));
  CHECK(q.angle_max_deg.value == doctest::Approx(60.0).epsilon(1e-13));
  CHECK(q.angle_mad_deg < 1e-12);
  CHECK(q.radius_edge_max.value == doctest::Approx(1.0 / std::sqrt(3.0)).epsilon(1e-13));
  CHECK(q.well_centred == 1.0);
  CHECK(q.degree_5 == 1.0);
  CHECK(q.stagger_max.value < 1e-14);
  CHECK(q.grading_max.value == doctest::Approx(1.0).epsilon(1e-13));
  CHECK(q.total_area_error < 1e-14);
  CHECK(certificate(q).well_centred);
}

TEST_CASE("relative edges are lengths over the spacing field") {
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  const Ellipsoid surface = Ellipsoid::sphere(1000.0);
  const Mesh mesh = samples::bisected_icosahedron(surface, 0);
  // The icosahedron's edge is 4 / sqrt(10 + 2 sqrt(5)) radii.
  const double edge_m = 4000.0 / std::sqrt(10.0 + 2.0 * std::sqrt(5.0));
  const Quality q =
      measure_quality(context, surface, SpacingField::constant(surface, 2.0 * edge_m), mesh);
  CHECK(q.relative_edge_mean == doctest::Approx(0.5).epsilon(1e-13));
  CHECK(q.relative_edge_std < 1e-7);
  CHECK(q.spacing_min_m == doctest::Approx(2.0 * edge_m));
}

TEST_CASE("quality counts obtuse triangles and non-Delaunay sides, and says where") {
  const Ellipsoid surface;
  Mesh mesh = samples::bisected_icosahedron(surface, 2);
  const Vec3 a = mesh.position(0);
  const Index neighbour = mesh.triangle(triangle_at_vertex(mesh)[0]).vertex[0] == 0
                              ? mesh.triangle(triangle_at_vertex(mesh)[0]).vertex[1]
                              : mesh.triangle(triangle_at_vertex(mesh)[0]).vertex[0];
  const Vec3 moved = surface.project(0.25 * a + 0.75 * mesh.position(neighbour));
  mesh.vertices[0] = {moved.x(), moved.y(), moved.z(), mesh.vertices[0].spacing};
  const Quality q = measure(surface, mesh);
  CHECK(q.n_obtuse > 0);
  CHECK(q.n_non_delaunay > 0);
  CHECK(q.euler == 2);
  CHECK(!certificate(q).well_centred);
  const Vec3 worst = surface.point(q.angle_max_deg.where, LatitudeKind::geodetic);
  CHECK((worst - a).norm() < 0.6);
  CHECK(q.relative_edge_min.id == 0);
  CHECK(q.relative_edge_min.other == neighbour);
}

TEST_CASE("a triangle without area is counted and leaves no number that is not finite") {
  const Ellipsoid surface;
  Mesh mesh = samples::bisected_icosahedron(surface, 1);
  const auto& corner = mesh.triangle(7).vertex;
  mesh.vertices[static_cast<std::size_t>(corner[0])] =
      mesh.vertices[static_cast<std::size_t>(corner[1])];
  Report report;
  report.quality = measure(surface, mesh);
  CHECK(report.quality.n_degenerate >= 1);
  CHECK(report.quality.area_length_min.value == 0.0);
  CHECK(report_json(report).find("null") == std::string::npos);
}

TEST_CASE("quality has the same bits for any number of threads") {
  const Ellipsoid surface = Ellipsoid::wgs84();
  const Mesh mesh = samples::shaken(surface, 5, 0.15, 11);
  Report one;
  one.quality = measure(surface, mesh, 1);
  for (const int threads : {2, 5, 8}) {
    Report many;
    many.quality = measure(surface, mesh, threads);
    CHECK(report_json(many) == report_json(one));
  }
}
