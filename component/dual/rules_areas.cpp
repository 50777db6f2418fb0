// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>

#include "dual/rules.hpp"

namespace delos::dual {
namespace {

double kite_error(const Grid& g, std::int64_t i) {
  const double square_metres = g.surface.scale_m() * g.surface.scale_m();
  const Vec3& v = g.vertex_position[at(i)];
  double error = 0.0;
  for (std::size_t j = 0; j < 3; ++j) {
    if (g.cells_on_vertex[at(i)][j] == kNone) {
      error = worse(error, std::abs(g.kite_area_m2[at(i)][j]));
      continue;
    }
    const Vec3& cell = g.cell_position[at(g.cells_on_vertex[at(i)][j])];
    const Vec3& before = g.edge_position[at(g.edges_on_vertex[at(i)][j])];
    const Vec3& after = g.edge_position[at(g.edges_on_vertex[at(i)][(j + 1) % 3])];
    const double kite = square_metres * (g.surface.triangle_area(v, before, cell) +
                                         g.surface.triangle_area(v, cell, after));
    error = worse(error, std::abs(g.kite_area_m2[at(i)][j] - kite));
  }
  return error / g.triangle_area_m2[at(i)];
}

bool kites_are_positive(const Grid& g, std::int64_t i) {
  for (std::size_t j = 0; j < 3; ++j) {
    if (g.cells_on_vertex[at(i)][j] != kNone && !(g.kite_area_m2[at(i)][j] > 0.0)) return false;
  }
  return true;
}

bool lies_inside(const Grid& g, std::int64_t i) {
  if (!is_complete(g.cells_on_vertex[at(i)])) return true;  // of no triangle
  const Vec3& v = g.vertex_position[at(i)];
  for (std::size_t j = 0; j < 3; ++j) {
    const Vec3& a = g.cell_position[at(g.cells_on_vertex[at(i)][j])];
    const Vec3& b = g.cell_position[at(g.cells_on_vertex[at(i)][(j + 1) % 3])];
    if (!(v.dot((a - v).cross(b - v)) > 0.0)) return false;
  }
  return true;
}

double kite_on_cell(const Grid& g, std::int64_t cell, Index vertex) {
  const auto& cells = g.cells_on_vertex[at(vertex)];
  const auto corner = std::find(cells.begin(), cells.end(), static_cast<Index>(cell));
  return corner == cells.end() ? 0.0 : g.kite_area_m2[at(vertex)][at(corner - cells.begin())];
}

double polygon_error(const Grid& g, std::int64_t i) {
  const auto vertices = g.vertices_on_cell.row(i);
  double area = 0.0;
  for (std::size_t j = 0; j < vertices.size(); ++j) {
    area += g.surface.triangle_area(g.cell_position[at(i)], g.vertex_position[at(vertices[j])],
                                    g.vertex_position[at(vertices[(j + 1) % vertices.size()])]);
  }
  area *= g.surface.scale_m() * g.surface.scale_m();
  return std::abs(g.cell_area_m2[at(i)] / area - 1.0);
}

}  // namespace

void check_areas(Context& context, const Grid& g, double tolerance, Rules& rules) {
  rules.check("kites are positive", g.n_vertices(), 0.0,
              [&](std::int64_t i) { return unless(kites_are_positive(g, i)); });
  rules.check("a vertex lies inside its triangle (well centred)", g.n_vertices(), 0.0,
              [&](std::int64_t i) { return unless(lies_inside(g, i)); });
  rules.check("a kite is the area between vertex, edges and cell", g.n_vertices(), tolerance,
              [&](std::int64_t i) { return kite_error(g, i); });
  rules.check("the kites of a vertex sum to its triangle", g.n_vertices(), tolerance,
              [&](std::int64_t i) {
                const auto& kites = g.kite_area_m2[at(i)];
                return std::abs((kites[0] + kites[1] + kites[2]) / g.triangle_area_m2[at(i)] - 1.0);
              });
  rules.check("the kites of a cell sum to its area", g.n_cells(), tolerance, [&](std::int64_t i) {
    double sum = 0.0;
    for (const Index vertex : g.vertices_on_cell.row(i)) sum += kite_on_cell(g, i, vertex);
    return std::abs(sum / g.cell_area_m2[at(i)] - 1.0);
  });
  rules.check("the area of a cell is that of its polygon", g.n_cells(), tolerance,
              [&](std::int64_t i) { return polygon_error(g, i); });
  if (!is_closed(g)) return;
  const double whole = g.surface.area() * g.surface.scale_m() * g.surface.scale_m();
  const auto total = [&](std::span<const double> areas) {
    return parallel::sum(context.exec, static_cast<std::int64_t>(areas.size()), Rules::kGrain,
                         [&](std::int64_t i) { return areas[at(i)]; });
  };
  rules.check("cells sum to the surface", 1, tolerance,
              [&](std::int64_t) { return std::abs(total(g.cell_area_m2) / whole - 1.0); });
  rules.check("triangles sum to the surface", 1, tolerance,
              [&](std::int64_t) { return std::abs(total(g.triangle_area_m2) / whole - 1.0); });
}

}  // namespace delos::dual
