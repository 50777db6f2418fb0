// SPDX-License-Identifier: BSD-3-Clause
#include "refine/work_mesh.hpp"

namespace delos {
void WorkMesh::cache_circle(WorkTriangle& tri) const {
  if (ball_surface != nullptr) {
    const Vec3 corner = vertex(tri.vertex[0]).position();
    const Vec3 centre = ball_surface->ball_centre(corner, vertex(tri.vertex[1]).position(),
                                                  vertex(tri.vertex[2]).position());
    tri.plane = {centre.x(), centre.y(), centre.z()};
    tri.bound = (corner - centre).squaredNorm();
    return;
  }
  const Vertex& a = vertex(tri.vertex[0]);
  const Vertex& b = vertex(tri.vertex[1]);
  const Vertex& c = vertex(tri.vertex[2]);
  const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
  const double cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
  const double nx = by * cz - bz * cy, ny = bz * cx - bx * cz, nz = bx * cy - by * cx;
  const double inverse = 1.0 / (nx * a.x + ny * a.y + nz * a.z);
  tri.plane = {nx * inverse, ny * inverse, nz * inverse};
  const double square = bx * bx + by * by + bz * bz + cx * cx + cy * cy + cz * cz;
  tri.bound = plane_bound(tri.plane[0], tri.plane[1], tri.plane[2], square * inverse);
}

bool WorkMesh::conflicts_exactly(const WorkTriangle& tri, const Vec3& p) const {
  const auto site = [&](std::size_t k) {
    return predicates::Site{vertex(tri.vertex[k]).position(), tri.vertex[k]};
  };
  // The new vertex gets the next id, higher than all others, so ties are decided as they will be
  // once it is part of the mesh.
  return predicates::in_circle_exact(site(0), site(1), site(2),
                                     {p, static_cast<Index>(vertices.size())});
}

bool WorkMesh::find_cavity(Index seed, const Vec3& p, Cavity& cavity) const {
  constexpr std::size_t kUsualRoom = 64;  // cavities of more than ten triangles are rare
  if (cavity.room() < kUsualRoom) cavity.make_room(kUsualRoom);
  // n triangles have n + 2 sides between them that are on the border or still on the stack.
  std::size_t n = 1, n_border = 0, depth = 3;
  Index* stack = cavity.stack.data();
  cavity.triangles[0] = seed;
  // Depth-first over sides in cyclic order: what is popped is the border, counter-clockwise.
  stack[0] = 4 * seed + 1;
  stack[1] = 4 * seed + 0;
  stack[2] = 4 * seed + 2;
  while (depth > 0) {
    const Index code = stack[--depth];
    const WorkTriangle& inner = at(triangle_of(code));
    const Index link = inner.link[side_of(code)];
    if (link >= 0 && conflicts(at(triangle_of(link)), p)) {
      if (n + 4 > cavity.room()) {
        cavity.make_room(2 * cavity.room());
        stack = cavity.stack.data();
      }
      const Index base = 4 * triangle_of(link);
      const int entry = static_cast<int>(side_of(link));
      cavity.triangles[n++] = triangle_of(link);
      stack[depth++] = base + previous_corner(entry);
      stack[depth++] = base + next_corner(entry);
    } else {
      cavity.start[n_border] =
          inner.vertex[static_cast<std::size_t>(next_corner(static_cast<int>(side_of(code))))];
      cavity.link[n_border++] = link;
    }
  }
  cavity.start[n_border] = cavity.start[0];
  cavity.n_triangles = n;
  cavity.n_border = n_border;
  return n_border == n + 2 && (star_surface == nullptr || is_star(p, cavity));
}

bool WorkMesh::is_star(const Vec3& p, const Cavity& cavity) const {
  const Vec3 normal = p.cwiseProduct(star_surface->inverse_square());
  for (std::size_t i = 0; i < cavity.size(); ++i) {
    const Vec3 from = vertex(cavity.start[i]).position() - p;
    const Vec3 to = vertex(cavity.start[i + 1]).position() - p;
    if (!(from.cross(to).dot(normal) > 0.0)) return false;
  }
  return true;
}

void WorkMesh::fill_cavity(Cavity& cavity, Index new_vertex) {
  const std::size_t n = cavity.size();
  for (int extra = 0; extra < 2; ++extra) {
    cavity.triangles[cavity.n_triangles++] = static_cast<Index>(triangles.size());
    triangles.push_back({});
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Index id = cavity.triangles[i];
    const Index next = cavity.triangles[i + 1 < n ? i + 1 : 0];
    const Index previous = cavity.triangles[i > 0 ? i - 1 : n - 1];
    WorkTriangle& tri = at(id);
    tri.vertex = {new_vertex, cavity.start[i], cavity.start[i + 1]};
    tri.link = {cavity.link[i], 4 * next + 2, 4 * previous + 1};
    tri.stamp = (tri.stamp | WorkTriangle::kOffBounds) + 1U;
    if (cavity.link[i] >= 0) {
      at(triangle_of(cavity.link[i])).link[side_of(cavity.link[i])] = 4 * id;
    } else {
      const Index slot = ~cavity.link[i];
      border_links[static_cast<std::size_t>(slot)] = 4 * id;
    }
  }
}

}  // namespace delos
