// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/certificate.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

#include "metrics/passes.hpp"

namespace delos {
namespace {

using metrics::Subject;

void check_finite(const char* name, const Extreme& extreme) {
  DELOS_CHECK(std::isfinite(extreme.value) && std::isfinite(extreme.where.lon_rad) &&
                  std::isfinite(extreme.where.lat_rad) && extreme.id != kNone,
              ErrorKind::internal, "the certificate's ", name, " is ", extreme.value,
              ": it must be a number at an element; measure the quality of a closed mesh first.");
}

template <class... Values>
std::string formatted(const char* format, const Values&... values) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

// One edge of the mesh with its two triangles alone (one, where a border has no more), which is all
// that its measures depend on.
struct EdgePatch {
  Mesh mesh;
  std::vector<Vec3> centre;  // of the two, where a border gives them
  Index tri;                 // in the whole mesh, of triangle 0 here
  int side;
};

std::optional<std::pair<Index, int>> find_side(const Mesh& mesh, Index a, Index b) {
  for (Index tri = 0; tri < mesh.n_triangles(); ++tri) {
    const Triangle& triangle = mesh.triangle(tri);
    for (int k = 0; k < 3; ++k) {
      const Index from = triangle.vertex[at(next_corner(k))];
      const Index to = triangle.vertex[at(previous_corner(k))];
      if (std::min(from, to) == a && std::max(from, to) == b) return {{tri, k}};
    }
  }
  return std::nullopt;
}

std::optional<EdgePatch> edge_patch(const CertifiedMesh& subject, Index a, Index b) {
  const Mesh& mesh = subject.mesh;
  if (a < 0 || b < 0) return std::nullopt;
  const auto found = find_side(mesh, a, b);
  if (!found) return std::nullopt;
  const auto [tri, side] = *found;
  EdgePatch out{{}, {}, tri, side};
  std::vector<Index> ids;
  const auto local = [&](Index vertex) {
    if (vertex == kNone) return kNone;
    const auto known = std::find(ids.begin(), ids.end(), vertex);
    if (known != ids.end()) return static_cast<Index>(known - ids.begin());
    ids.push_back(vertex);
    out.mesh.vertices.push_back(mesh.vertices[at(vertex)]);
    return static_cast<Index>(ids.size() - 1);
  };
  const auto add = [&](Index from) {
    Triangle copy{{}, {kNone, kNone, kNone}};
    for (std::size_t k = 0; k < 3; ++k) copy.vertex[k] = local(mesh.triangle(from).vertex[k]);
    out.mesh.triangles.push_back(copy);
    if (subject.border != nullptr && !subject.border->centre.empty()) {
      out.centre.push_back(subject.border->centre[at(from)]);
    }
  };
  add(tri);
  const Index beyond = mesh.triangle(tri).neighbour[at(side)];
  if (beyond == kNone) return out;
  add(beyond);
  out.mesh.triangles[0].neighbour[at(side)] = 1;
  out.mesh.triangles[1].neighbour[at(side_towards(mesh.triangle(beyond), tri))] = 0;
  return out;
}

struct EdgeValues {
  double relative_edge, dual_ratio, stagger;
};

std::optional<EdgeValues> values_at_edge(Context& context, const CertifiedMesh& subject, Index a,
                                         Index b) {
  const auto patch = edge_patch(subject, a, b);
  if (!patch) return std::nullopt;
  SideSpacing spacing;
  if (subject.spacing) {
    spacing = [&](Index, int) { return subject.spacing(patch->tri, patch->side); };
  }
  const MeshBorder border{patch->centre, nullptr};
  const Subject alone{subject.surface, patch->mesh, nullptr, &spacing,
                      subject.border != nullptr ? &border : nullptr};
  metrics::Workspace work;
  measure_triangles(context.exec, alone, work);
  const metrics::EdgeSums sums = measure_side(alone, work, 0, patch->side);
  return EdgeValues{sums.relative_min.value, sums.dual_ratio_min.value, sums.stagger_max.value};
}

double angle_at_triangle(Context& context, const CertifiedMesh& subject, Index tri) {
  Mesh alone;
  for (const Index corner : subject.mesh.triangle(tri).vertex) {
    alone.vertices.push_back(subject.mesh.vertices[at(corner)]);
  }
  alone.triangles = {{{0, 1, 2}, {kNone, kNone, kNone}}};
  metrics::Workspace work;
  return measure_triangles(context.exec, {subject.surface, alone}, work).angle_max.value;
}

/// Compares a recorded certificate with the mesh, entry by entry.
class Comparison {
 public:
  Comparison(Context& context, const CertifiedMesh& subject, const Quality& quality)
      : context_(context),
        subject_(subject),
        quality_(quality),
        tolerance_(rounding_tolerance(subject.surface, quality)) {}

  std::vector<std::string> defects(const Certificate& recorded) {
    compare_counts(recorded);
    compare_triangle("angle_max", recorded.angle_max_deg, quality_.angle_max_deg);
    compare_edge("dual_ratio_min", recorded.dual_ratio_min, quality_.dual_ratio_min,
                 &EdgeValues::dual_ratio);
    compare_edge("stagger_max", recorded.stagger_max, quality_.stagger_max, &EdgeValues::stagger);
    if (recorded.relative_edge_min && quality_.knows_spacing) {
      compare_edge("relative_edge_min", *recorded.relative_edge_min, quality_.relative_edge_min,
                   &EdgeValues::relative_edge);
    } else if (recorded.relative_edge_min) {
      add("relative_edge_min", text("is ", recorded.relative_edge_min->value,
                                    ", but the file does not say the wanted spacing at the edges"));
    }
    return std::move(defects_);
  }

 private:
  template <class... Parts>
  void add(const char* name, const Parts&... parts) {
    defects_.push_back(text("recorded certificate: ", name, " ", parts..., "."));
  }
  bool is_same(double recorded, double measured) const {
    return std::abs(recorded - measured) <= tolerance_ * std::max(1.0, std::abs(measured));
  }

  void compare_counts(const Certificate& recorded) {
    // A right angle in the grid may be acute or obtuse after rounding.
    if (std::abs(recorded.n_obtuse - quality_.n_obtuse) > quality_.n_right) {
      add("n_obtuse", "is ", recorded.n_obtuse, ", the arrays have ", quality_.n_obtuse);
    }
    const auto n = static_cast<double>(quality_.n_triangles);
    const double fraction = 1.0 - static_cast<double>(recorded.n_obtuse) / n;
    if (!(std::abs(recorded.well_centred - fraction) < 0.5 / n)) {
      add("well_centred", "is ", recorded.well_centred, " of the triangles, but ",
          recorded.n_obtuse, " obtuse ones of ", quality_.n_triangles, " make ", fraction);
    }
  }

  /// The worst of all, then the element that is said to be it.
  void compare_values(const char* name, const Extreme& recorded, const Extreme& measured,
                      double there) {
    if (!is_same(recorded.value, measured.value)) {
      add(name, "is ", recorded.value, ", the arrays give ", measured.value, " at ",
          describe(measured));
    } else if (!is_same(there, recorded.value)) {
      add(name, "is ", recorded.value, " at ", describe(recorded), ", but that element has ",
          there);
    }
  }

  void compare_place(const char* name, const Extreme& recorded, const Vec3& towards) {
    const Vec3 place = subject_.surface.project(towards);
    const Vec3 said = subject_.surface.point(recorded.where, subject_.latitude);
    constexpr double kNear = 1e-7;  // of a radius: below a metre on Earth
    if ((place - said).norm() <= kNear) return;
    Extreme real = recorded;
    real.where = subject_.surface.lon_lat(place, subject_.latitude);
    add(name, "is said to be at ", describe(recorded), ", but that element is at ", describe(real));
  }

  Vec3 position(Index cell) const { return subject_.mesh.position(cell); }

  void compare_triangle(const char* name, const Extreme& recorded, const Extreme& measured) {
    const Subject whole{subject_.surface, subject_.mesh, nullptr, nullptr, subject_.border};
    if (recorded.id < 0 || recorded.id >= subject_.mesh.n_triangles() ||
        !whole.is_whole(recorded.id)) {
      add(name, "is said to be at ", describe(recorded), ", which is not there");
      return;
    }
    compare_values(name, recorded, measured, angle_at_triangle(context_, subject_, recorded.id));
    const auto& corner = subject_.mesh.triangle(recorded.id).vertex;
    compare_place(name, recorded, position(corner[0]) + position(corner[1]) + position(corner[2]));
  }

  void compare_edge(const char* name, const Extreme& recorded, const Extreme& measured,
                    double EdgeValues::*value) {
    const auto there = values_at_edge(context_, subject_, recorded.id, recorded.other);
    if (!there) {
      add(name, "is said to be at ", describe(recorded), ", which is not there");
      return;
    }
    compare_values(name, recorded, measured, (*there).*value);
    compare_place(name, recorded, position(recorded.id) + position(recorded.other));
  }

  Context& context_;
  const CertifiedMesh& subject_;
  const Quality& quality_;
  double tolerance_;
  std::vector<std::string> defects_;
};

}  // namespace

Certificate certificate(const Quality& quality) {
  DELOS_CHECK(quality.n_triangles > 0, ErrorKind::internal,
              "a grid without triangles has no certificate; measure the quality of a closed mesh "
              "first.");
  Certificate out{quality.well_centred,   quality.n_obtuse,    quality.angle_max_deg,
                  quality.dual_ratio_min, quality.stagger_max, std::nullopt};
  check_finite("angle_max", out.angle_max_deg);
  check_finite("dual_ratio_min", out.dual_ratio_min);
  check_finite("stagger_max", out.stagger_max);
  if (quality.knows_spacing) {
    check_finite("relative_edge_min", quality.relative_edge_min);
    out.relative_edge_min = quality.relative_edge_min;
  }
  return out;
}

std::string describe(const Extreme& extreme) {
  const std::int64_t id = std::int64_t{extreme.id} + 1, other = std::int64_t{extreme.other} + 1;
  const std::string name = extreme.element == Element::edge
                               ? text("the edge of cells ", id, " and ", other)
                           : extreme.element == Element::triangle ? text("triangle ", id)
                                                                  : text("cell ", id);
  return name + formatted(" (from 1), lon %.6f, lat %.6f deg", extreme.where.lon_rad * kDegPerRad,
                          extreme.where.lat_rad * kDegPerRad);
}

std::vector<std::string> certificate_text(const Certificate& certificate) {
  std::vector<std::string> out;
  const double angle_deg = certificate.angle_max_deg.value;
  out.push_back(
      certificate.is_well_centred()
          ? formatted("well centred: every triangle acute, largest angle %.2f degrees", angle_deg)
          : formatted("NOT well centred: %lld obtuse (%.3g %%), up to %.2f degrees",
                      static_cast<long long>(certificate.n_obtuse),
                      100.0 * (1.0 - certificate.well_centred), angle_deg));
  if (!certificate.relative_edge_min) {
    out.emplace_back("spacing not known: the file does not say what was wanted");
    return out;
  }
  const double relative = certificate.relative_edge_min->value;
  out.push_back(certificate.keeps_spacing()
                    ? formatted("spacing kept: every edge at least %.4f of the wanted (bound %.2f)",
                                relative, kRelativeEdgeBound)
                    : formatted("spacing NOT kept: an edge is %.4f of the wanted (bound %.2f)",
                                relative, kRelativeEdgeBound));
  return out;
}

// Coordinates in a file are good to some units in the last place (of a radius). That tilts a
// triangle by its share of the edge, and so moves the ball's centre, whose distance is measured in
// edges again: the error of a dual edge goes with 1 / edge^2.
double rounding_tolerance(const Ellipsoid& surface, const Quality& quality) {
  constexpr double kLeast = 1e-9, kUnits = 100.0;
  const double edge = quality.edge_length_min_m / surface.scale_m();
  return kLeast + kUnits * std::numeric_limits<double>::epsilon() / (edge * edge);
}

std::vector<std::string> certificate_defects(Context& context, const CertifiedMesh& subject,
                                             const Quality& quality, const Certificate& recorded) {
  return Comparison(context, subject, quality).defects(recorded);
}

}  // namespace delos
