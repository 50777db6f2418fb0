// SPDX-License-Identifier: BSD-3-Clause
#include "io/mpas_diagnostics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace delos::mpas {
namespace {

// Smallest and largest of what was seen.
struct Extent {
  double min = std::numeric_limits<double>::infinity(), max = 0.0;
  void include(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
  }
  double ratio() const { return max > 0.0 ? min / max : 0.0; }
};

Extent dual_edges_of_cell(const Grid& grid, std::int64_t cell) {
  Extent range;
  for (const Index edge : grid.edges_on_cell.row(cell)) {
    range.include(grid.vertex_distance_m[at(edge)]);
  }
  return range;
}

Extent sides_of_triangle(const Grid& grid, std::int64_t vertex) {
  Extent range;
  for (const Index edge : grid.edges_on_vertex[at(vertex)]) {
    if (edge != kNone) range.include(grid.cell_distance_m[at(edge)]);
  }
  return range;
}

// Plane angles in radians; nothing is seen when a corner is missing.
Extent angles_of_triangle(const Grid& grid, std::int64_t vertex) {
  Extent range;
  const auto& cells = grid.cells_on_vertex[at(vertex)];
  if (std::find(cells.begin(), cells.end(), kNone) != cells.end()) return range;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& corner = grid.cell_position[at(cells[k])];
    const Vec3 u = grid.cell_position[at(cells[(k + 1) % 3])] - corner;
    const Vec3 v = grid.cell_position[at(cells[(k + 2) % 3])] - corner;
    range.include(std::atan2(u.cross(v).norm(), u.dot(v)));
  }
  return range;
}

}  // namespace

double cell_quality(const Grid& grid, std::int64_t cell) {
  return dual_edges_of_cell(grid, cell).ratio();
}

double mean_distance_m(const Grid& grid, std::int64_t cell) {
  const auto edges = grid.edges_on_cell.row(cell);
  double sum = 0.0;
  for (const Index edge : edges) sum += grid.cell_distance_m[at(edge)];
  return edges.empty() ? 0.0 : sum / static_cast<double>(edges.size());
}

double triangle_quality(const Grid& grid, std::int64_t vertex) {
  return sides_of_triangle(grid, vertex).ratio();
}

double triangle_angle_quality(const Grid& grid, std::int64_t vertex) {
  return angles_of_triangle(grid, vertex).ratio();
}

bool is_obtuse(const Grid& grid, std::int64_t vertex) {
  return angles_of_triangle(grid, vertex).max > 0.5 * kPi;
}

}  // namespace delos::mpas
