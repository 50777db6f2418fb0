// SPDX-License-Identifier: BSD-3-Clause
#include "refine/bounds.hpp"

#include <algorithm>

#include "triangulation/insert.hpp"

namespace delos {
namespace {

constexpr std::int64_t kScanGrain = 16384;  // triangles a task: about half a millisecond
constexpr int kMaxRounds = 60;              // each round at least halves what is left in practice

struct Violation {
  bool over_size = false;
  bool over_radius_edge = false;
  bool any() const { return over_size || over_radius_edge; }
};

Violation violation(const RefineOptions& options, const Mesh& mesh, Index tri) {
  const Triangle& t = mesh.triangle(tri);
  const Vertex& a = mesh.vertices[static_cast<std::size_t>(t.vertex[0])];
  const Vertex& b = mesh.vertices[static_cast<std::size_t>(t.vertex[1])];
  const Vertex& c = mesh.vertices[static_cast<std::size_t>(t.vertex[2])];
  const Vec3 ab = b.position() - a.position(), ac = c.position() - a.position();
  const Vec3 bc = c.position() - b.position();
  const double lab = ab.squaredNorm(), lac = ac.squaredNorm(), lbc = bc.squaredNorm();
  // circumradius^2 = product / (4 * cross): compared without dividing, so slivers are safe.
  const double product = lab * lac * lbc;
  const double cross = 4.0 * ab.cross(ac).squaredNorm();
  const double size = options.size_ratio * (a.spacing + b.spacing + c.spacing) / 3.0;
  const double ratio = options.radius_edge;
  return {3.0 * product > size * size * cross,
          product > ratio * ratio * std::min({lab, lac, lbc}) * cross};
}

// Ids of the triangles that break a bound, ascending.
std::vector<Index> find_violations(parallel::Executor& exec, const RefineOptions& options,
                                   const Mesh& mesh) {
  return parallel::collect<Index>(
      exec, mesh.n_triangles(), kScanGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<Index>& found) {
        for (auto tri = static_cast<Index>(begin); tri < end; ++tri) {
          if (violation(options, mesh, tri).any()) found.push_back(tri);
        }
      });
}

void append_star(const Mesh& mesh, Index vertex, Index at_vertex, std::vector<Index>& out) {
  Index tri = at_vertex;
  do {
    out.push_back(tri);
    const int k = corner_at(mesh.triangle(tri), vertex);
    tri = mesh.triangle(tri).neighbour[static_cast<std::size_t>(next_corner(k))];
  } while (tri != at_vertex);
}

}  // namespace

BoundsReport enforce_bounds(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
                            const RefineOptions& options, Mesh& mesh) {
  BoundsReport report;
  std::vector<Index> todo = find_violations(context.exec, options, mesh);
  for (int round = 0; round < kMaxRounds && !todo.empty(); ++round) {
    context.monitor.check_cancelled();
    std::vector<Index> touched;
    for (const Index tri : todo) {
      if (!violation(options, mesh, tri).any()) continue;
      const auto& v = mesh.triangle(tri).vertex;
      const Vec3 p =
          surface.ball_centre(mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]));
      const Index vertex =
          insert_vertex(mesh, surface, {p.x(), p.y(), p.z(), spacing.at(p.x(), p.y(), p.z())}, tri);
      if (vertex == kNone) continue;
      ++report.n_inserted;
      append_star(mesh, vertex, mesh.n_triangles() - 1, touched);
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    todo = std::move(touched);
  }
  for (const Index tri : find_violations(context.exec, options, mesh)) {
    const Violation broken = violation(options, mesh, tri);
    report.n_over_size += broken.over_size ? 1 : 0;
    report.n_over_radius_edge += broken.over_radius_edge ? 1 : 0;
  }
  return report;
}

}  // namespace delos
