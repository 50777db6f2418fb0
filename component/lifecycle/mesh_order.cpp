// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/mesh_order.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/error.hpp"
#include "domain/order.hpp"
#include "dual/build.hpp"
#include "geometry/point_order.hpp"

namespace delos {
namespace {

constexpr std::int64_t kOrderGrain = 8192;  // vertices or triangles; about 0.1 ms

/// Of the ends of all sides; every side of a closed mesh counts twice.
double mean_id_difference(const Mesh& mesh) {
  std::int64_t sum = 0;
  for (const Triangle& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      sum += std::abs(std::int64_t{triangle.vertex[at(k)]} - triangle.vertex[at(next_corner(k))]);
    }
  }
  return static_cast<double>(sum) / (3.0 * static_cast<double>(mesh.triangles.size()));
}

std::vector<Index> vertices_along_curve(parallel::Executor& exec, const Mesh& mesh) {
  std::vector<Vec3> places(mesh.vertices.size());
  parallel::for_index(exec, mesh.n_vertices(), kOrderGrain,
                      [&](std::int64_t i) { places[at(i)] = mesh.vertices[at(i)].position(); });
  return hilbert_order(exec, places);
}

std::vector<Index> vertices_by_part(Context& context, const Settings& settings, const Mesh& mesh) {
  const Grid grid = build_grid(context, settings.surface, settings.latitude, mesh);
  const domain::Mask all(mesh.vertices.size(), 1);
  return domain::order_cells(context.exec, grid, all, domain::CellOrder::metis,
                             settings.output.order.n_parts);
}

/// Where each old id goes: the inverse of order[new] = old.
std::vector<Index> inverse(parallel::Executor& exec, const std::vector<Index>& order) {
  std::vector<Index> out(order.size());
  parallel::for_index(exec, static_cast<std::int64_t>(order.size()), kOrderGrain,
                      [&](std::int64_t i) { out[at(order[at(i)])] = static_cast<Index>(i); });
  return out;
}

/// Triangles in the order of their lowest vertex: counted, then filled.
std::vector<Index> triangles_by_vertex(const Mesh& mesh) {
  std::vector<Index> first(mesh.vertices.size() + 1, 0);
  const auto lowest = [](const Triangle& triangle) {
    return *std::min_element(triangle.vertex.begin(), triangle.vertex.end());
  };
  for (const Triangle& triangle : mesh.triangles) ++first[at(lowest(triangle)) + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<Index> order(mesh.triangles.size());
  for (Index tri = 0; tri < mesh.n_triangles(); ++tri) {
    order[at(first[at(lowest(mesh.triangle(tri)))]++)] = tri;
  }
  return order;
}

void number_vertices(parallel::Executor& exec, const std::vector<Index>& order, Mesh& mesh) {
  const std::vector<Index> new_id = inverse(exec, order);
  Array<Vertex> vertices(order.size());
  parallel::for_index(exec, mesh.n_vertices(), kOrderGrain,
                      [&](std::int64_t i) { vertices[at(i)] = mesh.vertices[at(order[at(i)])]; });
  mesh.vertices = std::move(vertices);
  parallel::for_index(exec, mesh.n_triangles(), kOrderGrain, [&](std::int64_t i) {
    for (Index& vertex : mesh.triangles[at(i)].vertex) vertex = new_id[at(vertex)];
  });
}

void number_triangles(parallel::Executor& exec, const std::vector<Index>& order, Mesh& mesh) {
  const std::vector<Index> new_id = inverse(exec, order);
  Array<Triangle> triangles(order.size());
  parallel::for_index(exec, mesh.n_triangles(), kOrderGrain, [&](std::int64_t i) {
    Triangle& triangle = triangles[at(i)];
    triangle = mesh.triangles[at(order[at(i)])];
    for (Index& neighbour : triangle.neighbour) neighbour = new_id[at(neighbour)];
  });
  mesh.triangles = std::move(triangles);
}

}  // namespace

void order_mesh(Context& context, const Settings& settings, Mesh& mesh, Report& report) {
  const domain::CellOrder wanted = settings.output.order.kind;
  if (wanted == domain::CellOrder::kept) return;
  DELOS_ASSERT(mesh.fixed.n_vertices() == 0);
  const Phase phase(context.monitor, "order", 0);
  const double before = mean_id_difference(mesh);
  const bool is_curve = wanted == domain::CellOrder::hilbert;
  number_vertices(context.exec,
                  is_curve ? vertices_along_curve(context.exec, mesh)
                           : vertices_by_part(context, settings, mesh),
                  mesh);
  context.monitor.check_cancelled();
  number_triangles(context.exec, triangles_by_vertex(mesh), mesh);
  report.sections.push_back({"order",
                             {{"order", std::string(is_curve ? "hilbert" : "metis")},
                              {"mean_id_difference_before", before},
                              {"mean_id_difference", mean_id_difference(mesh)}}});
}

}  // namespace delos
