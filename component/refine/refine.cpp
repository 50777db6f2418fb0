// SPDX-License-Identifier: BSD-3-Clause
#include "refine/refine.hpp"

#include <algorithm>
#include <bit>
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

constexpr double kMaxVertices = 7e8;  // 2 n - 4 triangles must fit 32-bit ids, with room

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

// The order in which the tiles are begun. The large ones of some tiles come first, so that no
// thread is left alone with one at the end; tiles of about one size in their order, since what has
// just been made is appended to the mesh while it is in the cache, and its memory serves again. One
// thread leaves nobody alone. The result does not depend on it.
std::vector<std::int64_t> order_of_tiles(const parallel::Executor& exec, const Skeleton& skeleton) {
  constexpr std::size_t kTilesPerThread = 24;  // a small part of the mesh waits to be appended
  const std::size_t n_tiles = skeleton.tile_triangles.size();
  std::vector<std::int64_t> order(n_tiles);
  std::iota(order.begin(), order.end(), std::int64_t{0});
  const auto n_threads = static_cast<std::size_t>(exec.n_threads());
  if (n_threads == 1) return order;
  // A tile has about as many vertices as its border squared.
  std::size_t most = 1;
  const auto square = [&](std::int64_t tile) {
    const std::size_t n = skeleton.tile_half_segments[static_cast<std::size_t>(tile)].size();
    return std::max<std::size_t>(n * n, 1);
  };
  for (const std::int64_t tile : order) most = std::max(most, square(tile));
  std::vector<int> halvings(n_tiles);
  for (const std::int64_t tile : order) {
    halvings[static_cast<std::size_t>(tile)] = std::bit_width(most / square(tile));
  }
  const std::size_t window = kTilesPerThread * n_threads;
  for (std::size_t first = 0; first < n_tiles; first += window) {
    const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(first + window, n_tiles));
    std::stable_sort(begin, end, [&](std::int64_t a, std::int64_t b) {
      return halvings[static_cast<std::size_t>(a)] < halvings[static_cast<std::size_t>(b)];
    });
  }
  return order;
}

Assembly refine_tiles(Context& context, const FrontInput& input, const Tiling& tiling) {
  Assembler assembler(context.exec, input.skeleton, tiling.expected_vertices);
  std::vector<FrontWorkspace> scratch(static_cast<std::size_t>(context.exec.n_threads()));
  double most = 0.0;
  for (const Tile& tile : tiling.tiles) most = std::max(most, tile.expected_vertices);
  for (FrontWorkspace& workspace : scratch) workspace.reserve(most);
  std::vector<TileMesh> tiles(input.skeleton.tile_triangles.size());
  context.exec.run_pipeline(
      order_of_tiles(context.exec, input.skeleton),
      [&](std::int64_t i) {
        context.monitor.check_cancelled();
        TileMesh& tile = tiles[static_cast<std::size_t>(i)];
        tile = refine_tile(input, static_cast<std::size_t>(i),
                           scratch[static_cast<std::size_t>(context.exec.thread_slot())]);
        context.monitor.advance(static_cast<std::int64_t>(tile.inserted.size()));
      },
      [&](std::int64_t i) {
        assembler.append(std::exchange(tiles[static_cast<std::size_t>(i)], {}));
      });
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
