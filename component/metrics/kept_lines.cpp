// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/kept_lines.hpp"

#include "metrics/certificate.hpp"

namespace delos {
namespace {

constexpr std::int64_t kGrain = 16384;  // triangles a task: some ten microseconds

struct Seen {
  std::int64_t n_half_edges = 0;  // fixed edges, seen from either side
  std::vector<KeptLines::Missed> missed;
};

bool has_fixed_corner(const FixedEdges& fixed, const Triangle& t) {
  return fixed.has_vertex(t.vertex[0]) || fixed.has_vertex(t.vertex[1]) ||
         fixed.has_vertex(t.vertex[2]);
}

void look_at(const SpacingField& spacing, const Mesh& mesh, const Triangle& t, Seen& seen) {
  KeptLines::Missed missed{Vec3(0, 0, 0), false, false};
  for (std::size_t k = 0; k < 3; ++k) {
    const Index a = t.vertex[k], b = t.vertex[(k + 1) % 3];
    const Vec3 p = mesh.position(a), q = mesh.position(b), r = mesh.position(t.vertex[(k + 2) % 3]);
    if (mesh.fixed.has_edge(a, b)) ++seen.n_half_edges;
    missed.place += p / 3.0;
    missed.is_obtuse |= (q - p).dot(r - p) <= 0.0;
    const Vec3 middle = 0.5 * (p + q);
    const double least = kRelativeEdgeBound * spacing.at(middle.x(), middle.y(), middle.z());
    missed.is_short |= (q - p).squaredNorm() < least * least;
  }
  if (missed.is_obtuse || missed.is_short) seen.missed.push_back(missed);
}

}  // namespace

KeptLines measure_lines(parallel::Executor& exec, const SpacingField& spacing, const Mesh& mesh) {
  const Seen all = parallel::reduce(
      exec, mesh.n_triangles(), kGrain, Seen{},
      [&](std::int64_t begin, std::int64_t end) {
        Seen seen;
        for (auto tri = static_cast<Index>(begin); tri < end; ++tri) {
          const Triangle& t = mesh.triangle(tri);
          if (has_fixed_corner(mesh.fixed, t)) look_at(spacing, mesh, t, seen);
        }
        return seen;
      },
      [](Seen a, const Seen& b) {
        a.n_half_edges += b.n_half_edges;
        a.missed.insert(a.missed.end(), b.missed.begin(), b.missed.end());
        return a;
      });
  return {mesh.fixed.n_vertices(), mesh.fixed.n_edges(), all.n_half_edges / 2, all.missed};
}

}  // namespace delos
