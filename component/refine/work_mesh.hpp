// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The triangulation inside one tile while it is refined: cache-hot, private, bounded by
// constraint sides that no cavity crosses. Insertion is Bowyer-Watson with the cavity's border
// in cyclic order (Bowyer 1981, Watson 1981).
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "geometry/ellipsoid.hpp"
#include "geometry/predicates.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// One cache line. The plane through the corners is cached as the vector u with u.p = 1 on it, so
/// that a point p is inside the circumcircle iff u.p > 1: three products instead of a determinant.
///
/// On bodies flatter than kFlattestForPlanes the plane test is too anisotropic; there the same four
/// numbers hold the surface Delaunay ball: its centre, and the square of its radius.
struct alignas(64) WorkTriangle {
  std::array<double, 3> plane;
  double bound;                 ///< of the rounding error of u.p - 1
  std::array<Index, 3> vertex;  ///< local ids, counter-clockwise
  std::array<Index, 3> link;    ///< across side k: 4 * triangle + its side, or ~half_segment
  std::uint32_t stamp;          ///< the bits below; the rest grows when the slot is reused

  static constexpr std::uint32_t kOverSize = 1;        ///< sqrt(3) R > alpha * mean spacing
  static constexpr std::uint32_t kOverRadiusEdge = 2;  ///< R > rho * shortest side
  static constexpr std::uint32_t kOffBounds = kOverSize | kOverRadiusEdge;
};

/// Rounding bound of u.p - 1 for |p| <= 1. With e = 2^-53, a relative error of a few e in each
/// component of u costs a few e (|u_x| + |u_y| + |u_z|); the error of the normal's direction, a few
/// e |B| |C| before division by d = n.a, acts over |p - a| <= 2. Both are taken generously: a wider
/// band only sends more tests to the exact predicate. squares_over_d = (|B|^2 + |C|^2) / d.
inline double plane_bound(double ux, double uy, double uz, double squares_over_d) {
  constexpr double kUnitRoundoff = 0x1p-53;
  return kUnitRoundoff *
         (16.0 * (std::abs(ux) + std::abs(uy) + std::abs(uz)) + 8.0 * std::abs(squares_over_d));
}

/// Least over largest radius above which planes do. At 0.67 balls raise the mean area-length from
/// .99817 to .99826 and the least edge after the springs from .65 to .71 h, for 0.7 of the speed;
/// at 0.4 planes misplace a tenth of the vertices.
inline constexpr double kFlattestForPlanes = 0.8;

inline constexpr Index triangle_of(Index link) { return link >> 2; }
inline constexpr std::size_t side_of(Index link) { return static_cast<std::size_t>(link & 3); }

/// The cavity that a new vertex makes, or the star that fills it: border edge i runs from
/// start[i] to start[i + 1] (start[n] = start[0]) and has link[i] behind it. The arrays are as long
/// as the largest cavity so far asked for: they are written by index, without a test at each end.
struct Cavity {
  std::vector<Index> triangles;
  std::vector<Index> start;
  std::vector<Index> link;
  std::vector<Index> stack;  ///< sides still to be looked at
  std::size_t n_triangles = 0;
  std::size_t n_border = 0;

  std::size_t size() const { return n_border; }
  std::size_t room() const { return link.size(); }
  void make_room(std::size_t n) {
    for (std::vector<Index>* part : {&triangles, &start, &link, &stack}) part->resize(n);
  }
};

class WorkMesh {
 public:
  Array<Vertex> vertices;
  Array<WorkTriangle> triangles;
  /// Set: circumcircles are judged by surface Delaunay balls on this surface, else by planes.
  const Ellipsoid* ball_surface = nullptr;
  /// Set: cavities on this surface are looked at whether their point sees all of their border. On
  /// flat bodies and around lines that end inside a tile it need not.
  const Ellipsoid* star_surface = nullptr;
  /// Local triangle at a half-segment of this tile, kept up to date: (link code) by local slot.
  std::vector<Index> border_links;

  WorkTriangle& at(Index tri) { return triangles[static_cast<std::size_t>(tri)]; }
  const WorkTriangle& at(Index tri) const { return triangles[static_cast<std::size_t>(tri)]; }
  const Vertex& vertex(Index v) const { return vertices[static_cast<std::size_t>(v)]; }

  /// Whether p, to become the next vertex, is inside the circumcircle of `tri`.
  bool conflicts(const WorkTriangle& tri, const Vec3& p) const {
    if (ball_surface != nullptr) return is_in_ball(tri, p);
    const double s = tri.plane[0] * p.x() + tri.plane[1] * p.y() + tri.plane[2] * p.z() - 1.0;
    if (s > tri.bound) return true;
    if (s < -tri.bound) return false;
    return conflicts_exactly(tri, p);
  }

  /// Finds the cavity of p from a triangle that conflicts with it. False when the border is not
  /// one simple loop (p too near to a vertex for the arithmetic).
  bool find_cavity(Index seed, const Vec3& p, Cavity& cavity) const;

  /// Fills the cavity with the star of the new vertex (already appended to `vertices`). Star
  /// triangle i is cavity.triangles[i], with border edge i opposite to the new vertex (corner 0).
  void fill_cavity(Cavity& cavity, Index new_vertex);

  /// Recomputes the cached plane or ball of a triangle from its corners.
  void cache_circle(WorkTriangle& tri) const;

 private:
  bool conflicts_exactly(const WorkTriangle& tri, const Vec3& p) const;
  static bool is_in_ball(const WorkTriangle& tri, const Vec3& p) {
    constexpr double kTie = 1.0 - 1e-11;  // points on the ball are outside, despite rounding
    const double dx = p.x() - tri.plane[0], dy = p.y() - tri.plane[1], dz = p.z() - tri.plane[2];
    return dx * dx + dy * dy + dz * dz < kTie * tri.bound;
  }
  /// Whether every triangle of the star that p would have is counter-clockwise seen from outside;
  /// with planes in a convex tile convexity sees to that.
  bool is_star(const Vec3& p, const Cavity& cavity) const;
};

}  // namespace delos
