// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/locate.hpp"

#include "core/error.hpp"
#include "geometry/predicates.hpp"

namespace delos {
namespace {

/// A side that has p strictly outside, or -1. The first one after `from`, so that the walk turns.
int side_seeing(const Mesh& mesh, const Triangle& tri, const Vec3& p, int from) {
  int side = from;
  for (int i = 0; i < 3; ++i, side = next_corner(side)) {
    const Vec3 a = mesh.position(tri.vertex[static_cast<std::size_t>(next_corner(side))]);
    const Vec3 b = mesh.position(tri.vertex[static_cast<std::size_t>(previous_corner(side))]);
    if (predicates::orient_origin(a, b, p) < 0) return side;
  }
  return -1;
}

}  // namespace

Index locate(const Mesh& mesh, const Vec3& p, Index start) {
  DELOS_ASSERT(start >= 0 && start < mesh.n_triangles());
  Index tri = start;
  int from = 0;
  for (Index step = 0; step < mesh.n_triangles(); ++step) {
    const Triangle& t = mesh.triangle(tri);
    const int side = side_seeing(mesh, t, p, from);
    if (side < 0) return tri;
    const Index towards = t.neighbour[static_cast<std::size_t>(side)];
    // The side that the walk came through can't see p; the test starts behind it.
    const int entry = side_towards(mesh.triangle(towards), tri);
    from = entry < 0 ? 0 : next_corner(entry);
    tri = towards;
  }
  // The walk ends on every Delaunay mesh (Devillers et al. 2002); elsewhere it may go in circles.
  for (tri = 0; tri < mesh.n_triangles(); ++tri) {
    if (side_seeing(mesh, mesh.triangle(tri), p, 0) < 0) return tri;
  }
  return kNone;
}

}  // namespace delos
