// SPDX-License-Identifier: BSD-3-Clause
#include "refine/skeleton.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "geometry/tangent_frame.hpp"
#include "refine/chains.hpp"
#include "refine/work_mesh.hpp"
#include "sizing/nearest.hpp"
#include "triangulation/delaunay.hpp"
#include "triangulation/flip.hpp"

namespace delos {
namespace {

constexpr int kSideSamples = 256;    // steps of the h-mass integral along a tile side
constexpr int kMaxSplitRounds = 30;  // each halves the missing segments; 3 are the most seen

constexpr double kKeepOff =
    0.8;  // of the spacing: nearer to a line no side of a tile has vertices,
          // so that none is within the circle around an edge of the line
constexpr double kRoomForRing = 2.8;  // of the spacing: rings around points so far apart keep off

// A side between two tile corners that no finer neighbour splits, from the corner of lower id to
// the other; its links are edges of the mesh to be. Without lines they are a chain.
struct Side {
  std::vector<std::array<Index, 2>> links;
};

// The vertices of lines, each a mark for the sides to keep off or to go through.
struct Marks {
  Marks(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
        const ChainSet& chains);

  /// The nearest of them within kKeepOff of the spacing, or kNone.
  Index near(const Vertex& p) const {
    const double reach = kKeepOff * p.spacing;
    return nearest.find(p.position(), reach * reach).point;
  }
  bool are_on_one_chain(Index a, Index b) const;

  std::vector<std::vector<Index>> chains_at;  ///< by vertex of a chain
  Array<Vertex> vertices;                     ///< those of the chains, then rings around points
  NearestPoint nearest;

 private:
  static Array<Vertex> with_rings(const Ellipsoid& surface, const SpacingField& spacing,
                                  const ChainSet& chains);
  static std::vector<Vec3> positions(const Array<Vertex>& vertices);
};

// Around every point on no line six vertices at the spacing from it: a start for the fronts, which
// would otherwise meet the point in any phase.
Array<Vertex> Marks::with_rings(const Ellipsoid& surface, const SpacingField& spacing,
                                const ChainSet& chains) {
  Array<Vertex> out = chains.vertices;
  std::vector<char> is_on_chain(chains.vertices.size(), 0);
  for (const Chain& chain : chains.chains) {
    for (const Index v : chain.points) is_on_chain[static_cast<std::size_t>(v)] = 1;
  }
  for (std::size_t v = 0; v < chains.vertices.size(); ++v) {
    if (is_on_chain[v] != 0) continue;
    const Vertex& centre = chains.vertices[v];
    const double room = kRoomForRing * centre.spacing;
    const auto n_near =
        std::count_if(chains.vertices.begin(), chains.vertices.end(), [&](const Vertex& other) {
          return (other.position() - centre.position()).squaredNorm() < room * room;
        });
    if (n_near > 1) continue;  // more than itself
    const TangentFrame plane(surface.normal(centre.position()));
    const double side = std::sqrt(0.75), half = 0.5;
    const std::array<std::array<double, 2>, 6> hexagon = {
        {{1, 0}, {half, side}, {-half, side}, {-1, 0}, {-half, -side}, {half, -side}}};
    for (const auto& [right, ahead] : hexagon) {
      const Vec3 p = surface.project(centre.position() +
                                     centre.spacing * (right * plane.right + ahead * plane.ahead));
      out.push_back({p.x(), p.y(), p.z(), spacing.at(p.x(), p.y(), p.z())});
    }
  }
  return out;
}

std::vector<Vec3> Marks::positions(const Array<Vertex>& vertices) {
  std::vector<Vec3> out;
  for (const Vertex& v : vertices) out.push_back(v.position());
  return out;
}

Marks::Marks(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
             const ChainSet& chains)
    : chains_at(chains.vertices.size()),
      vertices(with_rings(surface, spacing, chains)),
      nearest(context.exec, positions(vertices)) {
  for (std::size_t c = 0; c < chains.chains.size(); ++c) {
    for (const Index v : chains.chains[c].points) {
      chains_at[static_cast<std::size_t>(v)].push_back(static_cast<Index>(c));
    }
  }
}

bool Marks::are_on_one_chain(Index a, Index b) const {
  const auto n = static_cast<Index>(chains_at.size());
  if (a >= n || b >= n) return false;
  const std::vector<Index>& of_b = chains_at[static_cast<std::size_t>(b)];
  return std::any_of(
      chains_at[static_cast<std::size_t>(a)].begin(), chains_at[static_cast<std::size_t>(a)].end(),
      [&](Index chain) { return std::find(of_b.begin(), of_b.end(), chain) != of_b.end(); });
}

struct Builder {
  const Ellipsoid& surface;
  const SpacingField& spacing;
  const Tiling& tiling;
  const Marks& marks;
  Array<Vertex> vertices;              // the marks first
  std::vector<Index> corner_vertices;  // by corner of the tiling
  std::vector<Side> sides;
  std::unordered_map<std::uint64_t, std::size_t> side_of_key;

  Vertex vertex_at(const Vec3& p) const {
    return {p.x(), p.y(), p.z(), spacing.at(p.x(), p.y(), p.z())};
  }
  /// The mark that is near, else a new vertex.
  Index place(const Vec3& p) {
    const Vertex v = vertex_at(p);
    const Index mark = marks.near(v);
    if (mark != kNone) return mark;
    vertices.push_back(v);
    return static_cast<Index>(vertices.size() - 1);
  }
  bool is_mark(Index vertex) const { return vertex < static_cast<Index>(marks.vertices.size()); }
  /// Along a chain the chain itself is the wall.
  void link(Index from, Index to, Side& side) const {
    if (from != to && !marks.are_on_one_chain(from, to)) side.links.push_back({from, to});
  }
};

// Parameters in (0, 1) along the chord that cut the arc into pieces of equal integral of 1 / h.
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
  std::vector<double> cuts = delos::equal_mass_cuts(mass);
  for (double& cut : cuts) cut /= kSideSamples;
  return cuts;
}

void add_side(Builder& builder, Index a, Index b) {
  const bool is_new = builder.side_of_key.try_emplace(side_key(a, b), builder.sides.size()).second;
  if (!is_new) return;
  const Index low = builder.corner_vertices[static_cast<std::size_t>(std::min(a, b))];
  const Index high = builder.corner_vertices[static_cast<std::size_t>(std::max(a, b))];
  const Vec3 from = builder.vertices[static_cast<std::size_t>(low)].position();
  const Vec3 to = builder.vertices[static_cast<std::size_t>(high)].position();
  Side side;
  Index last = low;
  for (const double t : equal_mass_cuts(builder.surface, builder.spacing, from, to)) {
    const Index next = builder.place(builder.surface.project((1.0 - t) * from + t * to));
    builder.link(last, next, side);
    last = next;
  }
  builder.link(last, high, side);
  builder.sides.push_back(std::move(side));
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

// Puts a vertex into the middle of every link that the mesh lacks; how many there were. Next to a
// line there is no room for one: the side gets a gap.
std::size_t split_missing_links(Builder& builder, const Mesh& mesh) {
  const std::vector<Index> at_vertex = triangle_at_vertex(mesh);
  std::size_t n_missing = 0;
  for (Side& side : builder.sides) {
    std::vector<std::array<Index, 2>> links;
    for (const auto& [a, b] : side.links) {
      if (find_side(mesh, at_vertex, a, b) != kNone) {
        links.push_back({a, b});
        continue;
      }
      ++n_missing;
      const Index middle =
          builder.place(builder.surface.project(mesh.position(a) + mesh.position(b)));
      if (!builder.is_mark(middle)) links.insert(links.end(), {{a, middle}, {middle, b}});
    }
    side.links = std::move(links);
  }
  return n_missing;
}

// The Delaunay mesh in which every side is a chain of edges: missing links are halved until none is
// missing (a conforming Delaunay triangulation).
void make_conforming(Context& context, Builder& builder, Mesh& mesh) {
  for (int round = 0; split_missing_links(builder, mesh) > 0; ++round) {
    DELOS_CHECK(round < kMaxSplitRounds, ErrorKind::input,
                "the spacing changes too steeply for the sides of the tiles to be meshed. Limit "
                "its gradient (sizing.gradient_limit, 0.1 to 0.3 are usual).");
    mesh = mesh_of(context, builder.surface, builder.vertices);
  }
}

Builder make_builder(const Ellipsoid& surface, const SpacingField& spacing, const Tiling& tiling,
                     const Marks& marks) {
  Builder builder{surface, spacing, tiling, marks, marks.vertices, {}, {}, {}};
  for (const Vec3& corner : tiling.corners)
    builder.corner_vertices.push_back(builder.place(corner));
  for (const Tile& tile : tiling.tiles) {
    for (std::size_t k = 0; k < 3; ++k) {
      for_each_side(tiling, tile.corner[k], tile.corner[(k + 1) % 3],
                    [&](Index a, Index b) { add_side(builder, a, b); });
    }
  }
  return builder;
}

// Edges of the chains that the mesh lacks are halved; how many there were.
std::size_t halve_missing_edges(const Ellipsoid& surface, const SpacingField& spacing,
                                const Mesh& mesh, ChainSet& chains) {
  if (chains.chains.empty()) return 0;
  const std::vector<Index> at_vertex = triangle_at_vertex(mesh);
  return halve_edges(
      surface, spacing, [&](Index a, Index b) { return find_side(mesh, at_vertex, a, b) == kNone; },
      chains);
}

// The segments, each once: lines may lead two sides over the same one.
struct SegmentLists {
  Skeleton& skeleton;
  std::unordered_map<std::uint64_t, Index> of_key;

  /// The half-segment from a to b.
  Index half(Index a, Index b) {
    const auto [entry, is_new] =
        of_key.try_emplace(side_key(a, b), static_cast<Index>(skeleton.segments.size()));
    if (is_new) skeleton.segments.push_back({a, b});
    const Index segment = entry->second;
    return skeleton.segments[static_cast<std::size_t>(segment)][0] == a ? 2 * segment
                                                                        : 2 * segment + 1;
  }
};

// Segments and the half-segments around each tile, counter-clockwise.
void list_borders(const Builder& builder, const ChainSet& chains, Skeleton& skeleton) {
  SegmentLists lists{skeleton, {}};
  lists.of_key.reserve(builder.vertices.size());
  for (const Side& side : builder.sides) {
    for (const auto& [a, b] : side.links) lists.half(a, b);
  }
  for (const Chain& chain : chains.chains) {
    for (std::size_t i = 1; i < chain.points.size(); ++i) {
      lists.half(chain.points[i - 1], chain.points[i]);
    }
  }
  for (const Tile& tile : builder.tiling.tiles) {
    std::vector<Index> border;
    for (std::size_t k = 0; k < 3; ++k) {
      for_each_side(
          builder.tiling, tile.corner[k], tile.corner[(k + 1) % 3], [&](Index a, Index b) {
            const auto& links = builder.sides[builder.side_of_key.at(side_key(a, b))].links;
            for (std::size_t i = 0; i < links.size(); ++i) {
              const auto& [from, to] = links[a < b ? i : links.size() - 1 - i];
              border.push_back(a < b ? lists.half(from, to) : lists.half(to, from));
            }
          });
    }
    skeleton.tile_half_segments.push_back(std::move(border));
  }
}

// Takes what can be reached from the triangles in `inside` without crossing a segment.
void flood(const Mesh& mesh, const std::vector<Index>& half_segment, std::vector<char>& is_taken,
           std::vector<Index>& inside) {
  for (std::size_t i = 0; i < inside.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index other = mesh.triangle(inside[i]).neighbour[k];
      char& taken = is_taken[static_cast<std::size_t>(other)];
      if (half_segment[3 * static_cast<std::size_t>(inside[i]) + k] != kNone || taken != 0)
        continue;
      taken = 1;
      inside.push_back(other);
    }
  }
}

// Floods every tile from its border, then what lines enclose; segments are walls.
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
  std::vector<Index> inside;
  const auto take = [&](Index tri) {
    if (is_taken[static_cast<std::size_t>(tri)] != 0) return;
    is_taken[static_cast<std::size_t>(tri)] = 1;
    inside.push_back(tri);
  };
  for (const std::vector<Index>& border : skeleton.tile_half_segments) {
    inside.clear();
    for (const Index half : border) take(triangle_of_half_segment[static_cast<std::size_t>(half)]);
    flood(mesh, half_segment, is_taken, inside);
    skeleton.tile_triangles.push_back(inside);
  }
  for (Index tri = 0; tri < mesh.n_triangles(); ++tri) {
    inside.clear();
    take(tri);
    if (inside.empty()) continue;
    flood(mesh, half_segment, is_taken, inside);
    skeleton.tile_triangles.push_back(inside);
  }
}

// With lines a tile's border is what its triangles touch, both sides of lines that end inside too.
void renew_borders(const std::vector<Index>& half_segment, Skeleton& skeleton) {
  skeleton.tile_half_segments.clear();
  for (const std::vector<Index>& triangles : skeleton.tile_triangles) {
    std::vector<Index> border;
    for (const Index tri : triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Index half = half_segment[3 * static_cast<std::size_t>(tri) + k];
        if (half != kNone) border.push_back(half);
      }
    }
    skeleton.tile_half_segments.push_back(std::move(border));
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
                       const SkeletonInput& input) {
  ChainSet chains = make_chains(surface, spacing, input.lines);
  Skeleton skeleton;
  for (int round = 0;; ++round) {
    DELOS_CHECK(round < kMaxSplitRounds, ErrorKind::input,
                "the lines to be kept can't be meshed: they run too near to each other somewhere. "
                "Leave points out, or make the spacing finer there.");
    context.monitor.check_cancelled();
    const Marks marks(context, surface, spacing, chains);
    Builder builder = make_builder(surface, spacing, input.tiling, marks);
    skeleton.mesh = mesh_of(context, surface, builder.vertices);
    if (round == 0) check_distances(surface, input.lines, chains, skeleton.mesh);
    if (halve_missing_edges(surface, spacing, skeleton.mesh, chains) > 0) continue;
    make_conforming(context, builder, skeleton.mesh);
    if (halve_missing_edges(surface, spacing, skeleton.mesh, chains) > 0) continue;
    list_borders(builder, chains, skeleton);
    break;
  }
  skeleton.mesh.fixed = chains.fixed_edges();
  const std::vector<Index> half_segment = half_segment_of_sides(skeleton);
  list_tile_triangles(half_segment, skeleton);
  if (!input.lines.nodes.empty()) renew_borders(half_segment, skeleton);
  return skeleton;
}

}  // namespace delos
