// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/insert.hpp"

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "geometry/predicates.hpp"
#include "triangulation/flip.hpp"
#include "triangulation/locate.hpp"

namespace delos {
namespace {

int orientation(const Mesh& mesh, Index a, Index b, Index c) {
  return predicates::orient_origin(mesh.position(a), mesh.position(b), mesh.position(c));
}

void replace_neighbour(Triangle& tri, Index from, Index to, Index neighbour) {
  const int side = side_of_edge(tri, from, to);
  DELOS_ASSERT(side >= 0);
  tri.neighbour[at(side)] = neighbour;
}

/// The triangle at the vertex that lies clockwise of `tri`, seen from outside: across the side
/// from the vertex to the corner after it.
Index turn(const Mesh& mesh, Index tri, Index vertex) {
  const Triangle& t = mesh.triangle(tri);
  return t.neighbour[at(previous_corner(corner_at(t, vertex)))];
}

int degree(const Mesh& mesh, Index tri, Index vertex) {
  int n = 0;
  Index here = tri;
  do {
    here = turn(mesh, here, vertex);
    ++n;
  } while (here != tri);
  return n;
}

bool are_joined(const Mesh& mesh, Index tri, Index vertex, Index other) {
  Index here = tri;
  do {
    if (corner_at(mesh.triangle(here), other) >= 0) return true;
    here = turn(mesh, here, vertex);
  } while (here != tri);
  return false;
}

/// Flips one side away from the vertex; false when none can go. Returns a triangle still at the
/// vertex in `tri`.
bool lower_degree(Mesh& mesh, Index& tri, Index vertex, std::vector<Index>& touched) {
  const Index start = tri;
  Index here = start;
  do {
    // Triangle `here` = (vertex, w, x); its side to w is shared with (vertex, y, w). The ear at w
    // is (y, w, x): it must be positive, and what is left to the vertex at least not negative.
    const Triangle& t = mesh.triangle(here);
    const int corner = corner_at(t, vertex);
    const Index w = t.vertex[at(next_corner(corner))];
    const Index x = t.vertex[at(previous_corner(corner))];
    const int side = previous_corner(corner);
    const Index y = opposite_vertex(mesh, here, side);
    if (orientation(mesh, y, w, x) > 0 && orientation(mesh, vertex, y, x) >= 0 &&
        !are_joined(mesh, here, x, y)) {
      const Index neighbour = t.neighbour[at(side)];
      flip(mesh, here, side);
      touched.insert(touched.end(), {here, neighbour});
      tri = corner_at(mesh.triangle(here), vertex) >= 0 ? here : neighbour;
      return true;
    }
    here = turn(mesh, here, vertex);
  } while (here != start);
  return false;
}

struct Detached {
  bool done = false;
  Index kept = kNone;                          ///< the triangle in place of the three
  std::array<Index, 2> dead = {kNone, kNone};  ///< ascending; their corners are kNone
};

/// Takes the vertex of the three triangles (vertex, w, x), (vertex, x, z), (vertex, z, w) out; the
/// one of lowest id becomes the whole.
Detached remove_degree_three(Mesh& mesh, Index tri, Index vertex) {
  std::array<Index, 3> fan = {tri, turn(mesh, tri, vertex), kNone};
  fan[2] = turn(mesh, fan[1], vertex);
  std::sort(fan.begin(), fan.end());
  const Triangle wx = mesh.triangle(fan[0]);
  const int corner = corner_at(wx, vertex);
  const Index w = wx.vertex[at(next_corner(corner))];
  const Index x = wx.vertex[at(previous_corner(corner))];
  const Triangle xz = mesh.triangle(wx.neighbour[at(next_corner(corner))]);
  const Triangle zw = mesh.triangle(wx.neighbour[at(previous_corner(corner))]);
  const Index z = xz.vertex[at(previous_corner(corner_at(xz, vertex)))];
  const Index beyond_wx = wx.neighbour[at(corner)];
  const Index beyond_xz = xz.neighbour[at(corner_at(xz, vertex))];
  const Index beyond_zw = zw.neighbour[at(corner_at(zw, vertex))];
  replace_neighbour(mesh.triangle(beyond_xz), z, x, fan[0]);
  replace_neighbour(mesh.triangle(beyond_zw), w, z, fan[0]);
  mesh.triangle(fan[0]) = {{z, w, x}, {beyond_wx, beyond_xz, beyond_zw}};
  for (const Index dead : {fan[1], fan[2]}) {
    mesh.triangle(dead) = {{kNone, kNone, kNone}, {kNone, kNone, kNone}};
  }
  return {true, fan[0], {fan[1], fan[2]}};
}

/// Whether the three triangles at the vertex leave a positive one, and not the only other one.
bool can_remove(const Mesh& mesh, Index tri, Index vertex) {
  const Triangle& t = mesh.triangle(tri);
  const int corner = corner_at(t, vertex);
  const Index w = t.vertex[at(next_corner(corner))];
  const Index x = t.vertex[at(previous_corner(corner))];
  const Triangle& next = mesh.triangle(t.neighbour[at(next_corner(corner))]);
  const Index z = next.vertex[at(previous_corner(corner_at(next, vertex)))];
  return orientation(mesh, z, w, x) > 0 && opposite_vertex(mesh, tri, corner) != z;
}

/// remove_vertex without moving ids.
Detached detach(Mesh& mesh, const Ellipsoid& surface, Index vertex, Index hint) {
  Index tri = locate(mesh, mesh.position(vertex), hint);
  DELOS_CHECK(tri != kNone && corner_at(mesh.triangle(tri), vertex) >= 0, ErrorKind::internal,
              "vertex ", vertex, " is not a corner of the triangle at its position.");
  std::vector<Index> touched = {tri};
  int n = degree(mesh, tri, vertex);
  while (n > 3 && lower_degree(mesh, tri, vertex, touched)) --n;
  Detached out;
  if (n == 3 && can_remove(mesh, tri, vertex)) {
    out = remove_degree_three(mesh, tri, vertex);
    touched.push_back(out.kept);
    touched.erase(std::remove_if(touched.begin(), touched.end(),
                                 [&](Index t) { return t == out.dead[0] || t == out.dead[1]; }),
                  touched.end());
  }
  restore_delaunay(mesh, surface, touched);
  return out;
}

/// Gives triangle `from` the id `to`, whose triangle is dead.
void move_triangle(Mesh& mesh, Index from, Index to) {
  const Triangle t = mesh.triangle(from);
  for (int k = 0; k < 3; ++k) {
    replace_neighbour(mesh.triangle(t.neighbour[at(k)]), t.vertex[at(previous_corner(k))],
                      t.vertex[at(next_corner(k))], to);
  }
  mesh.triangle(to) = t;
}

/// The triangles at the vertex, one of which is at its position.
std::vector<Index> star(const Mesh& mesh, Index vertex, Index hint) {
  const Index first = locate(mesh, mesh.position(vertex), hint);
  DELOS_CHECK(first != kNone && corner_at(mesh.triangle(first), vertex) >= 0, ErrorKind::internal,
              "vertex ", vertex, " is not a corner of the triangle at its position.");
  std::vector<Index> out;
  Index tri = first;
  do {
    out.push_back(tri);
    tri = turn(mesh, tri, vertex);
  } while (tri != first);
  return out;
}

}  // namespace

Index insert_vertex(Mesh& mesh, const Ellipsoid& surface, const Vertex& vertex, Index hint) {
  const Vec3 p = vertex.position();
  const Index tri = locate(mesh, p, hint);
  DELOS_CHECK(tri != kNone, ErrorKind::internal, "no triangle holds the point (", p.x(), ", ",
              p.y(), ", ", p.z(), "): the mesh is not closed.");
  const Triangle t = mesh.triangle(tri);
  for (const Index corner : t.vertex) {
    DELOS_CHECK(mesh.position(corner) != p, ErrorKind::input, "the new vertex (", p.x(), ", ",
                p.y(), ", ", p.z(), ") is at the position of vertex ", corner, ".");
  }
  // One triangle becomes three; where the vertex is on a side, one of them is flat and goes by a
  // flip of that side.
  const Index added = mesh.n_vertices();
  const Index second = mesh.n_triangles();
  const Index third = second + 1;
  const auto [a, b, c] = t.vertex;
  const auto [beyond_bc, beyond_ca, beyond_ab] = t.neighbour;
  mesh.vertices.push_back(vertex);
  mesh.triangle(tri) = {{added, b, c}, {beyond_bc, second, third}};
  mesh.triangles.push_back({{added, c, a}, {beyond_ca, third, tri}});
  mesh.triangles.push_back({{added, a, b}, {beyond_ab, tri, second}});
  replace_neighbour(mesh.triangle(beyond_ca), a, c, second);
  replace_neighbour(mesh.triangle(beyond_ab), b, a, third);
  std::vector<Index> seeds = {tri, second, third};
  for (const Index flat : {tri, second, third}) {
    const auto& v = mesh.triangle(flat).vertex;
    if (orientation(mesh, v[0], v[1], v[2]) > 0) continue;
    seeds.push_back(mesh.triangle(flat).neighbour[0]);
    flip(mesh, flat, 0);
  }
  restore_delaunay(mesh, surface, seeds);
  return added;
}

bool remove_vertex(Mesh& mesh, const Ellipsoid& surface, Index vertex, Index hint) {
  if (mesh.n_vertices() <= 4) return false;
  const Detached out = detach(mesh, surface, vertex, hint);
  if (!out.done) return false;
  const Index last = mesh.n_vertices() - 1;
  std::vector<Index> renamed;
  if (vertex != last) {
    renamed = star(mesh, last, out.kept);
    for (const Index tri : renamed) {
      Triangle& t = mesh.triangle(tri);
      t.vertex[at(corner_at(t, last))] = vertex;
    }
    mesh.vertices[at(vertex)] = mesh.vertices[at(last)];
  }
  mesh.vertices.pop_back();
  for (const Index dead : {out.dead[1], out.dead[0]}) {
    const Index end = mesh.n_triangles() - 1;
    if (dead != end) {
      move_triangle(mesh, end, dead);
      std::replace(renamed.begin(), renamed.end(), end, dead);
    }
    mesh.triangles.pop_back();
  }
  // A new id breaks ties in another way.
  restore_delaunay(mesh, surface, renamed);
  return true;
}

std::int64_t remove_vertices(Mesh& mesh, const Ellipsoid& surface, std::span<const Index> vertices,
                             std::vector<Index>& new_id) {
  std::vector<char> is_gone(mesh.vertices.size(), 0);
  const std::vector<Index> one_of = triangle_at_vertex(mesh);
  Index n_left = mesh.n_vertices();
  Index alive = 0;
  for (const Index vertex : vertices) {
    if (n_left <= 4) break;
    const Index hint = one_of[at(vertex)];
    const bool is_alive = mesh.triangle(hint).vertex[0] != kNone;
    const Detached out = detach(mesh, surface, vertex, is_alive ? hint : alive);
    if (!out.done) continue;
    is_gone[at(vertex)] = 1;
    alive = out.kept;
    --n_left;
  }
  // Compaction in order keeps the order of ids, and with it the way ties are broken.
  new_id.assign(mesh.vertices.size(), kNone);
  Index n_vertices = 0;
  for (Index v = 0; v < mesh.n_vertices(); ++v) {
    if (is_gone[at(v)]) continue;
    new_id[at(v)] = n_vertices;
    mesh.vertices[at(n_vertices++)] = mesh.vertices[at(v)];
  }
  const auto n_removed = static_cast<std::int64_t>(mesh.n_vertices() - n_vertices);
  mesh.vertices.resize(at(n_vertices));
  std::vector<Index> new_tri(mesh.triangles.size(), kNone);
  Index n_triangles = 0;
  for (Index tri = 0; tri < mesh.n_triangles(); ++tri) {
    if (mesh.triangle(tri).vertex[0] == kNone) continue;
    new_tri[at(tri)] = n_triangles;
    mesh.triangle(n_triangles++) = mesh.triangle(tri);
  }
  mesh.triangles.resize(at(n_triangles));
  for (Triangle& t : mesh.triangles) {
    for (Index& v : t.vertex) v = new_id[at(v)];
    for (Index& neighbour : t.neighbour) neighbour = new_tri[at(neighbour)];
  }
  return n_removed;
}

}  // namespace delos
