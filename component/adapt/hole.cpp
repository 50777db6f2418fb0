// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/hole.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/hash.hpp"
#include "geometry/predicates.hpp"
#include "refine/work_mesh.hpp"
#include "triangulation/flip.hpp"

namespace delos {
namespace {

constexpr std::int64_t kHoleGrain = 1;  // a hole is at least some hundred triangles
// Longest side that taking a vertex out may leave, about that of the icosahedron: like a tile of a
// fresh mesh, no triangle of a hole spans more.
constexpr double kLongestSide = 1.05;

// The triangles of all holes, and where a triangle's is: its hole's first place and its place among
// the hole's triangles together, or kNone.
struct Flooded {
  std::vector<std::vector<Index>> holes;  // ascending
  std::vector<Index> first_place;         // by hole, and one more
  Array<Index> place_of;                  // by old triangle
};

// One hole while vertices are taken out of it.
class Emptying {
 public:
  // `local_id` has kNone for every old vertex, and has so again afterwards.
  Emptying(const OldMesh& old, const Flooded& flooded, std::size_t hole, Array<Index>& local_id)
      : old_(old) {
    load(flooded, hole, local_id);
  }

  void remove(const std::vector<Change>& change);
  void restore_delaunay(bool by_balls);
  Hole take();

 private:
  void load(const Flooded& flooded, std::size_t hole, Array<Index>& local_id);
  const Vec3& position(Index v) const { return positions_[at(v)]; }
  Triangle& triangle(Index t) { return triangles_[at(t)]; }
  void gather_star(Index vertex);
  bool cut_ears(Index vertex);
  bool find_ear(Index vertex, std::size_t& ear) const;
  void close_star();
  bool is_illegal(Index tri, int side, bool by_balls) const;
  void flip(Index tri, int side);
  void relink(Index link, Index from, Index to, Index neighbour);

  // What is left of the star of the vertex that is being taken out: behind the side from ring[i] to
  // ring[i + 1] is link[i].
  struct Star {
    std::vector<Index> ring, link, slots;
    std::vector<Triangle> ears;  // ear i is to become triangle slots[i]
  };

  const OldMesh& old_;
  std::vector<Index> vertices_;  // old ids, ascending
  std::vector<Vec3> positions_;
  std::vector<Triangle> triangles_;
  std::vector<Hole::BorderSide> border_;
  std::vector<Index> at_vertex_;
  std::vector<char> is_gone_;
  Star star_;
};

void Emptying::load(const Flooded& flooded, std::size_t hole, Array<Index>& local_id) {
  const std::vector<Index>& triangles = flooded.holes[hole];
  for (const Index tri : triangles) {
    for (const Index v : old_.mesh.triangle(tri).vertex) {
      if (local_id[at(v)] != kNone) continue;
      local_id[at(v)] = 0;
      vertices_.push_back(v);
    }
  }
  std::sort(vertices_.begin(), vertices_.end());
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    local_id[at(vertices_[i])] = static_cast<Index>(i);
  }
  positions_.reserve(vertices_.size());
  for (const Index v : vertices_) positions_.push_back(old_.mesh.position(v));
  at_vertex_.assign(vertices_.size(), kNone);
  is_gone_.assign(vertices_.size(), 0);
  const Index first = flooded.first_place[hole], end = flooded.first_place[hole + 1];
  triangles_.reserve(triangles.size());
  for (const Index tri : triangles) {
    const Triangle& source = old_.mesh.triangle(tri);
    Triangle t{};
    for (std::size_t k = 0; k < 3; ++k) {
      t.vertex[k] = local_id[at(source.vertex[k])];
      at_vertex_[at(t.vertex[k])] = static_cast<Index>(triangles_.size());
      const Index other = source.neighbour[k], place = flooded.place_of[at(other)];
      if (place >= first && place < end) {
        t.neighbour[k] = place - first;
      } else {
        t.neighbour[k] = ~static_cast<Index>(border_.size());
        border_.push_back({other, side_towards(old_.mesh.triangle(other), tri)});
      }
    }
    triangles_.push_back(t);
  }
  for (const Index v : vertices_) local_id[at(v)] = kNone;
}

// All vertices that are to go, in a scattered order: taken out one after the other along a line
// they would leave ever longer triangles and vertices of ever more neighbours.
void Emptying::remove(const std::vector<Change>& change) {
  constexpr std::uint64_t kSeed = 1;
  std::vector<std::pair<std::uint64_t, Index>> order;
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (change[at(vertices_[v])] != Change::remove) continue;
    order.emplace_back(hash64(kSeed, static_cast<std::uint64_t>(vertices_[v])),
                       static_cast<Index>(v));
  }
  std::sort(order.begin(), order.end());
  for (const auto& [key, vertex] : order) {
    gather_star(vertex);
    if (!cut_ears(vertex)) continue;
    close_star();
    is_gone_[at(vertex)] = 1;
  }
}

void Emptying::gather_star(Index vertex) {
  star_.ring.clear();
  star_.link.clear();
  star_.slots.clear();
  const Index first = at_vertex_[at(vertex)];
  Index tri = first;
  do {
    const Triangle& t = triangle(tri);
    const int k = corner_at(t, vertex);
    star_.ring.push_back(t.vertex[at(next_corner(k))]);
    star_.link.push_back(t.neighbour[at(k)]);
    star_.slots.push_back(tri);
    tri = t.neighbour[at(next_corner(k))];
  } while (tri != first);
}

// Among the corners of the ring that can be cut off, the one whose cut is shortest: the triangles
// left are then not far from Delaunay. The rest stays star-shaped around the vertex.
bool Emptying::find_ear(Index vertex, std::size_t& ear) const {
  const std::vector<Index>& ring = star_.ring;
  const std::size_t n = ring.size();
  double shortest = kLongestSide * kLongestSide;
  bool has_found = false;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 before = position(ring[i > 0 ? i - 1 : n - 1]);
    const Vec3 after = position(ring[i + 1 < n ? i + 1 : 0]);
    const double square = (after - before).squaredNorm();
    if (!(square < shortest)) continue;
    if (predicates::orient_origin(before, position(ring[i]), after) <= 0) continue;
    if (n > 3 && predicates::orient_origin(position(vertex), before, after) <= 0) continue;
    shortest = square;
    ear = i;
    has_found = true;
  }
  return has_found;
}

// Cuts the ring into ears; false when that can't be. The mesh is left alone.
bool Emptying::cut_ears(Index vertex) {
  std::vector<Index>& ring = star_.ring;
  std::vector<Index>& link = star_.link;
  star_.ears.clear();
  for (std::size_t ear = 0; ring.size() >= 3;) {
    if (!find_ear(vertex, ear)) return false;
    const std::size_t n = ring.size();
    const std::size_t before = ear > 0 ? ear - 1 : n - 1, after = ear + 1 < n ? ear + 1 : 0;
    // The side of the cut gets its neighbour from the ear beyond it.
    star_.ears.push_back({{ring[before], ring[ear], ring[after]},
                          {link[ear], n > 3 ? kNone : link[after], link[before]}});
    if (n == 3) return true;
    link[before] = star_.slots[star_.ears.size() - 1];
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
    link.erase(link.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return false;
}

void Emptying::relink(Index link, Index from, Index to, Index neighbour) {
  if (link < 0) return;
  triangle(link).neighbour[at(side_of_edge(triangle(link), from, to))] = neighbour;
}

// Puts the ears into the place of the star.
void Emptying::close_star() {
  for (std::size_t i = 0; i < star_.ears.size(); ++i) {
    triangle(star_.slots[i]) = star_.ears[i];
    for (const Index v : star_.ears[i].vertex) at_vertex_[at(v)] = star_.slots[i];
  }
  for (std::size_t i = 0; i < star_.ears.size(); ++i) {
    const Triangle ear = star_.ears[i];
    for (int k = 0; k < 3; ++k) {
      if (ear.neighbour[at(k)] == kNone) continue;
      relink(ear.neighbour[at(k)], ear.vertex[at(previous_corner(k))],
             ear.vertex[at(next_corner(k))], star_.slots[i]);
    }
  }
  for (std::size_t i = star_.ears.size(); i < star_.slots.size(); ++i) {
    triangle(star_.slots[i]).vertex.fill(kNone);
  }
}

bool Emptying::is_illegal(Index tri, int side, bool by_balls) const {
  const Triangle& t = triangles_[at(tri)];
  const Index other = t.neighbour[at(side)];
  if (other < 0) return false;
  const Triangle& o = triangles_[at(other)];
  const Index apex = t.vertex[at(side)], u = t.vertex[at(next_corner(side))];
  const Index v = t.vertex[at(previous_corner(side))], far = o.vertex[at(side_towards(o, tri))];
  const auto site = [&](Index i) { return predicates::Site{position(i), i}; };
  const bool wants =
      by_balls ? predicates::prefers_flip(position(u), position(v), position(apex), position(far))
               : predicates::in_circle(site(apex), site(u), site(v), site(far));
  return wants && predicates::orient_origin(position(apex), position(u), position(far)) > 0 &&
         predicates::orient_origin(position(far), position(v), position(apex)) > 0;
}

void Emptying::flip(Index tri, int side) {
  const Triangle t = triangle(tri);
  const Index other = t.neighbour[at(side)];
  const Triangle o = triangle(other);
  const int k = side_towards(o, tri);
  const Index apex = t.vertex[at(side)], u = t.vertex[at(next_corner(side))];
  const Index v = t.vertex[at(previous_corner(side))], far = o.vertex[at(k)];
  const Index beyond_v_apex = t.neighbour[at(next_corner(side))];
  const Index beyond_u_far = o.neighbour[at(next_corner(k))];
  triangle(tri) = {{apex, u, far}, {beyond_u_far, other, t.neighbour[at(previous_corner(side))]}};
  triangle(other) = {{far, v, apex}, {beyond_v_apex, tri, o.neighbour[at(previous_corner(k))]}};
  relink(beyond_u_far, far, u, tri);
  relink(beyond_v_apex, apex, v, other);
}

// Lawson flips of all sides but those on the border, whose result is the constrained Delaunay
// triangulation.
void Emptying::restore_delaunay(bool by_balls) {
  // Exact predicates end by themselves; the limit guards the tolerance of prefers_flip.
  std::int64_t flips_left = 64 * static_cast<std::int64_t>(triangles_.size());
  std::vector<Index> stack;
  for (auto tri = static_cast<Index>(triangles_.size()) - 1; tri >= 0; --tri) {
    if (triangle(tri).vertex[0] != kNone) stack.push_back(tri);
  }
  while (!stack.empty() && flips_left > 0) {
    const Index tri = stack.back();
    stack.pop_back();
    for (int side = 0; side < 3; ++side) {
      if (!is_illegal(tri, side, by_balls)) continue;
      const Index other = triangle(tri).neighbour[at(side)];
      flip(tri, side);
      --flips_left;
      stack.insert(stack.end(), {other, tri});
      break;
    }
  }
}

// The hole without what is gone.
Hole Emptying::take() {
  Hole out;
  std::vector<Index> new_vertex(vertices_.size(), kNone), new_triangle(triangles_.size(), kNone);
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (is_gone_[v] != 0) continue;
    new_vertex[v] = static_cast<Index>(out.vertices.size());
    out.vertices.push_back(vertices_[v]);
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    if (triangles_[t].vertex[0] == kNone) continue;
    new_triangle[t] = static_cast<Index>(out.triangles.size());
    out.triangles.push_back(triangles_[t]);
  }
  for (Triangle& t : out.triangles) {
    for (Index& v : t.vertex) v = new_vertex[at(v)];
    for (Index& n : t.neighbour) n = n < 0 ? n : new_triangle[at(n)];
  }
  out.border = std::move(border_);
  return out;
}

// The triangles around removed vertices, a connected set a hole.
Flooded flood_holes(const OldMesh& old, const Region& region) {
  const Mesh& mesh = old.mesh;
  const auto is_inside = [&](Index tri) {
    const auto& v = mesh.triangle(tri).vertex;
    return std::any_of(v.begin(), v.end(),
                       [&](Index i) { return region.change[at(i)] == Change::remove; });
  };
  Flooded out{{}, {0}, Array<Index>(mesh.triangles.size(), kNone)};
  Array<Index>& place_of = out.place_of;
  for (Index v = 0; v < mesh.n_vertices(); ++v) {
    if (region.change[at(v)] != Change::remove) continue;
    const Index seed = old.at_vertex[at(v)];
    if (place_of[at(seed)] != kNone) continue;
    std::vector<Index> inside{seed};
    place_of[at(seed)] = 0;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      for (const Index other : mesh.triangle(inside[i]).neighbour) {
        if (place_of[at(other)] != kNone || !is_inside(other)) continue;
        place_of[at(other)] = 0;
        inside.push_back(other);
      }
    }
    std::sort(inside.begin(), inside.end());
    Index place = out.first_place.back();
    for (const Index tri : inside) place_of[at(tri)] = place++;
    out.first_place.push_back(place);
    out.holes.push_back(std::move(inside));
  }
  return out;
}

// The hole in the form in which the tile kernel takes a tile: number i of the border is
// half-segment i of the one tile.
struct HoleTile {
  Skeleton skeleton;
  std::vector<Index> half_segment;
};

HoleTile tile_of(const Hole& hole, const FillInput& input) {
  HoleTile out;
  Skeleton& skeleton = out.skeleton;
  for (const Index v : hole.vertices) {
    Vertex vertex = input.old.mesh.vertices[at(v)];
    if (input.region.change[at(v)] != Change::keep) {
      vertex.spacing = input.spacing.at(vertex.x, vertex.y, vertex.z);
    }
    skeleton.mesh.vertices.push_back(vertex);
  }
  skeleton.mesh.triangles.assign(hole.triangles.begin(), hole.triangles.end());
  for (const Triangle& t : hole.triangles) {
    for (const Index n : t.neighbour) out.half_segment.push_back(n < 0 ? ~n : kNone);
  }
  std::vector<Index> all(hole.triangles.size()), border(hole.border.size());
  std::iota(all.begin(), all.end(), 0);
  std::iota(border.begin(), border.end(), 0);
  skeleton.tile_triangles.push_back(std::move(all));
  skeleton.tile_half_segments.push_back(std::move(border));
  return out;
}

// Numbers of the holes, the largest first, so that no thread is left alone with one at the end.
template <class Size>
std::vector<std::size_t> largest_first(std::size_t n, const Size& size) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
  return order;
}

}  // namespace

std::vector<Hole> make_holes(Context& context, const Ellipsoid& surface, const OldMesh& old,
                             const Region& region) {
  Flooded flooded = flood_holes(old, region);
  std::vector<Hole> out(flooded.holes.size());
  const bool by_balls = surface.radii().minCoeff() < kFlattestForPlanes;
  const std::vector<std::size_t> order =
      largest_first(flooded.holes.size(), [&](std::size_t i) { return flooded.holes[i].size(); });
  std::vector<Array<Index>> local_ids(at(context.exec.n_threads()));
  parallel::for_index(context.exec, static_cast<std::int64_t>(order.size()), kHoleGrain,
                      [&](std::int64_t i) {
                        context.monitor.check_cancelled();
                        const std::size_t hole = order[at(i)];
                        Array<Index>& ids = local_ids[at(context.exec.thread_slot())];
                        ids.resize(old.mesh.vertices.size(), kNone);
                        Emptying emptying(old, flooded, hole, ids);
                        emptying.remove(region.change);
                        emptying.restore_delaunay(by_balls);
                        out[hole] = emptying.take();
                        out[hole].old_triangles = std::move(flooded.holes[hole]);
                      });
  return out;
}

std::vector<TileMesh> fill_holes(Context& context, const FillInput& input,
                                 const std::vector<Hole>& holes) {
  std::vector<TileMesh> out(holes.size());
  std::vector<FrontWorkspace> scratch(at(context.exec.n_threads()));
  const auto order =
      largest_first(holes.size(), [&](std::size_t i) { return holes[i].border.size(); });
  parallel::for_index(
      context.exec, static_cast<std::int64_t>(holes.size()), kHoleGrain, [&](std::int64_t i) {
        context.monitor.check_cancelled();
        const std::size_t hole = order[at(i)];
        const HoleTile tile = tile_of(holes[hole], input);
        out[hole] = refine_tile(
            {input.surface, input.spacing, input.options, tile.skeleton, tile.half_segment}, 0,
            scratch[at(context.exec.thread_slot())]);
        context.monitor.advance(static_cast<std::int64_t>(out[hole].inserted.size()));
      });
  return out;
}

}  // namespace delos
