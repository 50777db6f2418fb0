// SPDX-License-Identifier: BSD-3-Clause
#include "dual/build.hpp"
#include "dual/digest.hpp"

#include <doctest/doctest.h>

#include "dual/validate.hpp"
#include "support/sample_meshes.hpp"

using namespace delos;

namespace {

struct Host {
  parallel::Executor exec{1};
  Monitor monitor;
  Context context{exec, monitor};
};

std::string broken_rules(Context& context, const Grid& grid) {
  std::string all;
  for (const BrokenRule& rule : check_grid(context, grid)) all += to_string(rule) + "\n";
  return all;
}

}  // namespace

TEST_CASE("the dual of the icosahedron is the dodecahedron") {
  Host host;
  const double radius_m = 6371220.0;
  const auto surface = Ellipsoid::sphere(radius_m);
  const Grid grid = build_grid(host.context, surface, LatitudeKind::geodetic,
                               samples::bisected_icosahedron(surface, 0));
  CHECK(broken_rules(host.context, grid) == "");
  CHECK(grid.n_cells() == 12);
  CHECK(grid.n_edges() == 30);
  CHECK(grid.n_vertices() == 20);
  const double face_m2 = 4.0 * kPi * radius_m * radius_m / 12.0;
  for (std::int64_t cell = 0; cell < 12; ++cell) {
    CHECK(grid.edges_on_cell.row(cell).size() == 5);
    CHECK(grid.cell_area_m2[static_cast<std::size_t>(cell)] ==
          doctest::Approx(face_m2).epsilon(1e-14));
  }
  // Central angles of the edges: atan(2) and acos(sqrt(5) / 3).
  CHECK(grid.cell_distance_m[7] == doctest::Approx(std::atan(2.0) * radius_m).epsilon(1e-14));
  CHECK(grid.vertex_distance_m[7] ==
        doctest::Approx(std::acos(std::sqrt(5.0) / 3.0) * radius_m).epsilon(1e-14));
  CHECK(grid.cell_spacing_m[3] ==
        doctest::Approx(radius_m * std::sqrt(8.0 * kPi / std::sqrt(3.0) / 12.0)));
}

TEST_CASE("edges are numbered by their lower cell and lists begin at the lowest triangle") {
  Host host;
  const Ellipsoid surface;
  const Mesh mesh = samples::bisected_icosahedron(surface, 2);
  const Grid grid = build_grid(host.context, surface, LatitudeKind::geodetic, mesh);
  for (std::size_t edge = 1; edge < grid.cells_on_edge.size(); ++edge) {
    CHECK(grid.cells_on_edge[edge - 1][0] <= grid.cells_on_edge[edge][0]);
  }
  for (std::int64_t cell = 0; cell < grid.n_cells(); ++cell) {
    const auto vertices = grid.vertices_on_cell.row(cell);
    CHECK(*std::min_element(vertices.begin(), vertices.end()) == vertices[0]);
  }
}

TEST_CASE("the edge angle is 0 towards east and a quarter turn towards north") {
  Host host;
  const Ellipsoid surface;
  // The octahedron: its edges run along the equator and along four meridians.
  const std::vector<Vec3> points{{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                 {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  samples::Corners corners;
  for (const Index x : {0, 1}) {
    for (const Index y : {2, 3}) {
      for (const Index z : {4, 5}) corners.push_back({x, y, z});
    }
  }
  const Grid grid = build_grid(host.context, surface, LatitudeKind::geodetic,
                               samples::connect(points, samples::outward(points, corners), 1.5));
  CHECK(broken_rules(host.context, grid) == "");
  for (std::size_t edge = 0; edge < 12; ++edge) {
    const auto [c, d] = grid.cells_on_edge[edge];
    if (c == 0 && d == 2) CHECK(grid.edge_angle_rad[edge] == doctest::Approx(0.0));
    if (c == 0 && d == 3) CHECK(std::abs(grid.edge_angle_rad[edge]) == doctest::Approx(kPi));
    if (d == 4) CHECK(grid.edge_angle_rad[edge] == doctest::Approx(0.5 * kPi));
    if (d == 5) CHECK(grid.edge_angle_rad[edge] == doctest::Approx(-0.5 * kPi));
  }
}

TEST_CASE("the tetrahedron, the smallest closed mesh, has a dual") {
  Host host;
  const Ellipsoid surface;
  const Grid grid =
      build_grid(host.context, surface, LatitudeKind::geodetic, samples::tetrahedron(surface));
  CHECK(broken_rules(host.context, grid) == "");
  CHECK(grid.edges_on_edge.row(0).size() == 4);
}

TEST_CASE("cocircular cells give a dual edge of no length and nothing that is not finite") {
  Host host;
  for (const Ellipsoid& surface :
       {Ellipsoid(), Ellipsoid::wgs84(), Ellipsoid(Vec3(1.2, 1.0, 0.8), Vec3::Zero())}) {
    const Grid grid =
        build_grid(host.context, surface, LatitudeKind::geodetic, samples::split_cube(surface));
    for (const double weight : grid.weights_on_edge.values) CHECK(std::isfinite(weight));
    for (const double angle : grid.edge_angle_rad) CHECK(std::isfinite(angle));
    double sum = 0.0;
    for (const double area : grid.cell_area_m2) sum += area;
    const double whole = surface.area() * surface.scale_m() * surface.scale_m();
    CHECK(std::abs(sum / whole - 1.0) < 1e-13);
  }
}

TEST_CASE("an open mesh is refused") {
  Host host;
  Mesh mesh = samples::tetrahedron(Ellipsoid());
  mesh.triangles.pop_back();
  CHECK_THROWS_WITH_AS(build_grid(host.context, Ellipsoid(), LatitudeKind::geodetic, mesh),
                       doctest::Contains("3 triangles"), Error);
}

TEST_CASE("the grid digest sees one bit of one array") {
  Host host;
  const Ellipsoid surface;
  Grid grid = build_grid(host.context, surface, LatitudeKind::geodetic,
                         samples::bisected_icosahedron(surface, 1));
  parallel::Executor& exec = host.context.exec;
  const std::string before = digest(exec, grid);
  CHECK(before.size() == 64);
  Grid changed = grid;
  changed.weights_on_edge.values[5] = std::nextafter(grid.weights_on_edge.values[5], 1.0);
  CHECK(digest(exec, changed) != before);
  changed = grid;
  Array<std::int64_t> rows(grid.cells_on_cell.offsets.positions().begin(),
                           grid.cells_on_cell.offsets.positions().end());
  changed.cells_on_cell.offsets = RowOffsets(rows);  // no longer shared, still the same
  CHECK(digest(exec, changed) == before);
  ++rows[3];
  changed.cells_on_cell.offsets = RowOffsets(rows);
  CHECK(digest(exec, changed) != before);
}
