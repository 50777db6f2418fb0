// SPDX-License-Identifier: BSD-3-Clause
#include "dual/validate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"
#include "core/hash.hpp"
#include "dual/edge_angles.hpp"
#include "dual/rules.hpp"

namespace delos {
namespace {

using dual::Rules;

constexpr std::int64_t kGrain = Rules::kGrain;
// The energy-conserving antisymmetry of the weights is exact but for rounding.
constexpr double kAntisymmetry = 1e-12;
// A coarser tolerance than this means a grid of someone else, weights rounded likewise.
constexpr double kOwnTolerance = 1e-8;

double unless(bool holds) { return holds ? 0.0 : 1.0; }

// The larger error; a NaN is the largest.
double worse(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

// ------------------------------------------------------------------ sizes and ids

template <class T>
bool is_table(const Ragged<T>& table, std::int64_t n_rows) {
  const auto positions = table.offsets.positions();
  return table.offsets.n_rows() == n_rows && !positions.empty() && positions[0] == 0 &&
         std::is_sorted(positions.begin(), positions.end()) &&
         table.offsets.n_values() == static_cast<std::int64_t>(table.values.size());
}

bool has_sizes(const Grid& g) {
  const auto cells = at(g.n_cells()), edges = at(g.n_edges()), vertices = at(g.n_vertices());
  const bool on_cells = g.cell_lon_lat.size() == cells && g.cell_area_m2.size() == cells &&
                        is_table(g.edges_on_cell, g.n_cells()) &&
                        g.vertices_on_cell.offsets == g.edges_on_cell.offsets &&
                        g.cells_on_cell.offsets == g.edges_on_cell.offsets &&
                        g.vertices_on_cell.values.size() == g.edges_on_cell.values.size() &&
                        g.cells_on_cell.values.size() == g.edges_on_cell.values.size();
  const bool on_edges = g.edge_position.size() == edges && g.edge_lon_lat.size() == edges &&
                        g.vertices_on_edge.size() == edges && g.cell_distance_m.size() == edges &&
                        g.vertex_distance_m.size() == edges && g.edge_angle_rad.size() == edges &&
                        is_table(g.edges_on_edge, g.n_edges()) &&
                        g.weights_on_edge.offsets == g.edges_on_edge.offsets &&
                        g.weights_on_edge.values.size() == g.edges_on_edge.values.size();
  const bool on_vertices =
      g.vertex_lon_lat.size() == vertices && g.cells_on_vertex.size() == vertices &&
      g.edges_on_vertex.size() == vertices && g.triangle_area_m2.size() == vertices &&
      g.kite_area_m2.size() == vertices;
  return on_cells && on_edges && on_vertices;
}

template <class Row>
bool in_range(const Row& ids, std::int64_t n) {
  return std::all_of(ids.begin(), ids.end(), [&](Index id) { return id >= 0 && id < n; });
}

// The same where a grid with a border has kNone.
template <class Row>
bool in_range_or_none(const Row& ids, std::int64_t n) {
  return std::all_of(ids.begin(), ids.end(), [&](Index id) { return id >= kNone && id < n; });
}

template <class Row>
bool is_complete(const Row& ids) {
  return std::find(ids.begin(), ids.end(), kNone) == ids.end();
}

// A vertex has a cell, and those edges that lie beside a cell.
bool borders_agree(const std::array<Index, 3>& cells, const std::array<Index, 3>& edges) {
  bool agree = cells[0] != kNone || cells[1] != kNone || cells[2] != kNone;
  for (std::size_t j = 0; j < 3; ++j) {
    const bool has_cell = cells[j] != kNone || cells[(j + 2) % 3] != kNone;
    agree = agree && has_cell == (edges[j] != kNone);
  }
  return agree;
}

void check_ids(const Grid& g, Rules& rules) {
  rules.check("ids on cells are in range and a cell has at least three edges", g.n_cells(), 0.0,
              [&](std::int64_t i) {
                return unless(g.edges_on_cell.row(i).size() >= 3 &&
                              in_range(g.edges_on_cell.row(i), g.n_edges()) &&
                              in_range(g.vertices_on_cell.row(i), g.n_vertices()) &&
                              in_range_or_none(g.cells_on_cell.row(i), g.n_cells()));
              });
  rules.check("ids on edges are in range", g.n_edges(), 0.0, [&](std::int64_t i) {
    const auto [first, second] = g.cells_on_edge[at(i)];
    return unless(first >= 0 && in_range_or_none(std::array{first, second}, g.n_cells()) &&
                  in_range(g.vertices_on_edge[at(i)], g.n_vertices()) &&
                  in_range(g.edges_on_edge.row(i), g.n_edges()));
  });
  rules.check("ids on vertices are in range", g.n_vertices(), 0.0, [&](std::int64_t i) {
    return unless(in_range_or_none(g.cells_on_vertex[at(i)], g.n_cells()) &&
                  in_range_or_none(g.edges_on_vertex[at(i)], g.n_edges()) &&
                  borders_agree(g.cells_on_vertex[at(i)], g.edges_on_vertex[at(i)]));
  });
}

// ------------------------------------------------------------------ order of the lists

bool cell_lists_agree(const Grid& g, std::int64_t i) {
  const auto edges = g.edges_on_cell.row(i);
  const auto vertices = g.vertices_on_cell.row(i);
  const auto cells = g.cells_on_cell.row(i);
  for (std::size_t j = 0; j < edges.size(); ++j) {
    const auto& ends = g.cells_on_edge[at(edges[j])];
    const std::size_t side = ends[0] == i ? 0 : 1;
    const auto& through = g.vertices_on_edge[at(edges[j])];
    const Index before = vertices[j == 0 ? vertices.size() - 1 : j - 1];
    if (ends[side] != i || ends[1 - side] != cells[j]) return false;
    if (through[side] != before || through[1 - side] != vertices[j]) return false;
  }
  return true;
}

bool vertex_lists_agree(const Grid& g, std::int64_t i) {
  const auto& cells = g.cells_on_vertex[at(i)];
  const auto& edges = g.edges_on_vertex[at(i)];
  for (std::size_t j = 0; j < 3; ++j) {
    if (edges[j] == kNone) continue;
    const auto& ends = g.cells_on_edge[at(edges[j])];
    const auto& through = g.vertices_on_edge[at(edges[j])];
    const std::size_t side = ends[0] == cells[j] ? 0 : 1;
    if (ends[side] != cells[j] || ends[1 - side] != cells[(j + 2) % 3]) return false;
    if (through[0] != i && through[1] != i) return false;
  }
  return true;
}

// First the edges of cell [0] after this one, counter-clockwise, then those of cell [1].
bool edge_list_agrees(const Grid& g, std::int64_t i) {
  const auto row = g.edges_on_edge.row(i);
  std::size_t next = 0;
  for (const Index cell : g.cells_on_edge[at(i)]) {
    if (cell == kNone) continue;
    const auto around = g.edges_on_cell.row(cell);
    const auto here = std::find(around.begin(), around.end(), static_cast<Index>(i));
    if (here == around.end()) return false;
    const auto start = static_cast<std::size_t>(here - around.begin());
    for (std::size_t step = 1; step < around.size(); ++step) {
      if (next == row.size() || row[next++] != around[(start + step) % around.size()]) return false;
    }
  }
  return next == row.size();
}

void check_order(const Grid& g, Rules& rules) {
  rules.check("the lists of a cell agree (edge j from vertex j-1 to j, cell j across it)",
              g.n_cells(), 0.0, [&](std::int64_t i) { return unless(cell_lists_agree(g, i)); });
  rules.check("the lists of a vertex agree (cell j between edges j and j+1)", g.n_vertices(), 0.0,
              [&](std::int64_t i) { return unless(vertex_lists_agree(g, i)); });
  rules.check("an edge runs from its lower to its higher cell", g.n_edges(), 0.0,
              [&](std::int64_t i) {
                const auto [first, second] = g.cells_on_edge[at(i)];
                return unless(second == kNone || first < second);
              });
  rules.check("edges on edges run around the first cell, then the second", g.n_edges(), 0.0,
              [&](std::int64_t i) { return unless(edge_list_agrees(g, i)); });
}

// ------------------------------------------------------------------ positions

void check_positions(const Grid& g, const char* rule, std::span<const Vec3> positions,
                     std::span<const LonLat> lon_lat, Rules& rules) {
  // Coordinates are stored to rounding, however coarse the lengths of a file are.
  constexpr double kCoordinate = 1e-11;
  rules.check(rule, static_cast<std::int64_t>(positions.size()), kCoordinate, [&](std::int64_t i) {
    const LonLat& place = lon_lat[at(i)];
    if (!(place.lon_rad >= 0.0 && place.lon_rad < 2.0 * kPi)) return 1.0;
    const Vec3& p = positions[at(i)];
    return worse((g.surface.project(p) - p).norm(),
                 (g.surface.point(place, g.latitude) - p).norm());
  });
}

// The three distances from a vertex to its cells, relative.
double radius_spread(const Grid& g, std::int64_t i) {
  double low = 1e300, high = 0.0;
  for (const Index cell : g.cells_on_vertex[at(i)]) {
    if (cell == kNone) continue;
    const double r = (g.cell_position[at(cell)] - g.vertex_position[at(i)]).norm();
    low = std::min(low, r);
    high = std::max(high, r);
  }
  return (high - low) / high;
}

bool is_border(const Grid& g, std::int64_t edge) { return g.cells_on_edge[at(edge)][1] == kNone; }

// From cell [0] to cell [1]; at a border where that would be, twice as far as the edge.
Vec3 across_edge(const Grid& g, std::int64_t i) {
  const auto [c, d] = g.cells_on_edge[at(i)];
  const Vec3& from = g.cell_position[at(c)];
  return d == kNone ? Vec3(2.0 * (g.edge_position[at(i)] - from))
                    : Vec3(g.cell_position[at(d)] - from);
}

Vec3 along_edge(const Grid& g, std::int64_t i) {
  const auto [v, w] = g.vertices_on_edge[at(i)];
  return g.vertex_position[at(w)] - g.vertex_position[at(v)];
}

// How far the edge position is off the two planes, against the lengths of the edge. At a border
// the plane of the cells is not known.
double crossing_error(const Grid& g, std::int64_t i) {
  const Vec3& e = g.edge_position[at(i)];
  const auto off_plane = [&](const Vec3& a, const Vec3& ab) {
    const Vec3 normal = a.cross(ab);
    return normal.squaredNorm() > 0.0 ? std::abs(normal.dot(e - a)) / normal.norm() : 0.0;
  };
  const Vec3& a = g.cell_position[at(g.cells_on_edge[at(i)][0])];
  const Vec3& p = g.vertex_position[at(g.vertices_on_edge[at(i)][0])];
  const Vec3 ab = across_edge(g, i), pq = along_edge(g, i);
  // The plane of two nearly equal vertices is known only to rounding over their distance.
  const double blur = 1e-15 / std::max(pq.norm(), 1e-15);
  const double off_cells = is_border(g, i) ? 0.0 : off_plane(a, ab);
  return std::max(off_cells, std::max(0.0, off_plane(p, pq) - blur)) / ab.norm();
}

// Vertex [1] lies to the left of the way from cell [0] to cell [1].
bool turns_left(const Grid& g, std::int64_t i) {
  return across_edge(g, i).cross(along_edge(g, i)).dot(g.surface.normal(g.edge_position[at(i)])) >=
         0.0;
}

double angle_error(const Grid& g, std::int64_t i) {
  const Vec3 up = g.surface.normal(g.edge_position[at(i)]);
  const Vec3 along = along_edge(g, i);
  if (along.squaredNorm() < 1e-12 * across_edge(g, i).squaredNorm()) return 0.0;
  const Vec3 normal = along.cross(up).normalized();
  const Vec3 east = Vec3(-up.y(), up.x(), 0.0).normalized();
  const auto angle = elementary::sincos(g.edge_angle_rad[at(i)]);
  if (up.x() == 0.0 && up.y() == 0.0) return 0.0;
  const double blur = 1e-15 / along.norm();
  return std::max(0.0, (angle.cos * east + angle.sin * up.cross(east) - normal).norm() - blur);
}

void check_geometry(const Grid& g, double tolerance, Rules& rules) {
  check_positions(g, "cells lie on the surface, at their lon/lat", g.cell_position, g.cell_lon_lat,
                  rules);
  check_positions(g, "edges lie on the surface, at their lon/lat", g.edge_position, g.edge_lon_lat,
                  rules);
  check_positions(g, "vertices lie on the surface, at their lon/lat", g.vertex_position,
                  g.vertex_lon_lat, rules);
  rules.check("a vertex is as far from each of its cells", g.n_vertices(), tolerance,
              [&](std::int64_t i) { return radius_spread(g, i); });
  rules.check("an edge lies where its two arcs cross", g.n_edges(), tolerance,
              [&](std::int64_t i) { return crossing_error(g, i); });
  rules.check("vertices on an edge turn left of its normal", g.n_edges(), 0.0,
              [&](std::int64_t i) { return unless(turns_left(g, i)); });
  rules.check(kEdgeAngleRule, g.n_edges(), tolerance,
              [&](std::int64_t i) { return angle_error(g, i); });
  const auto length_error = [&](const Vec3& a, const Vec3& b, double length_m) {
    const double arc_m = g.surface.scale_m() * g.surface.arc_length(a, b);
    return std::abs(length_m - arc_m) / std::max(arc_m, 1e-9 * g.surface.scale_m());
  };
  rules.check("cell distances are arc lengths", g.n_edges(), tolerance, [&](std::int64_t i) {
    const auto [c, d] = g.cells_on_edge[at(i)];
    if (d == kNone) return unless(g.cell_distance_m[at(i)] > 0.0);
    return length_error(g.cell_position[at(c)], g.cell_position[at(d)], g.cell_distance_m[at(i)]);
  });
  rules.check("vertex distances are arc lengths", g.n_edges(), tolerance, [&](std::int64_t i) {
    const auto [v, w] = g.vertices_on_edge[at(i)];
    return length_error(g.vertex_position[at(v)], g.vertex_position[at(w)],
                        g.vertex_distance_m[at(i)]);
  });
}

// ------------------------------------------------------------------ areas

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
    return parallel::sum(context.exec, static_cast<std::int64_t>(areas.size()), kGrain,
                         [&](std::int64_t i) { return areas[at(i)]; });
  };
  rules.check("cells sum to the surface", 1, tolerance,
              [&](std::int64_t) { return std::abs(total(g.cell_area_m2) / whole - 1.0); });
  rules.check("triangles sum to the surface", 1, tolerance,
              [&](std::int64_t) { return std::abs(total(g.triangle_area_m2) / whole - 1.0); });
}

// ------------------------------------------------------------------ weights

double weight_of(const Grid& g, Index edge, Index other) {
  const auto row = g.edges_on_edge.row(edge);
  const auto weights = g.weights_on_edge.row(edge);
  double sum = 0.0;  // two edges of a triangle-shaped cell pair can meet twice
  for (std::size_t j = 0; j < row.size(); ++j) sum += row[j] == other ? weights[j] : 0.0;
  return sum;
}

double antisymmetry_error(const Grid& g, std::int64_t i) {
  const auto edge = static_cast<Index>(i);
  double error = 0.0;
  for (const Index other : g.edges_on_edge.row(i)) {
    const double there =
        weight_of(g, edge, other) * g.cell_distance_m[at(edge)] / g.vertex_distance_m[at(other)];
    const double back =
        weight_of(g, other, edge) * g.cell_distance_m[at(other)] / g.vertex_distance_m[at(edge)];
    error = worse(error, std::abs(there + back));
  }
  return error;
}

// A random flow, its tangential flux along every dual edge and its divergence on every cell.
struct Flow {
  std::vector<double> normal, tangential, outflow_m;  // outflow: sum of u dv over the cell's edges
};

Flow random_flow(Context& context, const Grid& g) {
  Flow flow;
  flow.normal.resize(at(g.n_edges()));
  flow.tangential.resize(at(g.n_edges()));
  flow.outflow_m.resize(at(g.n_cells()));
  parallel::for_index(context.exec, g.n_edges(), kGrain, [&](std::int64_t i) {
    flow.normal[at(i)] = 2.0 * uniform01(0, static_cast<std::uint64_t>(i)) - 1.0;
  });
  parallel::for_index(context.exec, g.n_edges(), kGrain, [&](std::int64_t i) {
    const auto row = g.edges_on_edge.row(i);
    const auto weights = g.weights_on_edge.row(i);
    double sum = 0.0;
    for (std::size_t j = 0; j < row.size(); ++j) sum += weights[j] * flow.normal[at(row[j])];
    flow.tangential[at(i)] = sum;
  });
  parallel::for_index(context.exec, g.n_cells(), kGrain, [&](std::int64_t i) {
    double sum = 0.0;
    for (const Index edge : g.edges_on_cell.row(i)) {
      const double sign = g.cells_on_edge[at(edge)][0] == i ? 1.0 : -1.0;
      sum += sign * flow.normal[at(edge)] * g.vertex_distance_m[at(edge)];
    }
    flow.outflow_m[at(i)] = sum;
  });
  return flow;
}

// div_dual(W u) - kite mean of div(u) on a vertex, both times the triangle's area, against the
// largest outflow of its cells (Thuburn et al. 2009: geostrophic modes stay where they are).
double divergence_error(const Grid& g, const Flow& flow, std::int64_t i) {
  if (!is_complete(g.cells_on_vertex[at(i)])) return 0.0;
  double dual = 0.0, primal = 0.0, size = 0.0;
  for (std::size_t j = 0; j < 3; ++j) {
    const Index edge = g.edges_on_vertex[at(i)][j];
    const double out = g.vertices_on_edge[at(edge)][0] == i ? 1.0 : -1.0;
    dual += out * flow.tangential[at(edge)] * g.cell_distance_m[at(edge)];
    size += g.cell_distance_m[at(edge)];
    const Index cell = g.cells_on_vertex[at(i)][j];
    primal += g.kite_area_m2[at(i)][j] / g.cell_area_m2[at(cell)] * flow.outflow_m[at(cell)];
  }
  return std::abs(dual - primal) / size;
}

void check_weights(Context& context, const Grid& g, double tolerance, Rules& rules) {
  rules.check("weights are antisymmetric (the Coriolis force does no work)", g.n_edges(),
              tolerance > kOwnTolerance ? tolerance : kAntisymmetry,
              [&](std::int64_t i) { return antisymmetry_error(g, i); });
  const Flow flow = random_flow(context, g);
  rules.check("divergence on a vertex is the kite mean of that on its cells", g.n_vertices(),
              tolerance, [&](std::int64_t i) { return divergence_error(g, flow, i); });
}

}  // namespace

std::vector<BrokenRule> check_grid(Context& context, const Grid& grid, double tolerance) {
  std::vector<BrokenRule> broken;
  Rules rules(context, broken);
  rules.check("the sizes of the arrays agree", 1, 0.0,
              [&](std::int64_t) { return unless(has_sizes(grid)); });
  if (!rules.all_hold()) return broken;
  if (is_closed(grid)) {
    rules.check("cells - edges + vertices = 2", 1, 0.0, [&](std::int64_t) {
      return std::abs(static_cast<double>(grid.n_cells() - grid.n_edges() + grid.n_vertices() - 2));
    });
  }
  check_ids(grid, rules);
  if (!rules.all_hold()) return broken;
  check_order(grid, rules);
  check_geometry(grid, tolerance, rules);
  check_areas(context, grid, tolerance, rules);
  check_weights(context, grid, tolerance, rules);
  return broken;
}

std::string to_string(const BrokenRule& rule) {
  std::string out = text(rule.rule, ": ", rule.n_broken, " broken, ids");
  for (const Index id : rule.ids) out += text(" ", id);
  return out + text(", worst ", rule.worst);
}

}  // namespace delos
