// SPDX-License-Identifier: BSD-3-Clause
#include "domain/transects.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "geometry/predicates.hpp"

namespace delos::domain {
namespace {

constexpr double kStep = 0.25;  // of the distance to a neighbour

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

// Whether the arcs ab and pq meet, each shorter than a quarter of a turn. Touching counts.
bool do_meet(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
  using predicates::orient_origin;
  return orient_origin(a, b, p) * orient_origin(a, b, q) <= 0 &&
         orient_origin(p, q, a) * orient_origin(p, q, b) <= 0 && (a + b).dot(p + q) > 0.0;
}

std::vector<Index> way_back(const std::map<Index, Index>& came_from, Index end) {
  std::vector<Index> way;
  for (Index cell = end; came_from.at(cell) != kNone; cell = came_from.at(cell)) {
    way.push_back(cell);
  }
  std::reverse(way.begin(), way.end());
  return way;
}

// For a chain that is shut from end to end: the way between open cells next to its ends, or the
// chain itself.
std::vector<Index> beside(const Grid& grid, const std::vector<Index>& chain,
                          const CellTest& is_open) {
  const auto open_beside = [&](Index cell) {
    const auto row = grid.cells_on_cell.row(cell);
    const auto found = std::find_if(row.begin(), row.end(), is_open);
    return found == row.end() ? kNone : *found;
  };
  const Index from = open_beside(chain.front()), to = open_beside(chain.back());
  if (from == kNone || to == kNone) return chain;
  std::vector<Index> out{from};
  if (from == to) return out;
  const auto way = shortest_way(
      grid, out, [&](Index cell) { return cell == to; }, is_open, 2 * chain.size() + 4);
  if (!way) return chain;
  out.insert(out.end(), way->begin(), way->end());
  return out;
}

}  // namespace

std::vector<Link> links_across(const Grid& grid, const LonLatLine& line,
                               const std::vector<Index>& chain) {
  // A link stays in its two cells, and the line in its chain, but for corners that it clips.
  std::vector<Index> near = chain;
  for (const Index cell : chain) {
    const auto row = grid.cells_on_cell.row(cell);
    near.insert(near.end(), row.begin(), row.end());
  }
  std::vector<Link> links;
  for (const Index cell : near) {
    for (const Index other : grid.cells_on_cell.row(cell)) {
      links.push_back({std::min(cell, other), std::max(cell, other)});
    }
  }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  const auto is_apart = [&](const Link& link) {
    const Vec3 &a = grid.cell_position[at(link[0])], &b = grid.cell_position[at(link[1])];
    for (std::size_t i = 0; i + 1 < line.lon_deg.size(); ++i) {
      if (do_meet(a, b, point_of(grid, line, i), point_of(grid, line, i + 1))) return false;
    }
    return true;
  };
  links.erase(std::remove_if(links.begin(), links.end(), is_apart), links.end());
  return links;
}

std::optional<std::vector<Index>> shortest_way(const Grid& grid, const std::vector<Index>& from,
                                               const CellTest& is_goal, const CellTest& is_open,
                                               std::size_t most) {
  std::map<Index, Index> came_from;
  for (const Index cell : from) came_from[cell] = kNone;
  std::vector<Index> front = from, next;
  for (std::size_t step = 0; step <= most && !front.empty(); ++step) {
    for (const Index cell : front) {
      for (const Index neighbour : grid.cells_on_cell.row(cell)) {
        if (neighbour == kNone || came_from.count(neighbour) > 0) continue;
        const bool is_end = is_goal(neighbour);
        if (!is_end && !is_open(neighbour)) continue;
        came_from[neighbour] = cell;
        if (is_end) return way_back(came_from, neighbour);
        next.push_back(neighbour);
      }
    }
    front.swap(next);
    next.clear();
  }
  return std::nullopt;
}

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

std::vector<Index> led_around(const Grid& grid, const std::vector<Index>& chain, const Mask& shut,
                              const Mask& sea) {
  const auto is_shut = [&](Index cell) { return shut[at(cell)] != 0; };
  const auto is_open = [&](Index cell) { return !is_shut(cell) && sea[at(cell)] != 0; };
  const auto first = std::find_if_not(chain.begin(), chain.end(), is_shut);
  if (first == chain.end()) return beside(grid, chain, is_open);
  std::vector<Index> out;
  for (auto cell = first; cell != chain.end();) {
    if (!is_shut(*cell)) {
      out.push_back(*cell++);
      continue;
    }
    const auto behind = std::find_if_not(cell, chain.end(), is_shut);
    if (behind == chain.end()) break;
    const auto n_shut = static_cast<std::size_t>(behind - cell);
    const auto way = shortest_way(
        grid, {out.back()}, [&](Index next) { return next == *behind; }, is_open, 2 * n_shut + 4);
    if (way) {
      out.insert(out.end(), way->begin(), way->end() - 1);
    } else {
      out.insert(out.end(), cell, behind);
    }
    cell = behind;
  }
  return out;
}

}  // namespace delos::domain
