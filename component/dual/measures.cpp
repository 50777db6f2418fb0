// SPDX-License-Identifier: BSD-3-Clause
#include "dual/measures.hpp"

#include <Eigen/Geometry>

#include "core/elementary.hpp"

namespace delos::dual {
namespace {

constexpr std::int64_t kMeasureGrain = 1024;  // about 0.1 ms of areas or angles

// A dual edge shorter than this (squared, against its edge) has no direction of its own.
constexpr double kDegenerateDual = 1e-12;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

double in_turn(double lon_rad) {
  const double turned = lon_rad < 0.0 ? lon_rad + 2.0 * kPi : lon_rad;
  return turned < 2.0 * kPi ? turned : 0.0;  // -1e-17 + 2 pi rounds to 2 pi
}

void locate(parallel::Executor& exec, const Grid& grid, const std::vector<Vec3>& positions,
            std::vector<LonLat>& lon_lat) {
  lon_lat.resize(positions.size());
  const auto n = static_cast<std::int64_t>(positions.size());
  parallel::for_index(exec, n, kMeasureGrain, [&](std::int64_t i) {
    const LonLat place = grid.surface.lon_lat(positions[at(i)], grid.latitude);
    lon_lat[at(i)] = {in_turn(place.lon_rad), place.lat_rad};
  });
}

double kite_area(const Grid& grid, std::size_t vertex, int j) {
  const auto& edges = grid.edges_on_vertex[vertex];
  const Vec3& centre = grid.vertex_position[vertex];
  const Vec3& cell = grid.cell_position[at(grid.cells_on_vertex[vertex][at(j)])];
  const Vec3& before = grid.edge_position[at(edges[at(j)])];
  const Vec3& after = grid.edge_position[at(edges[at(j == 2 ? 0 : j + 1)])];
  return grid.surface.triangle_area(centre, before, cell) +
         grid.surface.triangle_area(centre, cell, after);
}

// The kite that a cell and one of its vertices share.
double shared_kite(const Grid& grid, Index cell, Index vertex) {
  const auto& cells = grid.cells_on_vertex[at(vertex)];
  const std::size_t j = cells[0] == cell ? 0 : cells[1] == cell ? 1 : 2;
  return grid.kite_area_m2[at(vertex)][j];
}

// Angle of the edge's normal from local east. East and north lie in the tangent plane; at a pole
// east is that of longitude 0.
double normal_angle(const Grid& grid, std::size_t edge) {
  const auto [c, d] = grid.cells_on_edge[edge];
  const auto [v, w] = grid.vertices_on_edge[edge];
  const Vec3 up = grid.surface.normal(grid.edge_position[edge]);
  const Vec3 along = grid.cell_position[at(d)] - grid.cell_position[at(c)];
  const Vec3 across = grid.vertex_position[at(w)] - grid.vertex_position[at(v)];
  // On the sphere a dual edge is orthogonal to its edge, whose direction is the sharper one.
  const bool use_along =
      grid.surface.is_sphere() || across.squaredNorm() <= kDegenerateDual * along.squaredNorm();
  const Vec3 normal = use_along ? along : across.cross(up);
  const double equatorial = std::sqrt(up.x() * up.x() + up.y() * up.y());
  const Vec3 east =
      equatorial > 0.0 ? Vec3(-up.y() / equatorial, up.x() / equatorial, 0.0) : Vec3(0.0, 1.0, 0.0);
  return elementary::atan2(normal.dot(up.cross(east)), normal.dot(east));
}

}  // namespace

void locate(parallel::Executor& exec, Grid& grid) {
  locate(exec, grid, grid.cell_position, grid.cell_lon_lat);
  locate(exec, grid, grid.edge_position, grid.edge_lon_lat);
  locate(exec, grid, grid.vertex_position, grid.vertex_lon_lat);
}

void measure_areas(parallel::Executor& exec, Grid& grid) {
  const double square_metres = grid.surface.scale_m() * grid.surface.scale_m();
  grid.kite_area_m2.resize(at(grid.n_vertices()));
  grid.triangle_area_m2.resize(at(grid.n_vertices()));
  parallel::for_index(exec, grid.n_vertices(), kMeasureGrain, [&](std::int64_t vertex) {
    auto& kites = grid.kite_area_m2[at(vertex)];
    for (int j = 0; j < 3; ++j) kites[at(j)] = square_metres * kite_area(grid, at(vertex), j);
    grid.triangle_area_m2[at(vertex)] = kites[0] + kites[1] + kites[2];
  });
  grid.cell_area_m2.resize(at(grid.n_cells()));
  parallel::for_index(exec, grid.n_cells(), kMeasureGrain, [&](std::int64_t cell) {
    double area = 0.0;
    for (const Index vertex : grid.vertices_on_cell.row(cell)) {
      area += shared_kite(grid, static_cast<Index>(cell), vertex);
    }
    grid.cell_area_m2[at(cell)] = area;
  });
}

void measure_edges(parallel::Executor& exec, Grid& grid) {
  const double metres = grid.surface.scale_m();
  grid.cell_distance_m.resize(at(grid.n_edges()));
  grid.vertex_distance_m.resize(at(grid.n_edges()));
  grid.edge_angle_rad.resize(at(grid.n_edges()));
  parallel::for_index(exec, grid.n_edges(), kMeasureGrain, [&](std::int64_t edge) {
    const auto [c, d] = grid.cells_on_edge[at(edge)];
    const auto [v, w] = grid.vertices_on_edge[at(edge)];
    grid.cell_distance_m[at(edge)] =
        metres * grid.surface.arc_length(grid.cell_position[at(c)], grid.cell_position[at(d)]);
    grid.vertex_distance_m[at(edge)] =
        metres * grid.surface.arc_length(grid.vertex_position[at(v)], grid.vertex_position[at(w)]);
    grid.edge_angle_rad[at(edge)] = normal_angle(grid, at(edge));
  });
}

}  // namespace delos::dual
