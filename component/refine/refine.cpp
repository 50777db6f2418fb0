// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refine.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "refine/assemble.hpp"
#include "refine/bounds.hpp"
#include "refine/curvature.hpp"
#include "refine/front.hpp"
#include "refine/line_network.hpp"
#include "refine/skeleton.hpp"
#include "refine/tiles.hpp"
#include "triangulation/flip.hpp"

namespace delos {
namespace {

constexpr double kMaxVertices = 7e8;       // 2 n - 4 triangles must fit 32-bit ids, with room
constexpr std::int64_t kTilesPerTask = 1;  // a tile takes some milliseconds

void check_options(const RefineOptions& options) {
  DELOS_CHECK(options.radius_edge >= 1.0, ErrorKind::config,
              "refine.radius_edge = ", options.radius_edge,
              ": must be >= 1, below that refinement need not end.");
  DELOS_CHECK(options.size_ratio > 1.0, ErrorKind::config,
              "refine.size_ratio = ", options.size_ratio, ": must be > 1 (4/3 is the default).");
  DELOS_CHECK(options.tile_vertices >= 500.0, ErrorKind::config,
              "refine.tile_vertices = ", options.tile_vertices,
              ": must be >= 500 (36000 is the default).");
}

// Tiles of one batch: enough for every thread to have its share at any moment, few enough to be a
// small part of the mesh. One thread needs none to choose from, and what it has just made is in its
// cache. The result does not depend on it.
std::size_t batch_tiles(const parallel::Executor& exec) {
  constexpr std::size_t kTilesPerThread = 24;
  const auto n_threads = static_cast<std::size_t>(exec.n_threads());
  return n_threads == 1 ? 1 : kTilesPerThread * n_threads;
}

std::vector<TileMesh> refine_batch(Context& context, const FrontInput& input, std::size_t first,
                                   std::vector<FrontWorkspace>& scratch) {
  const std::size_t n_tiles = input.skeleton.tile_triangles.size();
  std::vector<TileMesh> tiles(std::min(batch_tiles(context.exec), n_tiles - first));
  // The largest first, so that no thread is left alone with one at the end.
  std::vector<std::size_t> order(tiles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return input.skeleton.tile_half_segments[first + a].size() >
           input.skeleton.tile_half_segments[first + b].size();
  });
  parallel::for_index(
      context.exec, static_cast<std::int64_t>(tiles.size()), kTilesPerTask, [&](std::int64_t i) {
        context.monitor.check_cancelled();
        const std::size_t tile = order[static_cast<std::size_t>(i)];
        tiles[tile] = refine_tile(input, first + tile,
                                  scratch[static_cast<std::size_t>(context.exec.thread_slot())]);
        context.monitor.advance(static_cast<std::int64_t>(tiles[tile].inserted.size()));
      });
  return tiles;
}

Assembly refine_tiles(Context& context, const FrontInput& input, const Tiling& tiling) {
  Assembler assembler(context.exec, input.skeleton, tiling.expected_vertices);
  std::vector<FrontWorkspace> scratch(static_cast<std::size_t>(context.exec.n_threads()));
  double most = 0.0;
  for (const Tile& tile : tiling.tiles) most = std::max(most, tile.expected_vertices);
  for (FrontWorkspace& workspace : scratch) workspace.reserve(most);
  const std::size_t n_tiles = input.skeleton.tile_triangles.size();
  for (std::size_t first = 0; first < n_tiles;) {
    const std::vector<TileMesh> tiles = refine_batch(context, input, first, scratch);
    assembler.append(tiles);
    first += tiles.size();
  }
  return assembler.finish();
}

LineNetwork network_of(const Ellipsoid& surface, const SpacingField& spacing,
                       const std::vector<GivenLine>& lines, RefineReport& report) {
  LineNetwork network = make_network(surface, spacing, lines);
  report.n_given_points = network.n_given;
  report.n_crossings = network.n_crossings;
  for (const LineNetwork::SharpCorner& corner : network.sharp_corners) {
    report.sharp_corners.push_back(
        {network.nodes[static_cast<std::size_t>(corner.node)].position, corner.angle_deg});
  }
  return network;
}

}  // namespace

Mesh refine(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
            const RefineOptions& options, RefineReport& report) {
  check_options(options);
  check_curvature(context.exec, surface, spacing);
  const Tiling tiling =
      make_tiles(context.exec, surface, spacing, options.tile_vertices, kMaxVertices);
  const Phase phase(context.monitor, "refine", static_cast<std::int64_t>(tiling.expected_vertices));
  const LineNetwork network = network_of(surface, spacing, options.lines, report);
  const Skeleton skeleton = make_skeleton(context, surface, spacing, {tiling, network});
  report.n_tiles = static_cast<std::int64_t>(tiling.tiles.size());
  report.n_skeleton_vertices = skeleton.mesh.n_vertices();
  context.monitor.advance(report.n_skeleton_vertices);

  const std::vector<Index> half_segment = half_segment_of_sides(skeleton);
  Assembly assembly =
      refine_tiles(context, {surface, spacing, options, skeleton, half_segment}, tiling);
  Mesh& mesh = assembly.mesh;
  mesh.fixed = skeleton.mesh.fixed;
  // On the sphere only the tiles' sides may be non-Delaunay; on an ellipsoid the hull predicate
  // of the tile kernel differs a little from the surface Delaunay triangulation everywhere.
  std::vector<Index>& suspects = assembly.off_bounds;
  report.n_flips = surface.is_sphere()
                       ? restore_delaunay(mesh, surface, assembly.side_triangles, &suspects)
                       : restore_delaunay_everywhere(context.exec, mesh, surface, &suspects);
  const BoundsReport bounds =
      enforce_bounds(context, {surface, spacing, options}, std::move(suspects), mesh);
  report.n_inserted = mesh.n_vertices() - report.n_skeleton_vertices;
  report.n_over_size = bounds.n_over_size;
  report.n_over_radius_edge = bounds.n_over_radius_edge;
  return std::move(assembly.mesh);
}

}  // namespace delos
