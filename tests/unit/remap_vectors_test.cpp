// SPDX-License-Identifier: BSD-3-Clause
#include "remap/vectors.hpp"

#include <doctest/doctest.h>

#include "remap/stream.hpp"
#include "support/sample_fields.hpp"

using namespace delos;

namespace {

struct Setting {
  parallel::Executor exec{2};
  Monitor monitor;
  Context context{exec, monitor};
};

Vec3 rotation(const Vec3& p) { return Vec3(0.3, -0.5, 0.8).cross(p); }

/// Normal velocities of a solid-body rotation and, where `convergent`, of a flow into a pole too.
Array<double> sample_flow(const Grid& grid, double convergent) {
  Array<double> normal(at(grid.n_edges()));
  for (std::int64_t e = 0; e < grid.n_edges(); ++e) {
    const Vec3& p = grid.edge_position[at(e)];
    const Vec3 wind = rotation(p) + convergent * Vec3(0, 0, 1);
    normal[at(e)] = remap::edge_normal(grid, e).dot(wind);
  }
  return normal;
}

/// Of a stream function given in space: no divergence but rounding.
Array<double> free_flow(parallel::Executor& exec, const Grid& grid) {
  std::vector<double> psi(at(grid.n_vertices()));
  for (std::size_t v = 0; v < psi.size(); ++v) {
    const Vec3 p = grid.vertex_position[v];
    psi[v] = grid.surface.scale_m() * (p.z() * p.z() + 0.3 * p.x() * p.y() + 0.2 * p.x());
  }
  return remap::flow_of(exec, grid, psi);
}

double root_mean_square(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Divergence against the velocity over the spacing.
double relative_divergence(parallel::Executor& exec, const Grid& grid,
                           std::span<const double> normal) {
  const double spacing_m = grid.cell_distance_m[0];
  return root_mean_square(remap::divergence(exec, grid, normal)) * spacing_m /
         root_mean_square(normal);
}

double transferred_error(const Ellipsoid& surface, int levels) {
  Setting s;
  const Grid a = samples::grid_of(surface, samples::shaken(surface, levels, 0.1, 1));
  const Grid b = samples::grid_of(
      surface, samples::turned(surface, samples::bisected_icosahedron(surface, levels)));
  const remap::Transfer transfer(s.context, remap::Tiling::cells(s.exec, a),
                                 remap::Tiling::cells(s.exec, b));
  const auto vectors = remap::cell_velocities(s.exec, a, sample_flow(a, 0.0));
  const auto moved = remap::transfer_vectors(s.exec, transfer, b, vectors);
  auto normal = remap::normal_velocities(s.exec, b, moved);
  const auto exact = sample_flow(b, 0.0);
  for (std::size_t e = 0; e < normal.size(); ++e) normal[e] -= exact[e];
  return root_mean_square(normal) / root_mean_square(exact);
}

double streamed_error(const Ellipsoid& surface, int levels) {
  Setting s;
  const Grid a = samples::grid_of(surface, samples::shaken(surface, levels, 0.1, 1));
  const Grid b = samples::grid_of(
      surface, samples::turned(surface, samples::bisected_icosahedron(surface, levels)));
  const auto stream = remap::stream_function(s.context, a, free_flow(s.exec, a));
  auto normal =
      remap::flow_of(s.exec, b, remap::transfer_stream_function(s.exec, a, b, stream.psi));
  const auto exact = free_flow(s.exec, b);
  for (std::size_t e = 0; e < normal.size(); ++e) normal[e] -= exact[e];
  return root_mean_square(normal) / root_mean_square(exact);
}

}  // namespace

TEST_CASE("vectors at cells come from normal components and go back to them") {
  Setting s;
  const Ellipsoid surface = Ellipsoid::wgs84();
  const Grid grid = samples::grid_of(surface, samples::shaken(surface, 4, 0.1, 1));
  const auto vectors = remap::cell_velocities(s.exec, grid, sample_flow(grid, 0.2));
  double worst = 0.0;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const Vec3& p = grid.cell_position[i];
    const Vec3 up = surface.normal(p);
    CHECK(std::abs(vectors[i].dot(up)) < 1e-15);
    const Vec3 wind = rotation(p) + Vec3(0, 0, 0.2);
    worst = std::max(worst, (vectors[i] - (wind - up * up.dot(wind))).norm());
  }
  CHECK(worst < 0.03);  // spacing 0.07, edges up to 0.1 spacings off
}

TEST_CASE("a transferred rotation converges and an unchanged grid keeps vectors to the bit") {
  for (const Ellipsoid& surface : {Ellipsoid(), Ellipsoid(Vec3(1.0, 0.95, 0.9), Vec3::Zero())}) {
    const double coarse = transferred_error(surface, 3), fine = transferred_error(surface, 4);
    CAPTURE(coarse);
    CAPTURE(fine);
    CHECK(fine < 0.02);
    CHECK(fine < 0.6 * coarse);
    Setting s;
    const Grid grid = samples::grid_of(surface, samples::shaken(surface, 3, 0.1, 1));
    const remap::Transfer same(s.context, remap::Tiling::cells(s.exec, grid),
                               remap::Tiling::cells(s.exec, grid));
    const auto vectors = remap::cell_velocities(s.exec, grid, sample_flow(grid, 0.2));
    CHECK(remap::transfer_vectors(s.exec, same, grid, vectors) == vectors);
  }
}

TEST_CASE("flow by its stream function has no new divergence and converges") {
  for (const Ellipsoid& surface : {Ellipsoid::sphere(6371220.0), Ellipsoid::wgs84()}) {
    Setting s;
    const Grid a = samples::grid_of(surface, samples::shaken(surface, 4, 0.1, 1));
    const Grid b = samples::grid_of(surface, samples::shaken(surface, 4, 0.1, 2));
    const auto flow = free_flow(s.exec, a);
    CHECK(relative_divergence(s.exec, a, flow) < 1e-12);
    const auto stream = remap::stream_function(s.context, a, flow);
    CHECK(stream.remainder < 1e-12);
    const auto psi = remap::transfer_stream_function(s.exec, a, b, stream.psi);
    CHECK(relative_divergence(s.exec, b, remap::flow_of(s.exec, b, psi)) < 1e-12);
    const double coarse = streamed_error(surface, 3), fine = streamed_error(surface, 4);
    CAPTURE(coarse);
    CAPTURE(fine);
    CHECK(fine < 0.3 * coarse);
  }
}

TEST_CASE("the stream function leaves the divergent part of a flow as remainder") {
  Setting s;
  const Ellipsoid sphere = Ellipsoid::sphere(6371220.0);
  const Grid grid = samples::grid_of(sphere, samples::shaken(sphere, 4, 0.1, 1));
  auto flow = free_flow(s.exec, grid);
  const auto before = remap::stream_function(s.context, grid, flow);
  // A gradient: at right angles to every flow of a stream function, in the sum over dc dv.
  for (std::int64_t e = 0; e < grid.n_edges(); ++e) {
    const auto [c, d] = grid.cells_on_edge[at(e)];
    const double rise = grid.cell_position[at(d)].z() - grid.cell_position[at(c)].z();
    flow[at(e)] += sphere.scale_m() * rise / grid.cell_distance_m[at(e)];
  }
  const auto after = remap::stream_function(s.context, grid, flow);
  CHECK(after.remainder > 0.1);
  const double range = *std::max_element(before.psi.begin(), before.psi.end()) -
                       *std::min_element(before.psi.begin(), before.psi.end());
  double worst = 0.0;
  for (std::size_t v = 0; v < after.psi.size(); ++v) {
    worst = std::max(worst, std::abs(after.psi[v] - before.psi[v]) / range);
  }
  CHECK(worst < 1e-10);
}

TEST_CASE("a grid's own vertices keep their stream function to the bit, on any threads") {
  const Ellipsoid sphere;
  const Grid grid = samples::grid_of(sphere, samples::shaken(sphere, 4, 0.1, 1));
  const Grid other = samples::grid_of(sphere, samples::shaken(sphere, 4, 0.1, 2));
  Setting s;
  const auto psi = remap::stream_function(s.context, grid, sample_flow(grid, 0.3)).psi;
  CHECK(remap::transfer_stream_function(s.exec, grid, grid, psi) == psi);
  const auto moved = remap::transfer_stream_function(s.exec, grid, other, psi);
  for (const int threads : {1, 5}) {
    parallel::Executor exec(threads);
    Context context{exec, s.monitor};
    CHECK(remap::stream_function(context, grid, sample_flow(grid, 0.3)).psi == psi);
    CHECK(remap::transfer_stream_function(exec, grid, other, psi) == moved);
  }
}
