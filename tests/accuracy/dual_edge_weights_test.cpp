// SPDX-License-Identifier: BSD-3-Clause
#include "dual/edge_weights.hpp"

#include <doctest/doctest.h>

#include "dual/build.hpp"
#include "support/sample_meshes.hpp"

using namespace delos;

namespace {

// Relative root-mean-square error of the tangential velocity of a solid-body rotation.
double tangential_error(const Ellipsoid& surface, int levels) {
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  const Grid grid = build_grid(context, surface, LatitudeKind::geodetic,
                               samples::bisected_icosahedron(surface, levels));
  const Vec3 axis(0.3, 0.5, 0.8);
  std::vector<double> normal_speed(at(grid.n_edges())), tangential_speed(at(grid.n_edges()));
  for (std::size_t e = 0; e < normal_speed.size(); ++e) {
    const Vec3 wind = axis.cross(grid.edge_position[e]);
    const auto [v, w] = grid.vertices_on_edge[e];
    const Vec3 up = surface.normal(grid.edge_position[e]);
    const Vec3 normal =
        (grid.vertex_position[at(w)] - grid.vertex_position[at(v)]).cross(up).normalized();
    normal_speed[e] = wind.dot(normal);
    tangential_speed[e] = wind.dot(up.cross(normal));
  }
  double error = 0.0, size = 0.0;
  for (std::size_t e = 0; e < normal_speed.size(); ++e) {
    const auto edges = grid.edges_on_edge.row(static_cast<std::int64_t>(e));
    const auto weights = grid.weights_on_edge.row(static_cast<std::int64_t>(e));
    double sum = 0.0;
    for (std::size_t j = 0; j < edges.size(); ++j) sum += weights[j] * normal_speed[at(edges[j])];
    error += (sum - tangential_speed[e]) * (sum - tangential_speed[e]);
    size += tangential_speed[e] * tangential_speed[e];
  }
  return std::sqrt(error / size);
}

}  // namespace

TEST_CASE("the tangential wind of a solid-body rotation converges on icosahedral grids") {
  const double coarse = tangential_error(Ellipsoid(), 3);
  const double middle = tangential_error(Ellipsoid(), 4);
  const double fine = tangential_error(Ellipsoid(), 5);
  CAPTURE(coarse);
  CAPTURE(middle);
  CAPTURE(fine);
  CHECK(coarse < 0.06);
  // Half an order in the mean square on bisected, not centroidal, grids.
  CHECK(middle < coarse / 1.35);
  CHECK(fine < middle / 1.35);
}

TEST_CASE("weights on WGS84 reconstruct the wind as well as on the sphere") {
  CHECK(tangential_error(Ellipsoid::wgs84(), 4) < 1.1 * tangential_error(Ellipsoid(), 4));
}
