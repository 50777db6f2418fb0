// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/flip.hpp"

#include "core/error.hpp"
#include "geometry/predicates.hpp"

namespace delos {
namespace {

/// The quadrilateral o, u, p, v, counter-clockwise, with diagonal (u, v) = side `side` of `tri`.
struct Quadrilateral {
  Index o, u, p, v;
  Index neighbour;
  int neighbour_side;
};

Quadrilateral quadrilateral(const Mesh& mesh, Index tri, int side) {
  const Triangle& t = mesh.triangle(tri);
  Quadrilateral q{};
  q.o = t.vertex[at(side)];
  q.u = t.vertex[at(next_corner(side))];
  q.v = t.vertex[at(previous_corner(side))];
  q.neighbour = t.neighbour[at(side)];
  const Triangle& n = mesh.triangle(q.neighbour);
  q.neighbour_side = side_of_edge(n, q.v, q.u);
  DELOS_ASSERT(q.neighbour_side >= 0);
  q.p = n.vertex[at(q.neighbour_side)];
  return q;
}

/// Tells `tri` that `neighbour` is now across its side from -> to.
void relink(Mesh& mesh, Index tri, Index from, Index to, Index neighbour) {
  Triangle& t = mesh.triangle(tri);
  const int side = side_of_edge(t, from, to);
  DELOS_ASSERT(side >= 0);
  t.neighbour[at(side)] = neighbour;
}

constexpr double kAcuteMargin = 1e-6;  // of the cosine, times the lengths of the sides

/// Whether all angles are below a right angle by a margin far above rounding. Two such triangles
/// share no illegal side: the angles opposite to it sum to less than two right angles.
bool is_clearly_acute(const Mesh& mesh, const Triangle& t) {
  const Vec3 a = mesh.position(t.vertex[0]);
  const Vec3 ab = mesh.position(t.vertex[1]) - a, ac = mesh.position(t.vertex[2]) - a;
  const double bb = ab.squaredNorm(), cc = ac.squaredNorm(), bc = ab.dot(ac);
  const double least = kAcuteMargin * (bb + cc);
  return bc > least && bb - bc > least && cc - bc > least;
}

bool is_positive(const Mesh& mesh, Index a, Index b, Index c) {
  return predicates::orient_origin(mesh.position(a), mesh.position(b), mesh.position(c)) > 0;
}

}  // namespace

Index opposite_vertex(const Mesh& mesh, Index tri, int side) {
  return quadrilateral(mesh, tri, side).p;
}

void flip(Mesh& mesh, Index tri, int side) {
  const Quadrilateral q = quadrilateral(mesh, tri, side);
  Triangle& t = mesh.triangle(tri);
  Triangle& n = mesh.triangle(q.neighbour);
  const Index beyond_vo = t.neighbour[at(next_corner(side))];
  const Index beyond_ou = t.neighbour[at(previous_corner(side))];
  const Index beyond_up = n.neighbour[at(next_corner(q.neighbour_side))];
  const Index beyond_pv = n.neighbour[at(previous_corner(q.neighbour_side))];
  relink(mesh, beyond_vo, q.o, q.v, q.neighbour);
  relink(mesh, beyond_up, q.p, q.u, tri);
  t = {{q.o, q.u, q.p}, {beyond_up, q.neighbour, beyond_ou}};
  n = {{q.p, q.v, q.o}, {beyond_vo, tri, beyond_pv}};
}

bool can_flip(const Mesh& mesh, Index tri, int side) {
  const Quadrilateral q = quadrilateral(mesh, tri, side);
  return !mesh.fixed.has_edge(q.u, q.v) && is_positive(mesh, q.o, q.u, q.p) &&
         is_positive(mesh, q.p, q.v, q.o);
}

bool is_illegal(const Mesh& mesh, const Ellipsoid& surface, Index tri, int side) {
  const Quadrilateral q = quadrilateral(mesh, tri, side);
  if (!surface.is_sphere()) {
    return predicates::prefers_flip(mesh.position(q.u), mesh.position(q.v), mesh.position(q.o),
                                    mesh.position(q.p));
  }
  return predicates::in_circle({mesh.position(q.o), q.o}, {mesh.position(q.u), q.u},
                               {mesh.position(q.v), q.v}, {mesh.position(q.p), q.p});
}

std::int64_t restore_delaunay(Mesh& mesh, const Ellipsoid& surface, std::span<const Index> seeds,
                              std::vector<Index>* touched) {
  // Exact predicates end by themselves; the limit guards the tolerance of prefers_flip.
  const std::int64_t most_flips = 64 * static_cast<std::int64_t>(mesh.n_triangles());
  std::int64_t n_flips = 0;
  std::vector<Index> stack(seeds.rbegin(), seeds.rend());
  while (!stack.empty()) {
    const Index tri = stack.back();
    stack.pop_back();
    for (int side = 0; side < 3; ++side) {
      if (!is_illegal(mesh, surface, tri, side) || !can_flip(mesh, tri, side)) continue;
      if (!surface.is_sphere() && n_flips >= most_flips) return n_flips;
      const Index neighbour = mesh.triangle(tri).neighbour[at(side)];
      flip(mesh, tri, side);
      ++n_flips;
      stack.insert(stack.end(), {neighbour, tri});
      if (touched != nullptr) touched->insert(touched->end(), {neighbour, tri});
      break;
    }
  }
  return n_flips;
}

namespace {

constexpr std::int64_t kScanGrain = 8192;  // triangles a task: about 0.5 ms

// Whether the angle at `apex` towards the ends of a side is clearly below a right one, see
// is_clearly_acute().
bool is_clearly_sharp(const Vec3& apex, const Vec3& from, const Vec3& to) {
  const Vec3 a = from - apex, b = to - apex;
  return a.dot(b) > kAcuteMargin * (a.squaredNorm() + b.squaredNorm());
}

// Whether the two angles opposite to each side are clearly sharp, so that no side is illegal.
bool is_clearly_legal(const Mesh& mesh, const Triangle& t) {
  const std::array<Vec3, 3> p = {mesh.position(t.vertex[0]), mesh.position(t.vertex[1]),
                                 mesh.position(t.vertex[2])};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    const auto& other = mesh.triangle(t.neighbour[k]).vertex;
    // The corner that the two do not share, without a branch.
    const Index far = static_cast<Index>(std::int64_t{other[0]} + other[1] + other[2] -
                                         t.vertex[u] - t.vertex[v]);
    if (!is_clearly_sharp(p[k], p[u], p[v]) || !is_clearly_sharp(mesh.position(far), p[u], p[v])) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool has_illegal_side(const Mesh& mesh, const Ellipsoid& surface, Index tri) {
  if (is_clearly_legal(mesh, mesh.triangle(tri))) return false;
  return is_illegal(mesh, surface, tri, 0) || is_illegal(mesh, surface, tri, 1) ||
         is_illegal(mesh, surface, tri, 2);
}

std::int64_t restore_delaunay_everywhere(parallel::Executor& exec, Mesh& mesh,
                                         const Ellipsoid& surface, std::vector<Index>* touched) {
  const std::vector<Index> seeds = parallel::collect<Index>(
      exec, mesh.n_triangles(), kScanGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<Index>& found) {
        for (auto tri = static_cast<Index>(begin); tri < end; ++tri) {
          if (is_clearly_acute(mesh, mesh.triangle(tri))) continue;
          if (has_illegal_side(mesh, surface, tri)) found.push_back(tri);
        }
      });
  return restore_delaunay(mesh, surface, seeds, touched);
}

std::int64_t restore_delaunay_around(parallel::Executor& exec, Mesh& mesh, const Ellipsoid& surface,
                                     std::span<const Index> triangles,
                                     std::vector<Index>* touched) {
  const std::vector<Index> seeds = parallel::collect<Index>(
      exec, static_cast<std::int64_t>(triangles.size()), kScanGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<Index>& found) {
        // An acute one, too: the obtuse one across its illegal side may not be listed.
        for (std::int64_t i = begin; i < end; ++i) {
          const Index tri = triangles[static_cast<std::size_t>(i)];
          if (has_illegal_side(mesh, surface, tri)) found.push_back(tri);
        }
      });
  return restore_delaunay(mesh, surface, seeds, touched);
}

}  // namespace delos
