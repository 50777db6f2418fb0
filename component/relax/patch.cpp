// SPDX-License-Identifier: BSD-3-Clause
#include "relax/patch.hpp"

#include <algorithm>
#include <cmath>

#include "core/array.hpp"
#include "core/error.hpp"
#include "geometry/predicates.hpp"

namespace delos {
namespace {

// The triangles around the free vertices, each once, in the order of first sight.
std::vector<Index> triangles_around(const Mesh& mesh, const TriangleAtVertex& at_vertex,
                                    const std::vector<Index>& free_vertices) {
  std::vector<Index> found;
  for (const Index v : free_vertices) {
    Index tri = at_vertex[at(v)];
    do {
      found.push_back(tri);
      const int k = corner_at(mesh.triangle(tri), v);
      tri = mesh.triangle(tri).neighbour[at(next_corner(k))];
    } while (tri != at_vertex[at(v)]);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

// The place of an id among ascending ones, or kNone; without branches, which no one could foretell.
Index local_id(const std::vector<Index>& sorted, Index global) {
  if (sorted.empty()) return kNone;
  const Index* first = sorted.data();
  for (std::size_t n = sorted.size(); n > 1;) {
    const std::size_t half = n / 2;
    first += first[half] <= global ? half : 0;
    n -= half;
  }
  return *first == global ? static_cast<Index>(first - sorted.data()) : kNone;
}

// Ids of the border, ascending, and the local id of each corner of the triangles.
struct LocalCorners {
  std::vector<Index> border;
  std::vector<std::array<Index, 3>> of;
};

LocalCorners local_corners(const Mesh& mesh, const std::vector<Index>& triangles,
                           const std::vector<Index>& free_vertices) {
  LocalCorners out;
  out.of.reserve(triangles.size());
  out.border.reserve(3 * triangles.size());
  for (const Index tri : triangles) {
    auto& local = out.of.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Index v = mesh.triangle(tri).vertex[k];
      local[k] = local_id(free_vertices, v);
      if (local[k] == kNone) out.border.push_back(v);
    }
  }
  std::sort(out.border.begin(), out.border.end());
  out.border.erase(std::unique(out.border.begin(), out.border.end()), out.border.end());
  const auto n_free = static_cast<Index>(free_vertices.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      Index& local = out.of[i][k];
      if (local == kNone) {
        local = n_free + local_id(out.border, mesh.triangle(triangles[i]).vertex[k]);
      }
    }
  }
  return out;
}

}  // namespace

const Vertex& Patch::across(Index t, int k) const {
  const Index other = triangle(t).neighbour[at(k)];
  if (other < 0) return beyond[at(~other)];
  return vertex(triangle(other).vertex[at(side_towards(triangle(other), t))]);
}

bool Patch::is_fixed_edge(Index a, Index b) const {
  return std::any_of(fixed_edges.begin(), fixed_edges.end(), [&](const std::array<Index, 2>& edge) {
    return (edge[0] == a - n_free && edge[1] == b - n_free) ||
           (edge[0] == b - n_free && edge[1] == a - n_free);
  });
}

double Patch::score(Index t) const {
  const Triangle& tri = triangle(t);
  const std::array<const Vertex*, 3> v = {&vertex(tri.vertex[0]), &vertex(tri.vertex[1]),
                                          &vertex(tri.vertex[2])};
  const Cotangents cot = cotangents(v[0]->position(), v[1]->position(), v[2]->position());
  const auto across_cot = [&](std::size_t k) {
    const int side = static_cast<int>(k);
    return cotangent(across(t, side), *v[at(previous_corner(side))], *v[at(next_corner(side))]);
  };
  double least = with_own_sides(triangle_score(*v[0], *v[1], *v[2]), cot, across_cot);
  for (std::size_t k = 0; k < 3; ++k) {
    if (tri.neighbour[k] < 0) least = std::min(least, side_score(cot[k], across_cot(k)));
  }
  return least;
}

std::pair<double, Index> Patch::worst() const {
  std::pair<double, Index> least{score(0), 0};
  for (Index t = 1; t < n_triangles(); ++t) {
    const double q = score(t);
    if (q < least.first) least = {q, t};
  }
  return least;
}

ExtractedPatch extract_patch(const Mesh& mesh, const TriangleAtVertex& at_vertex,
                             const std::vector<Index>& free_vertices) {
  ExtractedPatch out;
  out.origin.triangles = triangles_around(mesh, at_vertex, free_vertices);
  const LocalCorners corners = local_corners(mesh, out.origin.triangles, free_vertices);
  const std::vector<Index>& border = corners.border;
  out.origin.vertices = free_vertices;
  out.origin.vertices.insert(out.origin.vertices.end(), border.begin(), border.end());
  out.patch.n_free = static_cast<Index>(free_vertices.size());
  out.patch.vertices.reserve(out.origin.vertices.size());
  for (const Index v : out.origin.vertices) out.patch.vertices.push_back(mesh.vertices[at(v)]);
  // Ascending ids: the fixed ones come first.
  for (std::size_t i = 0; i < border.size() && mesh.fixed.has_vertex(border[i]); ++i) {
    for (std::size_t j = i + 1; j < border.size() && mesh.fixed.has_vertex(border[j]); ++j) {
      if (!mesh.fixed.has_edge(border[i], border[j])) continue;
      out.patch.fixed_edges.push_back({static_cast<Index>(i), static_cast<Index>(j)});
    }
  }
  out.patch.triangles.reserve(out.origin.triangles.size());
  for (std::size_t i = 0; i < out.origin.triangles.size(); ++i) {
    const Index tri = out.origin.triangles[i];
    const Triangle& source = mesh.triangle(tri);
    Triangle t{corners.of[i], {}};
    for (std::size_t k = 0; k < 3; ++k) {
      t.neighbour[k] = local_id(out.origin.triangles, source.neighbour[k]);
      if (t.neighbour[k] == kNone) {
        t.neighbour[k] = ~static_cast<Index>(out.origin.border.size());
        const Triangle& outside = mesh.triangle(source.neighbour[k]);
        const int side = side_towards(outside, tri);
        out.origin.border.push_back({source.neighbour[k], side});
        out.patch.beyond.push_back(mesh.vertices[at(outside.vertex[at(side)])]);
      }
    }
    out.patch.triangles.push_back(t);
  }
  return out;
}

namespace patch {
namespace {

void set_neighbour(Patch& patch, Index tri, Index old_neighbour, Index new_neighbour) {
  if (tri < 0) return;
  patch.triangle(tri).neighbour[at(side_towards(patch.triangle(tri), old_neighbour))] =
      new_neighbour;
}

bool wants_flip(const Patch& patch, Index tri, int side) {
  const Triangle& t = patch.triangle(tri);
  const Index other = t.neighbour[at(side)];
  if (other < 0) return false;
  if (patch.is_fixed_edge(t.vertex[at(next_corner(side))], t.vertex[at(previous_corner(side))])) {
    return false;
  }
  const Triangle& o = patch.triangle(other);
  const auto p = [&](Index v) { return patch.vertex(v).position(); };
  return predicates::prefers_flip(p(t.vertex[at(next_corner(side))]),
                                  p(t.vertex[at(previous_corner(side))]), p(t.vertex[at(side)]),
                                  p(o.vertex[at(side_towards(o, tri))]));
}

// One star, counter-clockwise from a given triangle; the vertex is free, so it closes.
std::vector<Index> star_of(const Patch& patch, Index vertex, Index first) {
  std::vector<Index> star;
  Index tri = first;
  do {
    star.push_back(tri);
    tri = patch.triangle(tri).neighbour[at(next_corner(corner_at(patch.triangle(tri), vertex)))];
  } while (tri != first);
  return star;
}

Index any_triangle_at(const Patch& patch, Index vertex) {
  for (Index t = 0; t < patch.n_triangles(); ++t) {
    if (corner_at(patch.triangle(t), vertex) >= 0) return t;
  }
  return kNone;
}

// Flips a side at `vertex` whose quadrilateral is convex, the one that leaves the best triangle
// behind; false when there is none.
bool flip_one_off(Patch& patch, Index vertex, Index first) {
  double best = 0.0;
  std::pair<Index, int> chosen{kNone, 0};
  for (const Index tri : star_of(patch, vertex, first)) {
    const int k = corner_at(patch.triangle(tri), vertex);
    const int side = next_corner(k);  // runs from the far ring vertex back to `vertex`
    const Index other = patch.triangle(tri).neighbour[at(side)];
    const Triangle& t = patch.triangle(tri);
    const Triangle& o = patch.triangle(other);
    const Vec3 before = patch.vertex(t.vertex[at(next_corner(k))]).position();
    const Vec3 middle = patch.vertex(t.vertex[at(previous_corner(k))]).position();
    const Vec3 after = patch.vertex(o.vertex[at(side_towards(o, tri))]).position();
    if (area_length(patch.vertex(vertex).position(), before, after) <= 0.0) continue;
    const double left_behind = area_length(before, middle, after);
    if (left_behind > best) {
      best = left_behind;
      chosen = {tri, side};
    }
  }
  if (chosen.first == kNone) return false;
  flip(patch, chosen.first, chosen.second);
  return true;
}

// Moves triangle `from` into the slot `to`.
void move_triangle(Patch& patch, Index from, Index to) {
  if (from == to) return;
  patch.triangle(to) = patch.triangle(from);
  for (const Index n : patch.triangle(to).neighbour) set_neighbour(patch, n, from, to);
}

// Replaces the three triangles around a vertex of degree three by one.
void merge_three(Patch& patch, Index vertex, Index first) {
  const std::vector<Index> star = star_of(patch, vertex, first);
  Triangle merged{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Triangle& t = patch.triangle(star[i]);
    const int k = corner_at(t, vertex);
    merged.vertex[i] = t.vertex[at(next_corner(k))];
    merged.neighbour[(i + 2) % 3] = t.neighbour[at(k)];
  }
  patch.triangle(star[0]) = merged;
  for (std::size_t i = 1; i < 3; ++i) {
    const Index outer = merged.neighbour[(i + 2) % 3];
    set_neighbour(patch, outer, star[i], star[0]);
  }
  Index a = star[1], b = star[2];
  if (a < b) std::swap(a, b);  // the higher first, so that the lower stays valid
  for (const Index hole : {a, b}) {
    move_triangle(patch, patch.n_triangles() - 1, hole);
    patch.triangles.pop_back();
  }
}

// Gives the id of a free vertex that has no triangle left to the last free vertex, and the last
// free id to the last vertex of all.
void drop_vertex(Patch& patch, Index vertex) {
  const Index last_free = patch.n_free - 1;
  for (Triangle& t : patch.triangles) {
    for (Index& v : t.vertex) {
      if (v == last_free) {
        v = vertex;
      } else if (v > last_free) {
        --v;
      }
    }
  }
  patch.vertices[at(vertex)] = patch.vertices[at(last_free)];
  patch.vertices.erase(patch.vertices.begin() + last_free);
  patch.n_free = last_free;
}

}  // namespace

void flip(Patch& patch, Index tri, int side) {
  Triangle& t = patch.triangle(tri);
  const Index other = t.neighbour[at(side)];
  Triangle& o = patch.triangle(other);
  const int k = side_towards(o, tri);
  const Index apex = t.vertex[at(side)], from = t.vertex[at(next_corner(side))];
  const Index to = t.vertex[at(previous_corner(side))], far = o.vertex[at(k)];
  const Index right = t.neighbour[at(next_corner(side))];       // across (to, apex)
  const Index left = t.neighbour[at(previous_corner(side))];    // across (apex, from)
  const Index far_left = o.neighbour[at(next_corner(k))];       // across (from, far)
  const Index far_right = o.neighbour[at(previous_corner(k))];  // across (far, to)
  t = {{apex, from, far}, {far_left, other, left}};
  o = {{apex, far, to}, {far_right, right, tri}};
  set_neighbour(patch, far_left, other, tri);
  set_neighbour(patch, right, tri, other);
}

int restore_delaunay(Patch& patch) {
  int n_flips = 0;
  std::vector<Index> todo;
  for (Index t = patch.n_triangles() - 1; t >= 0; --t) todo.push_back(t);
  while (!todo.empty()) {
    const Index tri = todo.back();
    todo.pop_back();
    for (int side = 0; side < 3; ++side) {
      if (!wants_flip(patch, tri, side)) continue;
      const Index other = patch.triangle(tri).neighbour[at(side)];
      flip(patch, tri, side);
      ++n_flips;
      todo.push_back(other);
      todo.push_back(tri);
      break;
    }
  }
  return n_flips;
}

bool remove_vertex(Patch& patch, Index vertex) {
  if (patch.n_free < 2) return false;
  Patch edited = patch;
  for (;;) {
    const Index first = any_triangle_at(edited, vertex);
    const std::size_t degree = star_of(edited, vertex, first).size();
    if (degree == 3) {
      merge_three(edited, vertex, first);
      break;
    }
    if (!flip_one_off(edited, vertex, first)) return false;
  }
  drop_vertex(edited, vertex);
  patch = std::move(edited);
  return true;
}

void insert_vertex(Patch& patch, Index tri, const Vertex& vertex) {
  const Index id = patch.n_free++;
  for (Triangle& t : patch.triangles) {
    for (Index& v : t.vertex) {
      if (v >= id) ++v;
    }
  }
  patch.vertices.insert(patch.vertices.begin() + id, vertex);
  const Triangle t = patch.triangle(tri);
  const Index second = patch.n_triangles(), third = second + 1;
  patch.triangle(tri) = {{id, t.vertex[1], t.vertex[2]}, {t.neighbour[0], second, third}};
  patch.triangles.push_back({{id, t.vertex[2], t.vertex[0]}, {t.neighbour[1], third, tri}});
  patch.triangles.push_back({{id, t.vertex[0], t.vertex[1]}, {t.neighbour[2], tri, second}});
  set_neighbour(patch, t.neighbour[1], tri, second);
  set_neighbour(patch, t.neighbour[2], tri, third);
}

Stars stars(const Patch& patch) {
  std::vector<Index> first(at(patch.n_free), kNone);
  for (Index t = patch.n_triangles() - 1; t >= 0; --t) {
    for (const Index v : patch.triangle(t).vertex) {
      if (v < patch.n_free) first[at(v)] = t;
    }
  }
  Stars out;
  out.offsets.push_back(0);
  for (Index v = 0; v < patch.n_free; ++v) {
    Index tri = first[at(v)];
    do {
      const Triangle& t = patch.triangle(tri);
      const int k = corner_at(t, v);
      out.corners.push_back(3 * tri + static_cast<Index>(k));
      tri = t.neighbour[at(next_corner(k))];
    } while (tri != first[at(v)]);
    out.offsets.push_back(static_cast<Index>(out.corners.size()));
  }
  return out;
}

}  // namespace patch

void commit_patch(Mesh& mesh, TriangleAtVertex& at_vertex, const ExtractedPatch& mended,
                  MeshEdits& edits) {
  const Patch& patch = mended.patch;
  const PatchOrigin& origin = mended.origin;
  // Border vertices are the last ones on both sides; free vertices take the old free ids first.
  const auto n_border = static_cast<Index>(patch.vertices.size()) - patch.n_free;
  const auto n_free_before = static_cast<Index>(origin.vertices.size()) - n_border;
  std::vector<Index> vertex_id;
  for (Index v = 0; v < patch.n_free; ++v) {
    if (v < n_free_before) {
      vertex_id.push_back(origin.vertices[at(v)]);
      mesh.vertices[at(vertex_id.back())] = patch.vertex(v);
    } else {
      vertex_id.push_back(mesh.n_vertices());
      mesh.vertices.push_back(patch.vertex(v));
      at_vertex.push_back(kNone);
    }
  }
  for (Index v = patch.n_free; v < n_free_before; ++v) {
    edits.dead_vertices.push_back(origin.vertices[at(v)]);
  }
  vertex_id.insert(vertex_id.end(), origin.vertices.end() - n_border, origin.vertices.end());

  std::vector<Index> triangle_id = origin.triangles;
  while (triangle_id.size() < patch.triangles.size()) {
    triangle_id.push_back(mesh.n_triangles());
    mesh.triangles.push_back({});
  }
  for (std::size_t t = patch.triangles.size(); t < triangle_id.size(); ++t) {
    edits.dead_triangles.push_back(triangle_id[t]);
    mesh.triangle(triangle_id[t]).vertex.fill(kNone);
  }
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    Triangle& target = mesh.triangle(triangle_id[t]);
    for (std::size_t k = 0; k < 3; ++k) {
      target.vertex[k] = vertex_id[at(patch.triangles[t].vertex[k])];
      at_vertex[at(target.vertex[k])] = triangle_id[t];
      const Index n = patch.triangles[t].neighbour[k];
      if (n >= 0) {
        target.neighbour[k] = triangle_id[at(n)];
      } else {
        const PatchOrigin::BorderSide& side = origin.border[at(~n)];
        target.neighbour[k] = side.outside;
        mesh.triangle(side.outside).neighbour[at(side.side)] = triangle_id[t];
      }
    }
    edits.touched_triangles.push_back(triangle_id[t]);
  }
}

namespace {

constexpr std::int64_t kCompactGrain = 16384;  // ids a task: some ten microseconds

// The id after compaction by the id before, kNone for the dead, which are in ascending order.
Array<Index> ids_after(parallel::Executor& exec, std::size_t n, const std::vector<Index>& dead) {
  Array<Index> ids(n);
  parallel::for_range(
      exec, static_cast<std::int64_t>(n), kCompactGrain, [&](std::int64_t begin, std::int64_t end) {
        auto next_dead = std::lower_bound(dead.begin(), dead.end(), static_cast<Index>(begin));
        auto next = static_cast<Index>(begin - (next_dead - dead.begin()));
        for (auto id = static_cast<Index>(begin); id < end; ++id) {
          const bool is_dead = next_dead != dead.end() && *next_dead == id;
          ids[at(id)] = is_dead ? kNone : next++;
          if (is_dead) ++next_dead;
        }
      });
  return ids;
}

// Moves what lives up over the dead, in order.
template <class T>
void close_gaps(Array<T>& items, const std::vector<Index>& dead) {
  if (dead.empty()) return;
  auto to = items.begin() + dead.front();
  for (std::size_t i = 0; i < dead.size(); ++i) {
    const auto end = i + 1 < dead.size() ? items.begin() + dead[i + 1] : items.end();
    to = std::move(items.begin() + dead[i] + 1, end, to);
  }
  items.resize(items.size() - dead.size());
}

}  // namespace

void compact(parallel::Executor& exec, Mesh& mesh, MeshEdits& edits) {
  std::sort(edits.dead_vertices.begin(), edits.dead_vertices.end());
  std::sort(edits.dead_triangles.begin(), edits.dead_triangles.end());
  const Array<Index> vertex_id = ids_after(exec, mesh.vertices.size(), edits.dead_vertices);
  const Array<Index> triangle_id = ids_after(exec, mesh.triangles.size(), edits.dead_triangles);
  parallel::for_index(exec, mesh.n_triangles(), kCompactGrain, [&](std::int64_t tri) {
    if (triangle_id[static_cast<std::size_t>(tri)] == kNone) return;
    Triangle& t = mesh.triangle(static_cast<Index>(tri));
    for (Index& v : t.vertex) v = vertex_id[at(v)];
    for (Index& n : t.neighbour) n = triangle_id[at(n)];
  });
  close_gaps(mesh.vertices, edits.dead_vertices);
  close_gaps(mesh.triangles, edits.dead_triangles);
  edits.dead_vertices.clear();
  edits.dead_triangles.clear();
}

}  // namespace delos
