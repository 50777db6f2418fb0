// SPDX-License-Identifier: BSD-3-Clause
#include "dual/build.hpp"

#include <bit>

#include "core/hash.hpp"
#include "dual/areas.hpp"
#include "dual/connectivity.hpp"
#include "dual/edge_weights.hpp"
#include "dual/edges.hpp"
#include "dual/voronoi.hpp"

namespace delos {
namespace {

void check_closed(const Mesh& mesh) {
  const std::int64_t n_vertices = mesh.n_vertices(), n_triangles = mesh.n_triangles();
  DELOS_CHECK(n_vertices >= 4 && n_triangles == 2 * n_vertices - 4, ErrorKind::internal,
              "the mesh has ", n_vertices, " vertices and ", n_triangles,
              " triangles: a grid needs a closed surface with 2 n - 4 triangles; run validate() on "
              "the mesh to find the place.");
}

template <class T>
void add(Digest& digest, std::span<const T> values) {
  static_assert(std::endian::native == std::endian::little, "digests are over little-endian bytes");
  const std::uint64_t n = values.size();
  digest.add(&n, sizeof n);
  digest.add(values.data(), values.size() * sizeof(T));
}

template <class T>
void add(Digest& digest, const Array<T>& values) {
  add(digest, std::span<const T>(values));
}

template <class T>
void add(Digest& digest, const Ragged<T>& table) {
  add(digest, table.offsets.positions());
  add(digest, table.values);
}

void add(Digest& digest, const Ellipsoid& surface) {
  const Vec3 radii_m = surface.scale_m() * surface.radii();
  digest.add(radii_m.data(), sizeof(Vec3));
  digest.add(surface.centre_m().data(), sizeof(Vec3));
}

}  // namespace

Grid build_grid(Context& context, const Ellipsoid& surface, LatitudeKind latitude,
                const Mesh& mesh) {
  check_closed(mesh);
  Grid grid;
  grid.surface = surface;
  grid.latitude = latitude;
  const auto step_done = [&] {
    context.monitor.advance(mesh.n_vertices() / 5);
    context.monitor.check_cancelled();
  };
  dual::place_cells(context.exec, mesh, grid);
  dual::place_vertices(context.exec, mesh, grid);
  step_done();
  dual::connect(context.exec, mesh, grid);
  step_done();
  dual::measure_edges(context.exec, grid);
  step_done();
  dual::measure_areas(context.exec, grid);
  step_done();
  dual::weigh_edges(context.exec, grid);
  context.monitor.advance(mesh.n_vertices() - 4 * (mesh.n_vertices() / 5));
  return grid;
}

std::string digest(const Grid& grid) {
  Digest digest;
  add(digest, grid.surface);
  add(digest, grid.cell_position);
  add(digest, grid.edge_position);
  add(digest, grid.vertex_position);
  add(digest, grid.cell_lon_lat);
  add(digest, grid.edge_lon_lat);
  add(digest, grid.vertex_lon_lat);
  add(digest, grid.edges_on_cell);
  add(digest, grid.vertices_on_cell);
  add(digest, grid.cells_on_cell);
  add(digest, grid.cells_on_edge);
  add(digest, grid.vertices_on_edge);
  add(digest, grid.cells_on_vertex);
  add(digest, grid.edges_on_vertex);
  add(digest, grid.edges_on_edge);
  add(digest, grid.cell_area_m2);
  add(digest, grid.triangle_area_m2);
  add(digest, grid.kite_area_m2);
  add(digest, grid.cell_distance_m);
  add(digest, grid.vertex_distance_m);
  add(digest, grid.edge_angle_rad);
  add(digest, grid.weights_on_edge);
  add(digest, grid.cell_spacing_m);
  return digest.hex();
}

}  // namespace delos
