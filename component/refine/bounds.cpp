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

// Whether a vertex may be put at p, the centre of the ball of `seed`, as far as fixed edges go. It
// may not where it would come between the ends of one, into the circle that has the edge for its
// diameter, beyond one, or so near to a fixed vertex that ever smaller triangles would follow.
bool lines_allow(const Mesh& mesh, const BoundsInput& input, Index seed, const Vertex& p) {
  constexpr double kNearest = 0.5;  // of the spacing
  const Vec3 q = p.position();
  std::vector<Index> cavity{seed};
  for (std::size_t i = 0; i < cavity.size(); ++i) {
    const Triangle& t = mesh.triangle(cavity[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = t.vertex[static_cast<std::size_t>(next_corner(static_cast<int>(k)))];
      const Index b = t.vertex[static_cast<std::size_t>(previous_corner(static_cast<int>(k)))];
      const Vec3 to_a = mesh.position(a) - q, to_b = mesh.position(b) - q;
      const double least = kNearest * p.spacing;
      if (mesh.fixed.has_vertex(a) && to_a.squaredNorm() < least * least) return false;
      if (mesh.fixed.has_edge(a, b)) {
        if (to_a.dot(to_b) < 0.0 || !(to_a.cross(to_b).dot(q) > 0.0)) return false;
        continue;
      }
      const Index other = t.neighbour[k];
      if (std::find(cavity.begin(), cavity.end(), other) != cavity.end()) continue;
      const auto& v = mesh.triangle(other).vertex;
      const Vec3 corner = mesh.position(v[0]);
      const Vec3 centre =
          input.surface.ball_centre(corner, mesh.position(v[1]), mesh.position(v[2]));
      if ((q - centre).squaredNorm() < (corner - centre).squaredNorm()) cavity.push_back(other);
    }
  }
  return true;
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
      const Vertex added{p.x(), p.y(), p.z(), spacing.at(p.x(), p.y(), p.z())};
      if (mesh.fixed.n_vertices() > 0 && !lines_allow(mesh, input, tri, added)) continue;
      const Index vertex = insert_vertex(mesh, surface, added, tri);
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
