// SPDX-License-Identifier: BSD-3-Clause
#include "dual/build.hpp"

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

}  // namespace delos
