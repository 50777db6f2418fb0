// SPDX-License-Identifier: BSD-3-Clause
#include "domain/transects.hpp"

#include <algorithm>
#include <cmath>

namespace delos::domain {
namespace {

constexpr double kStep = 0.25;  // of the distance to a neighbour

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

double square_to(const Grid& grid, Index cell, const Vec3& point) {
  return (grid.cell_position[at(cell)] - point).squaredNorm();
}

// From `start` to the cell of the point, always to the neighbour nearest to it; visit(cell) for
// each cell entered. On a Voronoi diagram a cell without a nearer neighbour is the nearest of all.
template <class Visit>
Index walk(const Grid& grid, const Vec3& point, Index start, Visit&& visit) {
  Index here = start;
  double nearest = square_to(grid, here, point);
  while (true) {
    Index next = here;
    for (const Index neighbour : grid.cells_on_cell.row(here)) {
      if (neighbour == kNone) continue;
      const double square = square_to(grid, neighbour, point);
      if (square >= nearest) continue;
      nearest = square;
      next = neighbour;
    }
    if (next == here) return here;
    here = next;
    visit(here);
  }
}

Vec3 point_of(const Grid& grid, const LonLatLine& line, std::size_t i) {
  return grid.surface.point({line.lon_deg[i] * kRadPerDeg, line.lat_deg[i] * kRadPerDeg},
                            grid.latitude);
}

double width_at(const Grid& grid, Index cell) {
  double width = 1.0;  // the radius; a cell without neighbours is stepped over
  for (const Index neighbour : grid.cells_on_cell.row(cell)) {
    if (neighbour == kNone) continue;
    width =
        std::min(width, (grid.cell_position[at(neighbour)] - grid.cell_position[at(cell)]).norm());
  }
  return width;
}

}  // namespace

Index cell_at(const Grid& grid, const Vec3& point) {
  constexpr std::int64_t kSpread = 512;
  const std::int64_t stride = std::max<std::int64_t>(1, grid.n_cells() / kSpread);
  Index start = 0;
  for (std::int64_t cell = 0; cell < grid.n_cells(); cell += stride) {
    if (square_to(grid, static_cast<Index>(cell), point) < square_to(grid, start, point)) {
      start = static_cast<Index>(cell);
    }
  }
  return walk(grid, point, start, [](Index) {});
}

std::vector<Index> cells_along(const Grid& grid, const LonLatLine& line) {
  std::vector<Index> cells;
  if (line.lon_deg.empty()) return cells;
  Vec3 from = point_of(grid, line, 0);
  Index here = cell_at(grid, from);
  cells.push_back(here);
  const auto enter = [&](Index cell) { cells.push_back(cell); };
  for (std::size_t i = 1; i < line.lon_deg.size(); ++i) {
    const Vec3 to = point_of(grid, line, i);
    double done = 0.0;  // of the chord, which the surface is projected from
    while (done < 1.0) {
      const double chord = (to - from).norm();
      done = chord > 0.0 ? std::min(1.0, done + kStep * width_at(grid, here) / chord) : 1.0;
      here = walk(grid, grid.surface.project(from + done * (to - from)), here, enter);
    }
    from = to;
  }
  // A line may come back to a cell.
  std::vector<Index> once;
  for (const Index cell : cells) {
    if (std::find(once.begin(), once.end(), cell) == once.end()) once.push_back(cell);
  }
  return once;
}

}  // namespace delos::domain
