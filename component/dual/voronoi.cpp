// SPDX-License-Identifier: BSD-3-Clause
#include "dual/voronoi.hpp"

#include "core/prefetch.hpp"
#include "dual/locate.hpp"

namespace delos::dual {
namespace {

constexpr std::int64_t kPointGrain = 1024;  // about 0.1 ms, and positions that fit the cache

// Calls place(i) for i in [0, n), which fills positions[i], and block by block, while the positions
// are in the cache, fills the longitudes and latitudes.
template <class Place>
void place_all(parallel::Executor& exec, const Grid& grid, const Array<Vec3>& positions,
               Array<LonLat>& lon_lat, Place&& place) {
  const auto n = static_cast<std::int64_t>(positions.size());
  lon_lat.resize(positions.size());
  parallel::for_range(exec, n, kPointGrain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) place(at(i));
    locate(grid, {positions.data() + begin, at(end - begin)},
           {lon_lat.data() + begin, at(end - begin)});
  });
}

}  // namespace

void place_cells(parallel::Executor& exec, const Mesh& mesh, Grid& grid) {
  const double scale = grid.surface.scale_m();
  grid.cell_position.resize(mesh.vertices.size());
  grid.cell_spacing_m.resize(mesh.vertices.size());
  place_all(exec, grid, grid.cell_position, grid.cell_lon_lat, [&](std::size_t cell) {
    grid.cell_position[cell] = mesh.vertices[cell].position();
    grid.cell_spacing_m[cell] = scale * mesh.vertices[cell].spacing;
  });
}

void place_vertices(parallel::Executor& exec, const Mesh& mesh, Grid& grid) {
  grid.vertex_position.resize(mesh.triangles.size());
  place_all(exec, grid, grid.vertex_position, grid.vertex_lon_lat, [&](std::size_t tri) {
    const auto& corner = mesh.triangles[tri].vertex;
    if (tri + kPrefetchRounds < mesh.triangles.size()) {
      for (const Index vertex : mesh.triangles[tri + kPrefetchRounds].vertex) {
        prefetch(mesh.vertices[at(vertex)]);
      }
    }
    grid.vertex_position[tri] = grid.surface.ball_centre(
        mesh.position(corner[0]), mesh.position(corner[1]), mesh.position(corner[2]));
  });
}

}  // namespace delos::dual
