// SPDX-License-Identifier: BSD-3-Clause
#include "refine/bounds.hpp"

#include <algorithm>

#include "triangulation/insert.hpp"

namespace delos {
namespace {

constexpr int kMaxRounds = 60;  // each round at least halves what is left in practice

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

void make_unique(std::vector<Index>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
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

BoundsReport enforce_bounds(Context& context, const BoundsInput& input, std::vector<Index> suspects,
                            Mesh& mesh) {
  const auto& [surface, spacing, options] = input;
  const auto is_sound = [&, &opts = options](Index tri) {
    return !violation(opts, mesh, tri).any();
  };
  BoundsReport report;
  make_unique(suspects);
  std::erase_if(suspects, is_sound);
  std::vector<Index> todo = suspects;
  for (int round = 0; round < kMaxRounds && !todo.empty(); ++round) {
    context.monitor.check_cancelled();
    std::vector<Index> touched;
    for (const Index tri : todo) {
      if (is_sound(tri)) continue;
      const auto& v = mesh.triangle(tri).vertex;
      const Vec3 p =
          surface.ball_centre(mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]));
      const Index vertex =
          insert_vertex(mesh, surface, {p.x(), p.y(), p.z(), spacing.at(p.x(), p.y(), p.z())}, tri);
      if (vertex == kNone) continue;
      ++report.n_inserted;
      append_star(mesh, vertex, mesh.n_triangles() - 1, touched);
    }
    make_unique(touched);
    suspects.insert(suspects.end(), touched.begin(), touched.end());
    todo = std::move(touched);
  }
  make_unique(suspects);
  for (const Index tri : suspects) {
    const Violation broken = violation(options, mesh, tri);
    report.n_over_size += broken.over_size ? 1 : 0;
    report.n_over_radius_edge += broken.over_radius_edge ? 1 : 0;
  }
  return report;
}

}  // namespace delos
