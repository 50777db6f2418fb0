// SPDX-License-Identifier: BSD-3-Clause
#include "refine/skeleton.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "refine/work_mesh.hpp"
#include "triangulation/delaunay.hpp"
#include "triangulation/flip.hpp"

namespace delos {
namespace {

constexpr int kSideSamples = 256;    // steps of the h-mass integral along a tile side
constexpr int kMaxSplitRounds = 30;  // each halves the missing segments; 3 are the most seen

// A side between two tile corners that no finer neighbour splits. Its points run from the corner
// of lower id to the other, both included.
struct Side {
  std::vector<Index> points;
};

struct Builder {
  const Ellipsoid& surface;
  const SpacingField& spacing;
  const Tiling& tiling;
  Array<Vertex> vertices;
  std::vector<Side> sides;
  std::unordered_map<std::uint64_t, std::size_t> side_of_key;

  Index add_vertex(const Vec3& p) {
    vertices.push_back({p.x(), p.y(), p.z(), spacing.at(p.x(), p.y(), p.z())});
    return static_cast<Index>(vertices.size() - 1);
  }
};

// Parameters in (0, 1) along the chord that cut the arc into pieces of equal integral of 1 / h,
// as near to one each as a whole number of pieces allows.
std::vector<double> equal_mass_cuts(const Ellipsoid& surface, const SpacingField& spacing,
                                    const Vec3& from, const Vec3& to) {
  const auto at = [&](double t) { return surface.project((1.0 - t) * from + t * to); };
  std::array<Vertex, kSideSamples> middle;
  for (int i = 0; i < kSideSamples; ++i) {
    const Vec3 p = at((i + 0.5) / kSideSamples);
    middle[static_cast<std::size_t>(i)] = {p.x(), p.y(), p.z(), 0.0};
  }
  spacing.evaluate(middle);
  std::array<double, kSideSamples + 1> mass{};
  Vec3 previous = from;
  for (int i = 0; i < kSideSamples; ++i) {
    const auto s = static_cast<std::size_t>(i);
    const Vec3 next = at((i + 1.0) / kSideSamples);
    mass[s + 1] = mass[s] + (next - previous).norm() / middle[s].spacing;
    previous = next;
  }
  const double total = mass[kSideSamples];
  const auto n_pieces =
      std::max<std::int64_t>(1, static_cast<std::int64_t>(std::floor(total + 0.5)));
  std::vector<double> cuts;
  cuts.reserve(static_cast<std::size_t>(n_pieces));
  std::size_t s = 0;
  for (std::int64_t piece = 1; piece < n_pieces; ++piece) {
    const double wanted = total * static_cast<double>(piece) / static_cast<double>(n_pieces);
    while (mass[s + 1] < wanted) ++s;
    cuts.push_back((static_cast<double>(s) + (wanted - mass[s]) / (mass[s + 1] - mass[s])) /
                   kSideSamples);
  }
  return cuts;
}

const Side& side_between(Builder& builder, Index a, Index b) {
  const auto [entry, is_new] =
      builder.side_of_key.try_emplace(side_key(a, b), builder.sides.size());
  if (is_new) {
    const Index low = std::min(a, b), high = std::max(a, b);
    const Vec3 from = builder.tiling.corners[static_cast<std::size_t>(low)];
    const Vec3 to = builder.tiling.corners[static_cast<std::size_t>(high)];
    Side side;
    side.points.push_back(low);
    for (const double t : equal_mass_cuts(builder.surface, builder.spacing, from, to)) {
      side.points.push_back(builder.add_vertex(builder.surface.project((1.0 - t) * from + t * to)));
    }
    side.points.push_back(high);
    builder.sides.push_back(std::move(side));
  }
  return builder.sides[entry->second];
}

// Calls visit(a, b) for every unsplit side between corners a and b, in order.
template <class Visit>
void for_each_side(const Tiling& tiling, Index a, Index b, const Visit& visit) {
  const Index middle = tiling.middle_of(a, b);
  if (middle == kNone) {
    visit(a, b);
    return;
  }
  for_each_side(tiling, a, middle, visit);
  for_each_side(tiling, middle, b, visit);
}

// Side of the mesh that runs from a to b, as 3 * triangle + side; kNone when there is none.
Index find_side(const Mesh& mesh, const std::vector<Index>& at_vertex, Index a, Index b) {
  const Index first = at_vertex[static_cast<std::size_t>(a)];
  Index tri = first;
  do {
    const Triangle& t = mesh.triangle(tri);
    const int k = corner_at(t, a);
    if (t.vertex[static_cast<std::size_t>(next_corner(k))] == b)
      return 3 * tri + previous_corner(k);
    tri = t.neighbour[static_cast<std::size_t>(next_corner(k))];
  } while (tri != first);
  return kNone;
}

Mesh mesh_of(Context& context, const Ellipsoid& surface, const Array<Vertex>& vertices) {
  std::vector<Vec3> points(vertices.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = vertices[i].position();
  Mesh mesh = delaunay(context.exec, points);
  mesh.vertices = vertices;
  if (surface.radii().minCoeff() < kFlattestForPlanes) {
    restore_delaunay_everywhere(context.exec, mesh, surface);
  }
  return mesh;
}

// Puts a vertex into the middle of every segment that the mesh lacks; how many there were.
std::size_t split_missing_segments(Builder& builder, const Mesh& mesh) {
  const std::vector<Index> at_vertex = triangle_at_vertex(mesh);
  std::size_t n_missing = 0;
  for (Side& side : builder.sides) {
    std::vector<Index> points{side.points.front()};
    for (std::size_t i = 1; i < side.points.size(); ++i) {
      const Index a = side.points[i - 1], b = side.points[i];
      if (find_side(mesh, at_vertex, a, b) == kNone) {
        points.push_back(
            builder.add_vertex(builder.surface.project(mesh.position(a) + mesh.position(b))));
        ++n_missing;
      }
      points.push_back(b);
    }
    side.points = std::move(points);
  }
  return n_missing;
}

// The Delaunay mesh in which every side is a chain of edges: missing segments are halved until
// none is missing (a conforming Delaunay triangulation).
Mesh conforming_mesh(Context& context, Builder& builder) {
  Mesh mesh = mesh_of(context, builder.surface, builder.vertices);
  for (int round = 0; split_missing_segments(builder, mesh) > 0; ++round) {
    DELOS_CHECK(round < kMaxSplitRounds, ErrorKind::input,
                "the spacing changes too steeply for the sides of the tiles to be meshed. Limit "
                "its gradient (sizing.gradient_limit, 0.1 to 0.3 are usual).");
    mesh = mesh_of(context, builder.surface, builder.vertices);
  }
  return mesh;
}

void list_segments(const Builder& builder, Skeleton& skeleton, std::vector<Index>& first_of_side) {
  for (const Side& side : builder.sides) {
    first_of_side.push_back(static_cast<Index>(skeleton.segments.size()));
    for (std::size_t i = 1; i < side.points.size(); ++i) {
      skeleton.segments.push_back({side.points[i - 1], side.points[i]});
    }
  }
}

// The half-segments around each tile, counter-clockwise.
void list_borders(const Builder& builder, const std::vector<Index>& first_of_side,
                  Skeleton& skeleton) {
  for (const Tile& tile : builder.tiling.tiles) {
    std::vector<Index> border;
    for (std::size_t k = 0; k < 3; ++k) {
      for_each_side(builder.tiling, tile.corner[k], tile.corner[(k + 1) % 3],
                    [&](Index a, Index b) {
                      const std::size_t side = builder.side_of_key.at(side_key(a, b));
                      const auto n = static_cast<Index>(builder.sides[side].points.size()) - 1;
                      const Index first = first_of_side[side];
                      for (Index i = 0; i < n; ++i) {
                        border.push_back(a < b ? 2 * (first + i) : 2 * (first + n - 1 - i) + 1);
                      }
                    });
    }
    skeleton.tile_half_segments.push_back(std::move(border));
  }
}

// Floods every tile from its border; segments are walls.
void list_tile_triangles(const std::vector<Index>& half_segment, Skeleton& skeleton) {
  const Mesh& mesh = skeleton.mesh;
  std::vector<Index> triangle_of_half_segment(2 * skeleton.segments.size(), kNone);
  for (std::size_t side = 0; side < half_segment.size(); ++side) {
    if (half_segment[side] != kNone) {
      triangle_of_half_segment[static_cast<std::size_t>(half_segment[side])] =
          static_cast<Index>(side / 3);
    }
  }
  std::vector<char> is_taken(mesh.triangles.size(), 0);
  for (const std::vector<Index>& border : skeleton.tile_half_segments) {
    std::vector<Index> inside;
    const auto take = [&](Index tri) {
      if (is_taken[static_cast<std::size_t>(tri)] != 0) return;
      is_taken[static_cast<std::size_t>(tri)] = 1;
      inside.push_back(tri);
    };
    for (const Index half : border) take(triangle_of_half_segment[static_cast<std::size_t>(half)]);
    for (std::size_t i = 0; i < inside.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto side = 3 * static_cast<std::size_t>(inside[i]) + k;
        if (half_segment[side] == kNone) take(mesh.triangle(inside[i]).neighbour[k]);
      }
    }
    skeleton.tile_triangles.push_back(std::move(inside));
  }
}

}  // namespace

std::vector<Index> half_segment_of_sides(const Skeleton& skeleton) {
  std::vector<Index> half_segment(3 * skeleton.mesh.triangles.size(), kNone);
  const std::vector<Index> at_vertex = triangle_at_vertex(skeleton.mesh);
  for (std::size_t s = 0; s < skeleton.segments.size(); ++s) {
    const auto [a, b] = skeleton.segments[s];
    const Index forward = find_side(skeleton.mesh, at_vertex, a, b);
    const Index backward = find_side(skeleton.mesh, at_vertex, b, a);
    DELOS_ASSERT(forward != kNone && backward != kNone);
    half_segment[static_cast<std::size_t>(forward)] = static_cast<Index>(2 * s);
    half_segment[static_cast<std::size_t>(backward)] = static_cast<Index>(2 * s + 1);
  }
  return half_segment;
}

Skeleton make_skeleton(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
                       const Tiling& tiling) {
  Builder builder{surface, spacing, tiling, {}, {}, {}};
  for (const Vec3& corner : tiling.corners) builder.add_vertex(corner);
  for (const Tile& tile : tiling.tiles) {
    for (std::size_t k = 0; k < 3; ++k) {
      for_each_side(tiling, tile.corner[k], tile.corner[(k + 1) % 3],
                    [&](Index a, Index b) { side_between(builder, a, b); });
    }
  }
  Skeleton skeleton;
  skeleton.mesh = conforming_mesh(context, builder);
  std::vector<Index> first_of_side;
  list_segments(builder, skeleton, first_of_side);
  list_borders(builder, first_of_side, skeleton);
  list_tile_triangles(half_segment_of_sides(skeleton), skeleton);
  return skeleton;
}

}  // namespace delos
