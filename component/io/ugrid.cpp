// SPDX-License-Identifier: BSD-3-Clause
#include "io/ugrid.hpp"

#include <algorithm>
#include <functional>

#include "io/blocks.hpp"
#include "io/ugrid_file.hpp"

namespace delos {
namespace {

/// Each side once: from the triangle of lower id, or the only one.
void for_each_edge_of(const Mesh& mesh, const std::function<void(Index, Index)>& edge) {
  for (Index tri = 0; tri < mesh.n_triangles(); ++tri) {
    const Triangle& triangle = mesh.triangle(tri);
    for (int k = 0; k < 3; ++k) {
      const Index beyond = triangle.neighbour[at(k)];
      if (beyond != kNone && beyond < tri) continue;
      edge(triangle.vertex[at(next_corner(k))], triangle.vertex[at(previous_corner(k))]);
    }
  }
}

/// A side of a closed surface belongs to two triangles, a border side to one.
std::int64_t count_edges(const Mesh& mesh) {
  std::int64_t n_sides = 0;
  for (const Triangle& triangle : mesh.triangles) {
    for (const Index beyond : triangle.neighbour) n_sides += beyond == kNone ? 2 : 1;
  }
  return n_sides / 2;
}

/// The field at the middles of the edges between these pairs of vertices, in metres.
std::vector<double> spacing_at_middles(parallel::Executor& exec, const Mesh& mesh,
                                       const UgridSurface& surface,
                                       std::span<const Index> vertices) {
  const auto n = static_cast<std::int64_t>(vertices.size() / 2);
  std::vector<Vertex> middles(at(n));
  std::vector<double> out(at(n));
  parallel::for_range(exec, n, kConvertGrain, [&](std::int64_t begin, std::int64_t end) {
    for (std::size_t i = at(begin); i < at(end); ++i) {
      const Vec3 middle = surface.ellipsoid.project(mesh.position(vertices[2 * i]) +
                                                    mesh.position(vertices[2 * i + 1]));
      middles[i] = {middle.x(), middle.y(), middle.z(), 0.0};
    }
    surface.spacing->evaluate(std::span(middles).subspan(at(begin), at(end - begin)));
    for (std::size_t i = at(begin); i < at(end); ++i) {
      out[i] = middles[i].spacing * surface.ellipsoid.scale_m();
    }
  });
  return out;
}

}  // namespace

void write_ugrid_triangles(const std::string& path, const Mesh& mesh, const UgridSurface& surface,
                           const Provenance& provenance, const UgridOptions& options) {
  const Ellipsoid& body = surface.ellipsoid;
  const double square_m = body.scale_m() * body.scale_m();
  const auto corner = [&mesh](std::int64_t tri, std::size_t k) {
    return mesh.position(mesh.triangle(static_cast<Index>(tri)).vertex[k]);
  };
  UgridTopology topology;
  topology.name = "delos_triangles";
  topology.long_name = "Delaunay triangulation";
  topology.n_nodes = mesh.n_vertices();
  topology.n_faces = mesh.n_triangles();
  topology.n_edges = count_edges(mesh);
  topology.node = [&](std::int64_t node) {
    return body.lon_lat(mesh.position(static_cast<Index>(node)), surface.latitude);
  };
  topology.face_centre = [&](std::int64_t tri) {
    return body.lon_lat(body.ball_centre(corner(tri, 0), corner(tri, 1), corner(tri, 2)),
                        surface.latitude);
  };
  topology.face_area_m2 = [&, square_m](std::int64_t tri) {
    return square_m * body.triangle_area(corner(tri, 0), corner(tri, 1), corner(tri, 2));
  };
  topology.corners = [&](std::int64_t tri, std::span<Index> out) {
    const auto& vertex = mesh.triangle(static_cast<Index>(tri)).vertex;
    std::copy(vertex.begin(), vertex.end(), out.begin());
    return vertex.size();
  };
  topology.for_each_edge = [&](const auto& edge) { for_each_edge_of(mesh, edge); };
  topology.elements = {topology.name + "_faces", topology.name + "_nodes"};
  if (surface.spacing != nullptr) {
    topology.edge_spacing_m = [&](parallel::Executor& exec, std::size_t,
                                  std::span<const Index> nodes) {
      return spacing_at_middles(exec, mesh, surface, nodes);
    };
  }
  if (!surface.edge_spacing_m.empty()) {
    topology.edge_spacing_m = [&](parallel::Executor&, std::size_t first,
                                  std::span<const Index> nodes) {
      const auto slice = surface.edge_spacing_m.subspan(first, nodes.size() / 2);
      return std::vector<double>(slice.begin(), slice.end());
    };
  }
  write_ugrid_topology(path, topology, surface, provenance, options);
}

void write_ugrid_cells(const std::string& path, const Grid& grid, const Provenance& provenance,
                       const UgridOptions& options) {
  UgridTopology topology;
  topology.name = "delos_cells";
  topology.long_name = "Voronoi cells";
  topology.n_nodes = grid.n_vertices();
  topology.n_faces = grid.n_cells();
  topology.n_edges = grid.n_edges();
  topology.max_corners = longest_row(grid.vertices_on_cell.offsets);
  topology.node = [&](std::int64_t node) { return grid.vertex_lon_lat[at(node)]; };
  topology.face_centre = [&](std::int64_t cell) { return grid.cell_lon_lat[at(cell)]; };
  topology.face_area_m2 = [&](std::int64_t cell) { return grid.cell_area_m2[at(cell)]; };
  topology.corners = [&](std::int64_t cell, std::span<Index> out) {
    const auto row = grid.vertices_on_cell.row(cell);
    std::copy(row.begin(), row.end(), out.begin());
    return row.size();
  };
  topology.for_each_edge = [&](const auto& edge) {
    for (const auto& vertices : grid.vertices_on_edge) edge(vertices[0], vertices[1]);
  };
  topology.face_ring = grid.cell_ring;
  topology.elements = {topology.name + "_nodes", topology.name + "_faces"};
  if (!grid.edge_spacing_m.empty()) {
    topology.edge_spacing_m = [&](parallel::Executor&, std::size_t first,
                                  std::span<const Index> nodes) {
      const auto begin = grid.edge_spacing_m.begin() + static_cast<std::ptrdiff_t>(first);
      return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(nodes.size() / 2));
    };
  }
  write_ugrid_topology(path, topology, {grid.surface, grid.latitude}, provenance, options);
}

std::uint64_t ugrid_triangles_size_bytes(std::int64_t n_vertices, const UgridOptions& options) {
  UgridTopology topology;
  topology.n_nodes = n_vertices;
  topology.n_faces = 2 * n_vertices;
  topology.n_edges = 3 * n_vertices;
  topology.edge_spacing_m = [](parallel::Executor&, std::size_t, auto) {
    return std::vector<double>();
  };
  return ugrid_size_bytes(topology, options);
}

}  // namespace delos
