// SPDX-License-Identifier: BSD-3-Clause
#include "remap/vectors.hpp"

#include "core/elementary.hpp"
#include "geometry/east_north.hpp"
#include "geometry/tangent_frame.hpp"

namespace delos::remap {
namespace {

constexpr std::int64_t kVectorGrain = 2048;  // about 0.2 ms

// Normals that all point one way (determinant against the square of the trace) fix no vector.
constexpr double kOneWay = 1e-9;

Vec3 fit_cell(const Grid& grid, std::int64_t cell, std::span<const double> normal) {
  const TangentFrame plane(grid.surface.normal(grid.cell_position[at(cell)]));
  double xx = 0.0, xy = 0.0, yy = 0.0, bx = 0.0, by = 0.0;
  for (const Index edge : grid.edges_on_cell.row(cell)) {
    const Vec3 direction = edge_normal(grid, edge);
    const double x = direction.dot(plane.right), y = direction.dot(plane.ahead);
    const double weight = grid.cell_distance_m[at(edge)] * grid.vertex_distance_m[at(edge)];
    xx += weight * x * x;
    xy += weight * x * y;
    yy += weight * y * y;
    bx += weight * x * normal[at(edge)];
    by += weight * y * normal[at(edge)];
  }
  const double det = xx * yy - xy * xy;
  if (!(det > kOneWay * (xx + yy) * (xx + yy))) return Vec3::Zero();
  return ((yy * bx - xy * by) * plane.right + (xx * by - xy * bx) * plane.ahead) / det;
}

}  // namespace

Vec3 edge_normal(const Grid& grid, std::int64_t edge) {
  const EastNorth local(grid.surface.normal(grid.edge_position[at(edge)]));
  const elementary::SinCos angle = elementary::sincos(grid.edge_angle_rad[at(edge)]);
  return angle.cos * local.east + angle.sin * local.north;
}

Array<Vec3> cell_velocities(parallel::Executor& exec, const Grid& grid,
                            std::span<const double> normal) {
  Array<Vec3> result(at(grid.n_cells()));
  parallel::for_index(exec, grid.n_cells(), kVectorGrain,
                      [&](std::int64_t i) { result[at(i)] = fit_cell(grid, i, normal); });
  return result;
}

Array<double> normal_velocities(parallel::Executor& exec, const Grid& grid,
                                std::span<const Vec3> cells) {
  Array<double> result(at(grid.n_edges()));
  parallel::for_index(exec, grid.n_edges(), kVectorGrain, [&](std::int64_t edge) {
    const auto [c, d] = grid.cells_on_edge[at(edge)];
    if (d == kNone) {
      result[at(edge)] = 0.0;  // no flow through a border
      return;
    }
    const bool has_first = cells[at(c)].allFinite(), has_second = cells[at(d)].allFinite();
    // NaN where neither has one.
    const Vec3 sum = has_first == has_second ? Vec3(cells[at(c)] + cells[at(d)])
                                             : 2.0 * cells[at(has_first ? c : d)];
    result[at(edge)] = 0.5 * edge_normal(grid, edge).dot(sum);
  });
  return result;
}

Array<Vec3> transfer_vectors(parallel::Executor& exec, const Transfer& transfer, const Grid& target,
                             std::span<const Vec3> source, const TransferOptions& options) {
  Array<double> from(source.size()), to(at(target.n_cells()));
  Array<Vec3> result(at(target.n_cells()));
  const auto n_sources = static_cast<std::int64_t>(source.size());
  for (int axis = 0; axis < 3; ++axis) {
    parallel::for_index(exec, n_sources, kVectorGrain,
                        [&](std::int64_t j) { from[at(j)] = source[at(j)][axis]; });
    transfer.apply(exec, from, to, options);
    parallel::for_index(exec, target.n_cells(), kVectorGrain,
                        [&](std::int64_t i) { result[at(i)][axis] = to[at(i)]; });
  }
  const Overlaps& overlaps = transfer.overlaps();
  parallel::for_index(exec, target.n_cells(), kVectorGrain, [&](std::int64_t i) {
    if (overlaps.is_copy(i)) return;  // in its plane already, and the same to the bit
    const Vec3 up = target.surface.normal(target.cell_position[at(i)]);
    result[at(i)] -= up * up.dot(result[at(i)]);
  });
  return result;
}

Array<double> divergence(parallel::Executor& exec, const Grid& grid,
                         std::span<const double> normal) {
  Array<double> result(at(grid.n_cells()));
  parallel::for_index(exec, grid.n_cells(), kVectorGrain, [&](std::int64_t i) {
    double outflow = 0.0;
    for (const Index edge : grid.edges_on_cell.row(i)) {
      const double flux = normal[at(edge)] * grid.vertex_distance_m[at(edge)];
      outflow += grid.cells_on_edge[at(edge)][0] == i ? flux : -flux;
    }
    result[at(i)] = outflow / grid.cell_area_m2[at(i)];
  });
  return result;
}

}  // namespace delos::remap
