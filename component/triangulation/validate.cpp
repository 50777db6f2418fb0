// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/validate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "geometry/predicates.hpp"
#include "triangulation/flip.hpp"

namespace delos {
namespace {

class Validator {
 public:
  Validator(const Mesh& mesh, const Ellipsoid& surface, const ValidateOptions& options)
      : mesh_(mesh), surface_(surface), options_(options) {}

  std::vector<Defect> run() {
    check_ids();
    check_euler();
    check_vertices();
    check_duplicates();
    // The rest follows ids, which must be right for that.
    if (!defects_.empty() && has_bad_ids_) return std::move(defects_);
    check_symmetry();
    check_orientation();
    check_references();
    if (has_bad_links_) return std::move(defects_);
    check_connected();
    check_fans();
    if (options_.delaunay) check_delaunay();
    return std::move(defects_);
  }

 private:
  bool is_full() const { return defects_.size() >= options_.max_defects; }

  template <class... Parts>
  void add(DefectKind kind, Index id, Index other, const Parts&... parts) {
    if (!is_full()) defects_.push_back({kind, id, other, text(parts...)});
  }

  void check_ids() {
    const auto is_in = [](Index id, Index n) { return id >= 0 && id < n; };
    for (Index tri = 0; tri < mesh_.n_triangles() && !is_full(); ++tri) {
      const Triangle& t = mesh_.triangle(tri);
      bool good =
          t.vertex[0] != t.vertex[1] && t.vertex[1] != t.vertex[2] && t.vertex[2] != t.vertex[0];
      for (std::size_t k = 0; k < 3; ++k) {
        good = good && is_in(t.vertex[k], mesh_.n_vertices()) &&
               is_in(t.neighbour[k], mesh_.n_triangles()) && t.neighbour[k] != tri;
      }
      if (good) continue;
      has_bad_ids_ = true;
      add(DefectKind::bad_id, tri, kNone, "triangle ", tri, " has corners ", t.vertex[0], ", ",
          t.vertex[1], ", ", t.vertex[2], " and neighbours ", t.neighbour[0], ", ", t.neighbour[1],
          ", ", t.neighbour[2], "; there are ", mesh_.n_vertices(), " vertices and ",
          mesh_.n_triangles(), " triangles");
    }
  }

  void check_euler() {
    const std::int64_t wanted = 2 * static_cast<std::int64_t>(mesh_.n_vertices()) - 4;
    if (mesh_.n_triangles() == wanted && wanted >= 4) return;
    add(DefectKind::euler, kNone, kNone, mesh_.n_vertices(), " vertices and ", mesh_.n_triangles(),
        " triangles: a closed surface of genus 0 has ", std::max<std::int64_t>(wanted, 4),
        " triangles");
  }

  void check_vertices() {
    for (Index v = 0; v < mesh_.n_vertices() && !is_full(); ++v) {
      const Vec3 p = mesh_.position(v);
      // |sum (x_i / r_i)^2 - 1| / |gradient| is the distance to first order.
      const Vec3 gradient = 2 * p.cwiseProduct(surface_.inverse_square());
      const double value = p.cwiseProduct(surface_.inverse_square()).dot(p) - 1;
      const double distance = std::abs(value) / gradient.norm();
      if (distance <= options_.surface_tolerance) continue;
      add(DefectKind::off_surface, v, kNone, "vertex ", v, " at (", p.x(), ", ", p.y(), ", ", p.z(),
          ") is ", distance, " radii off the surface");
    }
  }

  void check_duplicates() {
    std::vector<Index> order(mesh_.vertices.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](Index v) {
      const Vertex& p = mesh_.vertices[at(v)];
      return std::array<double, 3>{p.x, p.y, p.z};
    };
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      const auto ka = key(a);
      const auto kb = key(b);
      return ka < kb || (ka == kb && a < b);
    });
    for (std::size_t i = 1; i < order.size() && !is_full(); ++i) {
      if (key(order[i - 1]) != key(order[i])) continue;
      add(DefectKind::duplicate, order[i - 1], order[i], "vertices ", order[i - 1], " and ",
          order[i], " are at the same position");
    }
  }

  void check_symmetry() {
    for (Index tri = 0; tri < mesh_.n_triangles() && !is_full(); ++tri) {
      const Triangle& t = mesh_.triangle(tri);
      for (int k = 0; k < 3; ++k) {
        const Index from = t.vertex[at(next_corner(k))];
        const Index to = t.vertex[at(previous_corner(k))];
        const Index other = t.neighbour[at(k)];
        const int back = side_of_edge(mesh_.triangle(other), to, from);
        if (back >= 0 && mesh_.triangle(other).neighbour[at(back)] == tri) continue;
        has_bad_links_ = true;
        add(DefectKind::asymmetric, tri, other, "triangle ", tri, " names triangle ", other,
            " across the side from vertex ", from, " to ", to, ", which does not name it back");
      }
    }
  }

  void check_orientation() {
    for (Index tri = 0; tri < mesh_.n_triangles() && !is_full(); ++tri) {
      const auto& v = mesh_.triangle(tri).vertex;
      if (predicates::orient_origin(mesh_.position(v[0]), mesh_.position(v[1]),
                                    mesh_.position(v[2])) > 0) {
        continue;
      }
      add(DefectKind::orientation, tri, kNone, "triangle ", tri, " with corners ", v[0], ", ", v[1],
          ", ", v[2], " is not counter-clockwise seen from outside");
    }
  }

  void check_references() {
    const std::vector<Index> one_of = triangle_at_vertex(mesh_);
    for (Index v = 0; v < mesh_.n_vertices() && !is_full(); ++v) {
      if (one_of[at(v)] == kNone) {
        add(DefectKind::unreferenced, v, kNone, "vertex ", v, " is a corner of no triangle");
      }
    }
  }

  void check_connected() {
    std::vector<char> seen(mesh_.triangles.size(), 0);
    std::vector<Index> stack;
    if (!seen.empty()) {
      seen[0] = 1;
      stack.push_back(0);
    }
    std::size_t n_seen = stack.size();
    while (!stack.empty()) {
      const Triangle& t = mesh_.triangle(stack.back());
      stack.pop_back();
      for (const Index neighbour : t.neighbour) {
        if (seen[at(neighbour)]) continue;
        seen[at(neighbour)] = 1;
        ++n_seen;
        stack.push_back(neighbour);
      }
    }
    if (n_seen == seen.size()) return;
    const auto first = std::find(seen.begin(), seen.end(), 0) - seen.begin();
    add(DefectKind::disconnected, static_cast<Index>(first), kNone, seen.size() - n_seen,
        " triangles, the first is ", first, ", can't be reached from triangle 0");
  }

  /// Around every vertex the triangles must be one fan: as many steps as it has corners.
  void check_fans() {
    std::vector<Index> n_corners(mesh_.vertices.size(), 0);
    for (const Triangle& t : mesh_.triangles) {
      for (const Index v : t.vertex) ++n_corners[at(v)];
    }
    const std::vector<Index> one_of = triangle_at_vertex(mesh_);
    for (Index v = 0; v < mesh_.n_vertices() && !is_full(); ++v) {
      if (one_of[at(v)] == kNone) continue;
      Index steps = 0;
      Index tri = one_of[at(v)];
      do {
        const Triangle& t = mesh_.triangle(tri);
        tri = t.neighbour[at(next_corner(corner_at(t, v)))];
        ++steps;
      } while (tri != one_of[at(v)] && steps <= n_corners[at(v)]);
      if (steps == n_corners[at(v)]) continue;
      add(DefectKind::pinched, v, kNone, "the ", n_corners[at(v)], " triangles at vertex ", v,
          " are not one fan");
    }
  }

  void check_delaunay() {
    for (Index tri = 0; tri < mesh_.n_triangles() && !is_full(); ++tri) {
      for (int side = 0; side < 3; ++side) {
        const Index other = mesh_.triangle(tri).neighbour[at(side)];
        if (other < tri || !is_illegal(mesh_, surface_, tri, side)) continue;
        add(DefectKind::not_delaunay, tri, other, "the side between triangles ", tri, " and ",
            other, " is not Delaunay");
      }
    }
  }

  const Mesh& mesh_;
  const Ellipsoid& surface_;
  const ValidateOptions& options_;
  std::vector<Defect> defects_;
  bool has_bad_ids_ = false;
  bool has_bad_links_ = false;
};

}  // namespace

const char* to_string(DefectKind kind) {
  switch (kind) {
    case DefectKind::bad_id:
      return "bad_id";
    case DefectKind::asymmetric:
      return "asymmetric";
    case DefectKind::orientation:
      return "orientation";
    case DefectKind::euler:
      return "euler";
    case DefectKind::disconnected:
      return "disconnected";
    case DefectKind::unreferenced:
      return "unreferenced";
    case DefectKind::pinched:
      return "pinched";
    case DefectKind::duplicate:
      return "duplicate";
    case DefectKind::off_surface:
      return "off_surface";
    case DefectKind::not_delaunay:
      return "not_delaunay";
  }
  return "unknown";
}

std::vector<Defect> validate(const Mesh& mesh, const Ellipsoid& surface,
                             const ValidateOptions& options) {
  return Validator(mesh, surface, options).run();
}

std::string summary(const std::vector<Defect>& defects) {
  constexpr std::size_t kShown = 5;
  std::string out;
  for (std::size_t i = 0; i < defects.size() && i < kShown; ++i) {
    out += text(to_string(defects[i].kind), ": ", defects[i].text, "\n");
  }
  if (defects.size() > kShown) out += text("and ", defects.size() - kShown, " more\n");
  return out;
}

}  // namespace delos
