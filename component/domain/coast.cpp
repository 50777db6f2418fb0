// SPDX-License-Identifier: BSD-3-Clause
#include "domain/coast.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/elementary.hpp"

namespace delos::domain {
namespace {

constexpr std::int64_t kCoastGrain = 4096;  // edges; tenths of a millisecond

// An edge of the coast, from vertex to vertex with the sea on its left.
struct Shoreline {
  Index from, to;
};

bool is_coast(const Grid& grid, const Mask& sea, std::int64_t edge) {
  const auto [a, b] = grid.cells_on_edge[at(edge)];
  return sea[at(a)] != sea[at(b)];
}

std::vector<Shoreline> shorelines(parallel::Executor& exec, const Grid& grid, const Mask& sea) {
  return parallel::collect<Shoreline>(
      exec, grid.n_edges(), kCoastGrain, [&](std::int64_t begin, std::int64_t end, auto& found) {
        for (std::int64_t edge = begin; edge < end; ++edge) {
          if (!is_coast(grid, sea, edge)) continue;
          // The normal points from cell [0] to [1], and vertex [1] is on its left.
          const auto [right, left] = grid.vertices_on_edge[at(edge)];
          const bool is_outward = sea[at(grid.cells_on_edge[at(edge)][0])] != 0;
          found.push_back(is_outward ? Shoreline{right, left} : Shoreline{left, right});
        }
      });
}

// Where the line passes between a sea cell and one that is not. Where passages and the like
// overrule the wet shares, it passes in the middle.
Vec3 crossing(const Grid& grid, const Array<double>& wet, double least_wet, Index inside,
              Index outside) {
  const double a = wet[at(inside)], b = wet[at(outside)];
  const double t = a >= least_wet && b < least_wet ? (a - least_wet) / (a - b) : 0.5;
  const Vec3 &p = grid.cell_position[at(inside)], &q = grid.cell_position[at(outside)];
  return p + t * (q - p);
}

// The line's piece in the triangle of a vertex on the coast.
double line_at(const Grid& grid, const Mask& sea, const Array<double>& wet, double least_wet,
               Index vertex) {
  std::array<Vec3, 3> ends;
  std::size_t n = 0;
  const auto& cells = grid.cells_on_vertex[at(vertex)];
  for (std::size_t j = 0; j < 3; ++j) {
    const Index a = cells[j], b = cells[(j + 1) % 3];
    if (sea[at(a)] == sea[at(b)]) continue;
    ends[n++] = sea[at(a)] != 0 ? crossing(grid, wet, least_wet, a, b)
                                : crossing(grid, wet, least_wet, b, a);
  }
  return n == 2 ? (ends[1] - ends[0]).norm() : 0.0;
}

// What lies on the wrong side of the coast, of the cells on both its sides.
double misplaced_m2(parallel::Executor& exec, const Grid& grid, const Mask& sea,
                    const Array<double>& wet) {
  return parallel::sum(exec, grid.n_cells(), kCoastGrain, [&](std::int64_t cell) {
    const auto row = grid.cells_on_cell.row(cell);
    const bool is_sea = sea[at(cell)] != 0;
    const bool is_beside = std::any_of(
        row.begin(), row.end(), [&](Index other) { return (sea[at(other)] != 0) != is_sea; });
    if (!is_beside) return 0.0;
    return (is_sea ? 1.0 - wet[at(cell)] : wet[at(cell)]) * grid.cell_area_m2[at(cell)];
  });
}

// Left is positive.
double turn_rad(const Grid& grid, const Shoreline& a, const Shoreline& b) {
  const Vec3& corner = grid.vertex_position[at(a.to)];
  const Vec3 before = corner - grid.vertex_position[at(a.from)];
  const Vec3 after = grid.vertex_position[at(b.to)] - corner;
  return elementary::atan2(before.cross(after).dot(corner) / corner.norm(), before.dot(after));
}

double height_over_chord(const Grid& grid, Index before, Index corner, Index after) {
  const Vec3& from = grid.vertex_position[at(before)];
  const Vec3 chord = grid.vertex_position[at(after)] - from;
  return (grid.vertex_position[at(corner)] - from).cross(chord).norm() / chord.norm();
}

// The corners of all loops, one loop after the other.
struct Loops {
  std::vector<double> turn_rad;    // at the end of each edge
  std::vector<Index> corner;       // the vertex there
  std::vector<double> height;      // of the corner over the chord of those beside it
  std::vector<std::size_t> first;  // corner of each loop, and the end
};

Loops walk_loops(const Grid& grid, const std::vector<Shoreline>& lines) {
  // A vertex of the coast has one edge that comes and one that goes.
  std::vector<std::pair<Index, std::size_t>> begins(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) begins[i] = {lines[i].from, i};
  std::sort(begins.begin(), begins.end());
  const auto after = [&](std::size_t i) {
    return std::lower_bound(begins.begin(), begins.end(), std::pair(lines[i].to, std::size_t{0}))
        ->second;
  };
  Loops loops;
  std::vector<char> is_done(lines.size(), 0);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_done[i] != 0) continue;
    loops.first.push_back(loops.corner.size());
    for (std::size_t here = i; is_done[here] == 0; here = after(here)) {
      is_done[here] = 1;
      loops.turn_rad.push_back(turn_rad(grid, lines[here], lines[after(here)]));
      loops.corner.push_back(lines[here].to);
      loops.height.push_back(
          height_over_chord(grid, lines[here].from, lines[here].to, lines[after(here)].to));
    }
  }
  loops.first.push_back(loops.corner.size());
  return loops;
}

// Stairs and tips of the loop whose turns these are.
void judge_loop(std::span<const double> turn, CoastReport& report, std::int64_t& n_stairs) {
  constexpr double kTipRad = 150.0 * kRadPerDeg;  // three corners of hexagons are 180
  const std::size_t n = turn.size();
  const auto is_left = [&](std::size_t i) { return turn[i % n] > 0.0; };
  // From the start of a run, so that none is cut in two.
  std::size_t start = 0;
  while (start < n && is_left(start) == is_left(start + n - 1)) ++start;
  if (start == n) {  // an island or a pond of one cell
    ++(is_left(0) ? report.n_sea_tips : report.n_land_tips);
    return;
  }
  for (std::size_t i = start; i < start + n;) {
    std::size_t end = i;
    double sum_rad = 0.0;
    for (; end < start + n && is_left(end) == is_left(i); ++end) sum_rad += turn[end % n];
    n_stairs += end == i + 1;
    if (std::abs(sum_rad) > kTipRad) ++(is_left(i) ? report.n_sea_tips : report.n_land_tips);
    i = end;
  }
}

void judge_corners(const Grid& grid, const Loops& loops, CoastReport& report) {
  double sum_rad = 0.0, sum_height = 0.0;
  std::int64_t n_stairs = 0;
  for (std::size_t i = 0; i < loops.corner.size(); ++i) {
    sum_rad += std::abs(loops.turn_rad[i]);
    sum_height += loops.height[i];
    const Corner corner{180.0 - loops.turn_rad[i] * kDegPerRad,
                        grid.vertex_lon_lat[at(loops.corner[i])]};
    if (corner.angle_deg < report.sharpest_sea.angle_deg) report.sharpest_sea = corner;
    if (corner.angle_deg > report.sharpest_land.angle_deg) report.sharpest_land = corner;
  }
  for (std::size_t i = 0; i + 1 < loops.first.size(); ++i) {
    judge_loop(
        std::span(loops.turn_rad).subspan(loops.first[i], loops.first[i + 1] - loops.first[i]),
        report, n_stairs);
  }
  const auto n = static_cast<double>(loops.corner.size());
  report.mean_turn_deg = sum_rad / n * kDegPerRad;
  report.step_m = sum_height / n * grid.surface.scale_m();
  report.stair_share = static_cast<double>(n_stairs) / n;
}

}  // namespace

CoastReport measure_coast(parallel::Executor& exec, const Grid& grid, const Mask& sea,
                          const Array<double>& wet_fraction, double least_wet) {
  CoastReport report;
  const std::vector<Shoreline> lines = shorelines(exec, grid, sea);
  if (lines.empty()) return report;
  report.n_edges = static_cast<std::int64_t>(lines.size());
  double length = 0.0, line = 0.0;
  for (const Shoreline& edge : lines) {
    length += (grid.vertex_position[at(edge.to)] - grid.vertex_position[at(edge.from)]).norm();
    line += line_at(grid, sea, wet_fraction, least_wet, edge.to);
  }
  report.length_m = length * grid.surface.scale_m();
  report.line_m = line * grid.surface.scale_m();
  report.offset_m = misplaced_m2(exec, grid, sea, wet_fraction) / report.length_m;
  judge_corners(grid, walk_loops(grid, lines), report);
  return report;
}

}  // namespace delos::domain
