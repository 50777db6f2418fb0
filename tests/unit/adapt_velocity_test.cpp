// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/velocity.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "geometry/east_north.hpp"
#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"

using namespace delos;

namespace {

constexpr double kRadius_m = 6371220.0;
const Vec3 kOmega(2e-6, -1e-6, 5e-6);  // 1/s: 30 m/s at the most

/// Solid rotation about an axis of no symmetry, in m/s.
Vec3 rotation(const Vec3& p) { return kRadius_m * kOmega.cross(p); }

std::vector<double> rotation_normals(const Grid& grid) {
  std::vector<double> out;
  for (std::size_t edge = 0; edge < at(grid.n_edges()); ++edge) {
    const Vec3 p = grid.edge_position[edge];
    const EastNorth local(grid.surface.normal(p));
    const Vec3 normal = std::cos(grid.edge_angle_rad[edge]) * local.east +
                        std::sin(grid.edge_angle_rad[edge]) * local.north;
    out.push_back(normal.dot(rotation(p)));
  }
  return out;
}

struct CellVectors {
  std::vector<double> east, north;
};

CellVectors vectors_of(const Grid& grid, std::span<const double> normal, int threads = 1) {
  parallel::Executor exec(threads);
  CellVectors out{std::vector<double>(at(grid.n_cells())), std::vector<double>(at(grid.n_cells()))};
  vectors_at_cells(exec, grid, normal, out.east, out.north);
  return out;
}

/// Largest error of the vectors in the cells, over the largest speed.
double vector_error(const Grid& grid) {
  const CellVectors vectors = vectors_of(grid, rotation_normals(grid));
  double worst = 0.0;
  for (std::size_t cell = 0; cell < at(grid.n_cells()); ++cell) {
    const Vec3 p = grid.cell_position[cell];
    const EastNorth local(grid.surface.normal(p));
    const Vec3 found = vectors.east[cell] * local.east + vectors.north[cell] * local.north;
    worst = std::max(worst, (found - rotation(p)).norm());
  }
  return worst / (kRadius_m * kOmega.norm());
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Grid sphere_grid(int levels) {
  const Ellipsoid sphere = Ellipsoid::sphere(kRadius_m);
  return samples::grid_of(sphere, samples::bisected_icosahedron(sphere, levels));
}

Grid shaken_grid() {
  const Ellipsoid sphere = Ellipsoid::sphere(kRadius_m);
  return samples::grid_of(sphere, samples::shaken(sphere, 3, 0.15, 1));
}

/// Median relative error of |grad zeta| of the rotation, zeta = 2 omega sin(angle from its
/// equator).
double gradient_error(const Grid& grid) {
  parallel::Executor exec(1);
  const auto gradient = vorticity_gradient(exec, grid, rotation_normals(grid));
  std::vector<double> errors;
  for (std::size_t cell = 0; cell < at(grid.n_cells()); ++cell) {
    const double exact = 2.0 * kOmega.cross(grid.cell_position[cell]).norm() / kRadius_m;
    errors.push_back(std::abs(gradient[cell] - exact) / (2.0 * kOmega.norm() / kRadius_m));
  }
  return median(errors);
}

}  // namespace

TEST_CASE("cell vectors of a solid rotation converge, poles and all") {
  const double coarse = vector_error(sphere_grid(3)), fine = vector_error(sphere_grid(4));
  CAPTURE(coarse);
  CAPTURE(fine);
  CHECK(coarse < 0.02);
  CHECK(fine < 0.6 * coarse);
  CHECK(vector_error(shaken_grid()) < 0.1);
}

TEST_CASE("uniform flow comes out exactly where the surface is all but flat") {
  // One cell's edges seen from so near that they lie in its plane: the flows to its east and to its
  // north, on its edges alone.
  const Grid grid = sphere_grid(3);
  for (std::int64_t cell = 0; cell < grid.n_cells(); ++cell) {
    const EastNorth local(grid.surface.normal(grid.cell_position[at(cell)]));
    std::vector<double> eastward(at(grid.n_edges()), 0.0), northward = eastward;
    for (const Index edge : grid.edges_on_cell.row(cell)) {
      const EastNorth axes(grid.surface.normal(grid.edge_position[at(edge)]));
      const double angle = grid.edge_angle_rad[at(edge)];
      const Vec3 normal = std::cos(angle) * axes.east + std::sin(angle) * axes.north;
      eastward[at(edge)] = normal.dot(local.east);
      northward[at(edge)] = normal.dot(local.north);
    }
    const CellVectors from_east = vectors_of(grid, eastward),
                      from_north = vectors_of(grid, northward);
    const double ee = from_east.east[at(cell)], en = from_north.east[at(cell)];
    const double nn = from_north.north[at(cell)];
    CHECK(ee == doctest::Approx(1.0).epsilon(1e-12));
    CHECK(std::abs(en) < 1e-12);
    CHECK(nn == doctest::Approx(1.0).epsilon(1e-12));
  }
}

TEST_CASE("normal components come back from the cells' vectors") {
  const Grid grid = sphere_grid(4);
  const auto normal = rotation_normals(grid);
  const CellVectors vectors = vectors_of(grid, normal);
  parallel::Executor exec(1);
  const auto back = normals_at_edges(exec, grid, vectors.east, vectors.north);
  double worst = 0.0;
  for (std::size_t e = 0; e < normal.size(); ++e) {
    worst = std::max(worst, std::abs(back[e] - normal[e]));
  }
  CHECK(worst < 0.02 * kRadius_m * kOmega.norm());
}

TEST_CASE("vorticity of a solid rotation is twice its rate, on any mesh") {
  for (const Grid& grid : {sphere_grid(4), shaken_grid()}) {
    parallel::Executor exec(1);
    const auto vorticity = relative_vorticity(exec, grid, rotation_normals(grid));
    double worst = 0.0, sum = 0.0;
    for (std::size_t v = 0; v < at(grid.n_vertices()); ++v) {
      const double exact = 2.0 * kOmega.dot(grid.vertex_position[v]);
      worst = std::max(worst, std::abs(vorticity[v] - exact) / (2.0 * kOmega.norm()));
      sum += vorticity[v] * grid.triangle_area_m2[v];
    }
    CHECK(worst < 0.15);
    // Every edge is passed both ways.
    CHECK(std::abs(sum) < 1e-12 * 2.0 * kOmega.norm() * grid.surface.area() * 4e13);
  }
}

TEST_CASE("the gradient of vorticity converges") {
  const double coarse = gradient_error(sphere_grid(3)), fine = gradient_error(sphere_grid(5));
  CAPTURE(coarse);
  CAPTURE(fine);
  CHECK(coarse < 0.05);
  CHECK(fine < 0.6 * coarse);
}

TEST_CASE("any number of threads gives the same vectors and gradients") {
  const Grid grid = sphere_grid(5);
  const auto normal = rotation_normals(grid);
  parallel::Executor one(1);
  const CellVectors expected = vectors_of(grid, normal);
  const auto gradient = vorticity_gradient(one, grid, normal);
  for (const int threads : {2, 5, 8}) {
    parallel::Executor exec(threads);
    const CellVectors vectors = vectors_of(grid, normal, threads);
    CHECK(vectors.east == expected.east);
    CHECK(vectors.north == expected.north);
    CHECK(vorticity_gradient(exec, grid, normal) == gradient);
    CHECK(normals_at_edges(exec, grid, vectors.east, vectors.north) ==
          normals_at_edges(one, grid, expected.east, expected.north));
  }
}

TEST_CASE("velocities of another grid are refused") {
  const Grid grid = sphere_grid(2);
  const std::vector<double> few(3);
  parallel::Executor exec(1);
  testing::expect_error(ErrorKind::input, {"3 values", "480 edges"},
                        [&] { relative_vorticity(exec, grid, few); });
  testing::expect_error(ErrorKind::input, {"3 values", "162 cells"},
                        [&] { normals_at_edges(exec, grid, few, few); });
}
