// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/culled.hpp"

#include <algorithm>

namespace delos {
namespace {

constexpr std::int64_t kCulledGrain = 4096;  // vertices: a fraction of a millisecond

/// The edge at side k of triangle `vertex`; kNone where it has not two cells. By its cells, so that
/// the order of a vertex's edges in foreign files does not matter.
Index edge_at_side(const Grid& grid, Index vertex, int k) {
  const auto& corners = grid.cells_on_vertex[at(vertex)];
  const Index a = corners[at(next_corner(k))], b = corners[at(previous_corner(k))];
  if (a == kNone || b == kNone) return kNone;
  for (const Index edge : grid.edges_on_vertex[at(vertex)]) {
    if (edge == kNone) continue;
    const auto& cells = grid.cells_on_edge[at(edge)];
    if (std::minmax(cells[0], cells[1]) == std::minmax(a, b)) return edge;
  }
  return kNone;
}

Triangle triangle_at(const Grid& grid, Index vertex) {
  Triangle out{grid.cells_on_vertex[at(vertex)], {kNone, kNone, kNone}};
  for (int k = 0; k < 3; ++k) {
    const Index edge = edge_at_side(grid, vertex, k);
    if (edge == kNone) continue;
    const auto& ends = grid.vertices_on_edge[at(edge)];
    out.neighbour[at(k)] = ends[0] == vertex ? ends[1] : ends[0];
  }
  return out;
}

/// Triangle t is vertex t.
Mesh mesh_with_border(parallel::Executor& exec, const Grid& grid) {
  Mesh mesh;
  mesh.vertices.resize(grid.cell_position.size());
  parallel::for_index(exec, mesh.n_vertices(), kCulledGrain, [&](std::int64_t i) {
    const Vec3& p = grid.cell_position[at(i)];
    const double spacing_m = grid.cell_spacing_m.empty() ? 0.0 : grid.cell_spacing_m[at(i)];
    mesh.vertices[at(i)] = {p.x(), p.y(), p.z(), spacing_m / grid.surface.scale_m()};
  });
  mesh.triangles.resize(grid.vertex_position.size());
  parallel::for_index(exec, mesh.n_triangles(), kCulledGrain, [&](std::int64_t vertex) {
    mesh.triangles[at(vertex)] = triangle_at(grid, static_cast<Index>(vertex));
  });
  return mesh;
}

/// The vertices of a grid that have three cells.
std::vector<Index> whole_vertices(const Grid& grid) {
  std::vector<Index> out;
  for (Index vertex = 0; vertex < grid.n_vertices(); ++vertex) {
    const auto& cells = grid.cells_on_vertex[at(vertex)];
    if (std::find(cells.begin(), cells.end(), kNone) == cells.end()) out.push_back(vertex);
  }
  return out;
}

}  // namespace

Mesh triangles_of(parallel::Executor& exec, const Grid& grid) {
  Mesh mesh = mesh_with_border(exec, grid);
  const std::vector<Index> kept = whole_vertices(grid);
  std::vector<Index> new_id(mesh.triangles.size(), kNone);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    new_id[at(kept[i])] = static_cast<Index>(i);
    mesh.triangles[i] = mesh.triangle(kept[i]);
  }
  mesh.triangles.resize(kept.size());
  for (Triangle& triangle : mesh.triangles) {
    for (Index& beyond : triangle.neighbour) {
      if (beyond != kNone) beyond = new_id[at(beyond)];
    }
  }
  return mesh;
}

CulledMesh::CulledMesh(parallel::Executor& exec, const Grid& grid, Part part) : grid_(grid) {
  if (part == Part::cells) {
    mesh_ = mesh_with_border(exec, grid);
    border_ = {grid.vertex_position, &grid.vertices_on_cell};
  } else {
    vertex_ = whole_vertices(grid);
    mesh_ = triangles_of(exec, grid);
  }
  if (grid.edge_spacing_m.empty()) return;
  spacing_ = [this](Index tri, int k) {
    const Index vertex = vertex_.empty() ? tri : vertex_[at(tri)];
    return grid_.edge_spacing_m[at(edge_at_side(grid_, vertex, k))] / grid_.surface.scale_m();
  };
}

Quality measure_culled(Context& context, const Grid& grid) {
  return measure_quality(context, CulledMesh(context.exec, grid).subject());
}

}  // namespace delos
