// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/quality.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <numeric>

#include "metrics/certificate.hpp"
#include "metrics/passes.hpp"
#include "metrics/report.hpp"
#include "support/expect_error.hpp"
#include "support/sample_meshes.hpp"

using namespace delos;
using delos::testing::expect_error;

namespace {

Quality measure(const Ellipsoid& surface, const Mesh& mesh, int threads = 1) {
  parallel::Executor exec(threads);
  Monitor monitor;
  Context context{exec, monitor};
  // The mean of what the vertices at both ends were asked for.
  const SideSpacing spacing = [&mesh](Index tri, int k) {
    const auto& corner = mesh.triangle(tri).vertex;
    const auto at = [&](int c) {
      return mesh.vertices[static_cast<std::size_t>(corner[static_cast<std::size_t>(c)])].spacing;
    };
    return 0.5 * (at(next_corner(k)) + at(previous_corner(k)));
  };
  return measure_quality(context, surface, spacing, mesh);
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
  CHECK(certificate(q).is_well_centred());
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
  CHECK_FALSE(certificate(q).is_well_centred());
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

TEST_CASE("a triangle that is folded over is not well centred, however acute") {
  const Ellipsoid surface;
  Mesh mesh = samples::bisected_icosahedron(surface, 1);
  std::swap(mesh.triangles[3].vertex[0], mesh.triangles[3].vertex[1]);
  std::swap(mesh.triangles[3].neighbour[0], mesh.triangles[3].neighbour[1]);
  const metrics::Subject subject{surface, mesh};
  parallel::Executor exec(1);
  metrics::Workspace work;
  const auto sums = metrics::measure_triangles(exec, subject, work);
  CHECK(sums.n_degenerate == 1);
  CHECK(sums.n_acute == mesh.n_triangles() - 1);
}

TEST_CASE("right angles are neither acute nor far from it") {
  const Ellipsoid surface;
  const Quality q = measure(surface, samples::split_cube(surface));
  CHECK(q.n_right == 12);
  CHECK(q.angle_max_deg.value == doctest::Approx(90.0).epsilon(1e-12));
}

TEST_CASE("without a spacing nothing is said about relative edges") {
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  const Ellipsoid surface;
  const Quality q =
      measure_quality(context, surface, nullptr, samples::bisected_icosahedron(surface, 2));
  CHECK_FALSE(q.knows_spacing);
  CHECK(q.relative_edge_min.id == kNone);
  CHECK(std::accumulate(q.relative_edge.counts.begin(), q.relative_edge.counts.end(),
                        std::int64_t{0}) == 0);
  CHECK(q.dual_ratio_min.value > 0.0);
}

TEST_CASE("a vertex off the surface, a spacing that is not > 0 and no triangles are errors") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Ellipsoid surface = Ellipsoid::wgs84();
  const Mesh good = samples::bisected_icosahedron(surface, 2);
  for (const double x : {kNan, std::numeric_limits<double>::infinity(), 0.4}) {
    Mesh bad = good;
    bad.vertices[17].x = bad.vertices[40].x = x;
    expect_error(ErrorKind::internal, {"cell 17 (from 0)", "2 cells"},
                 [&] { measure(surface, bad); });
  }
  for (const double spacing : {kNan, 0.0, -0.1}) {
    Mesh bad = good;
    for (Vertex& vertex : bad.vertices) vertex.spacing = spacing;
    expect_error(ErrorKind::internal, {"relative_edge"}, [&] { measure(surface, bad); });
  }
  expect_error(ErrorKind::internal, {"has no quality"}, [&] { measure(surface, Mesh{}); });
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
