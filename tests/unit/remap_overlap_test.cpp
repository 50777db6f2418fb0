// SPDX-License-Identifier: BSD-3-Clause
#include "remap/overlap.hpp"

#include <doctest/doctest.h>

#include <numeric>

#include "remap/weights.hpp"
#include "support/expect_error.hpp"
#include "support/sample_fields.hpp"

using namespace delos;

namespace {

/// The same mesh with other numbers and other first corners.
Mesh renumbered(const Mesh& mesh) {
  const Index n = static_cast<Index>(mesh.n_vertices());
  Mesh result = mesh;
  for (Index v = 0; v < n; ++v) result.vertices[at(n - 1 - v)] = mesh.vertices[at(v)];
  for (Triangle& triangle : result.triangles) {
    auto& [a, b, c] = triangle.vertex;
    triangle.vertex = {n - 1 - b, n - 1 - c, n - 1 - a};
    auto& [x, y, z] = triangle.neighbour;
    triangle.neighbour = {y, z, x};
  }
  return result;
}

}  // namespace

TEST_CASE("octants overlap the cells of a tetrahedron in wholes and thirds") {
  const Ellipsoid sphere = Ellipsoid::sphere(10.0);
  const Grid tetrahedron = samples::grid_of(sphere, samples::tetrahedron(sphere));
  const Grid cube = samples::grid_of(sphere, samples::split_cube(sphere));
  const remap::Overlaps overlaps = samples::overlaps_of(tetrahedron, cube);
  REQUIRE(overlaps.n_targets == 8);
  REQUIRE(overlaps.size() == 4 + 4 * 3);
  for (std::int64_t i = 0; i < 8; ++i) {
    const auto n = overlaps.offsets[at(i) + 1] - overlaps.offsets[at(i)];
    const double expected = 100.0 * kPi / (n == 1 ? 2.0 : 6.0);
    for (auto k = overlaps.offsets[at(i)]; k < overlaps.offsets[at(i) + 1]; ++k) {
      CHECK(overlaps.area_m2[at(k)] == doctest::Approx(expected).epsilon(1e-14));
    }
  }
}

TEST_CASE("a renumbered grid overlaps cell for cell and copies fields to the bit") {
  for (const Ellipsoid& surface :
       {Ellipsoid(), Ellipsoid::wgs84(), Ellipsoid(Vec3(1.2, 1.0, 0.8), Vec3::Zero())}) {
    CAPTURE(surface.radii().transpose());
    const Mesh mesh = samples::shaken(surface, 3, 0.1, 7);
    const Grid a = samples::grid_of(surface, mesh), b = samples::grid_of(surface, renumbered(mesh));
    const remap::Overlaps overlaps = samples::overlaps_of(a, b);
    CHECK(overlaps.n_unchanged == a.n_cells());
    REQUIRE(overlaps.size() == a.n_cells());
    parallel::Executor exec(1);
    const auto field = samples::rough_field(a.n_cells(), 1);
    std::vector<double> result(field.size());
    remap::apply(exec, remap::first_order_weights(exec, overlaps), field, result);
    for (std::size_t i = 0; i < field.size(); ++i) CHECK(result[i] == field[field.size() - 1 - i]);
  }
}

TEST_CASE("cells far from a change keep their values to the bit") {
  const Ellipsoid sphere;
  Mesh mesh = samples::shaken(sphere, 4, 0.1, 9);
  const Grid before = samples::grid_of(sphere, mesh);
  const auto is_near = [](const Vec3& p) { return p.x() > 0.8; };
  for (Vertex& v : mesh.vertices) {
    if (!is_near(v.position())) continue;
    const Vec3 p = sphere.project(v.position() + 0.2 * v.spacing * Vec3(0, 1, 0.3));
    v = {p.x(), p.y(), p.z(), v.spacing};
  }
  const Grid after = samples::grid_of(sphere, samples::make_delaunay(mesh));
  const remap::Overlaps overlaps = samples::overlaps_of(before, after);
  parallel::Executor exec(1);
  const auto field = samples::rough_field(before.n_cells(), 1);
  std::vector<double> result(field.size());
  remap::apply(exec, remap::first_order_weights(exec, overlaps), field, result);
  int n_kept = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const bool is_far = after.cell_position[i].x() < 0.6;
    n_kept += result[i] == field[i];
    if (is_far) CHECK(result[i] == field[i]);
    if (is_far) CHECK(overlaps.offsets[i + 1] - overlaps.offsets[i] == 1);
  }
  CHECK(n_kept >= overlaps.n_unchanged);
  CHECK(n_kept < after.n_cells());
}

TEST_CASE("triangles overlap triangles as cells do cells") {
  for (const Ellipsoid& surface : {Ellipsoid(), Ellipsoid(Vec3(1.0, 0.9, 0.8), Vec3::Zero())}) {
    const Grid a = samples::grid_of(surface, samples::shaken(surface, 3, 0.1, 1));
    const Grid b = samples::grid_of(surface, samples::shaken(surface, 3, 0.1, 2));
    parallel::Executor exec(2);
    Monitor monitor;
    Context context{exec, monitor};
    const auto overlaps = remap::intersect(context, remap::Tiling::triangles(exec, a),
                                           remap::Tiling::triangles(exec, b));
    CHECK(overlaps.n_targets == b.n_vertices());
    CHECK(overlaps.largest_gap < 1e-11);
    std::vector<double> result(at(b.n_vertices()));
    const auto field = samples::rough_field(a.n_vertices(), 1);
    remap::apply(exec, remap::first_order_weights(exec, overlaps), field, result);
    const double kept = samples::mass(result, b.triangle_area_m2);
    CHECK(kept == doctest::Approx(samples::mass(field, a.triangle_area_m2)).epsilon(1e-14));
  }
}

TEST_CASE("grids of different surfaces are refused") {
  const Grid a = samples::grid_of(Ellipsoid(), samples::tetrahedron(Ellipsoid()));
  const Ellipsoid other = Ellipsoid::sphere(2.0);
  const Grid b = samples::grid_of(other, samples::tetrahedron(other));
  CHECK_THROWS_AS(samples::overlaps_of(a, b), Error);
}

TEST_CASE("triangles of a grid with a border are refused") {
  parallel::Executor exec(1);
  const Ellipsoid sphere = Ellipsoid::sphere(10.0);
  Grid grid = samples::grid_of(sphere, samples::tetrahedron(sphere));
  grid.cells_on_edge[2][1] = kNone;
  delos::testing::expect_error(ErrorKind::input, {"a grid of 4 cells has a border"},
                               [&] { remap::Tiling::triangles(exec, grid); });
}
