// SPDX-License-Identifier: BSD-3-Clause
#include "io/mpas_diagnostics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "core/elementary.hpp"

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

/// What the three plane angles of a triangle are told by.
struct Corners {
  bool exist = false;       // none is missing
  double twice_area = 0.0;  // the sine of each angle times its sides
  Extent cosine;            // the cosine of each times its sides
};

Corners corners_of_triangle(const Grid& grid, std::int64_t vertex) {
  const auto& cells = grid.cells_on_vertex[at(vertex)];
  if (std::find(cells.begin(), cells.end(), kNone) != cells.end()) return {};
  const Vec3 &a = grid.cell_position[at(cells[0])], &b = grid.cell_position[at(cells[1])],
             &c = grid.cell_position[at(cells[2])];
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  Corners corners{true, ab.cross(bc).norm(), {}};
  corners.cosine.max = -std::numeric_limits<double>::infinity();
  for (const double cosine : {-ca.dot(ab), -ab.dot(bc), -bc.dot(ca)}) {
    corners.cosine.include(cosine);
  }
  return corners;
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
  const Corners corners = corners_of_triangle(grid, vertex);
  if (!corners.exist) return 0.0;
  // Of equal sines times sides the greater cosine times sides has the smaller angle.
  const double smallest = elementary::atan2(corners.twice_area, corners.cosine.max);
  const double largest = elementary::atan2(corners.twice_area, corners.cosine.min);
  return largest > 0.0 ? smallest / largest : 0.0;
}

bool is_obtuse(const Grid& grid, std::int64_t vertex) {
  const Corners corners = corners_of_triangle(grid, vertex);
  return corners.exist && corners.cosine.min < 0.0;
}

}  // namespace delos::mpas
