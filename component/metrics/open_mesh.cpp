// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/open_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "core/elementary.hpp"
#include "core/error.hpp"

namespace delos {
namespace {

constexpr std::size_t kMaxDefects = 20;  // that are told of one kind
constexpr double kRightAngleDeg = 90.0;

/// One side of a triangle, its lower end first.
struct Side {
  Index low, high, tri;
  bool is_upward;  ///< passed from the lower end to the higher
  bool operator<(const Side& other) const {
    return std::tie(low, high, tri) < std::tie(other.low, other.high, other.tri);
  }
  bool joins_same(const Side& other) const { return low == other.low && high == other.high; }
};

class OpenMesh {
 public:
  OpenMesh(const Ellipsoid& surface, std::span<const Vec3> position,
           std::span<const std::array<Index, 3>> corners)
      : surface_(surface), position_(position), corners_(corners) {}

  OpenMeshReport report();

 private:
  void note(std::size_t& n_told, const std::string& sentence) {
    if (++n_told <= kMaxDefects) out_.defects.push_back(sentence);
  }
  void look_at_points();
  void look_at_triangles();
  void look_at_edges();
  Index root_of(Index tri);
  double angle_deg(const std::array<Index, 3>& corner, std::size_t k) const;

  const Ellipsoid& surface_;
  std::span<const Vec3> position_;
  std::span<const std::array<Index, 3>> corners_;
  std::vector<Index> parent_;  // of a triangle in its part
  OpenMeshReport out_;
};

void OpenMesh::look_at_points() {
  std::vector<char> is_used(position_.size(), 0);
  for (const auto& corner : corners_) {
    for (const Index point : corner) is_used[at(point)] = 1;
  }
  std::size_t n_told = 0;
  for (std::size_t i = 0; i < is_used.size(); ++i) {
    if (is_used[i] == 0) note(n_told, text("point ", i + 1, " belongs to no triangle"));
  }
}

/// Plane angle at corner k.
double OpenMesh::angle_deg(const std::array<Index, 3>& corner, std::size_t k) const {
  const Vec3 p = position_[at(corner[k])];
  const Vec3 a = position_[at(corner[(k + 1) % 3])] - p;
  const Vec3 b = position_[at(corner[(k + 2) % 3])] - p;
  return elementary::atan2(a.cross(b).norm(), a.dot(b)) * kDegPerRad;
}

void OpenMesh::look_at_triangles() {
  out_.angle_min_deg = 180.0;
  std::size_t n_degenerate = 0, n_clockwise = 0;
  const double square_m = surface_.scale_m() * surface_.scale_m();
  for (std::size_t tri = 0; tri < corners_.size(); ++tri) {
    const auto& corner = corners_[tri];
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) {
      note(n_degenerate, text("triangle ", tri + 1, " has two equal corners"));
      continue;
    }
    const double area = surface_.triangle_area(position_[at(corner[0])], position_[at(corner[1])],
                                               position_[at(corner[2])]);
    if (area <= 0.0) note(n_clockwise, text("triangle ", tri + 1, " is flat or clockwise"));
    out_.area_m2 += square_m * area;
    double largest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double angle = angle_deg(corner, k);
      out_.angle_min_deg = std::min(out_.angle_min_deg, angle);
      largest = std::max(largest, angle);
    }
    out_.angle_max_deg = std::max(out_.angle_max_deg, largest);
    out_.n_obtuse += largest >= kRightAngleDeg ? 1 : 0;
  }
}

Index OpenMesh::root_of(Index tri) {
  while (parent_[at(tri)] != tri) {
    parent_[at(tri)] = parent_[at(parent_[at(tri)])];
    tri = parent_[at(tri)];
  }
  return tri;
}

void OpenMesh::look_at_edges() {
  std::vector<Side> sides;
  sides.reserve(3 * corners_.size());
  for (std::size_t tri = 0; tri < corners_.size(); ++tri) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = corners_[tri][k], b = corners_[tri][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(tri), a < b});
    }
  }
  std::sort(sides.begin(), sides.end());
  parent_.resize(corners_.size());
  std::iota(parent_.begin(), parent_.end(), 0);
  std::size_t n_crowded = 0, n_turned = 0;
  double sum_m = 0.0;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t next = i + 1;
    for (; next < sides.size() && sides[next].joins_same(sides[i]); ++next) {
      parent_[at(root_of(sides[next].tri))] = root_of(sides[i].tri);
    }
    const Side& side = sides[i];
    const auto edge = [&side] {
      return text("the edge of points ", side.low + 1, " and ", side.high + 1);
    };
    if (next - i > 2) note(n_crowded, text(edge(), " has ", next - i, " triangles"));
    if (next - i == 2 && side.is_upward == sides[i + 1].is_upward) {
      note(n_turned, text(edge(), " is passed in one direction by both its triangles"));
    }
    out_.n_border_edges += next - i == 1 ? 1 : 0;
    const double length_m =
        surface_.scale_m() * surface_.arc_length(position_[at(side.low)], position_[at(side.high)]);
    out_.edge_min_m = out_.n_edges == 0 ? length_m : std::min(out_.edge_min_m, length_m);
    out_.edge_max_m = std::max(out_.edge_max_m, length_m);
    sum_m += length_m;
    ++out_.n_edges;
    i = next;
  }
  out_.edge_mean_m = out_.n_edges > 0 ? sum_m / static_cast<double>(out_.n_edges) : 0.0;
  for (std::size_t tri = 0; tri < parent_.size(); ++tri) {
    out_.n_parts += at(parent_[tri]) == tri ? 1 : 0;
  }
}

OpenMeshReport OpenMesh::report() {
  out_.n_points = static_cast<std::int64_t>(position_.size());
  out_.n_triangles = static_cast<std::int64_t>(corners_.size());
  look_at_points();
  look_at_triangles();
  look_at_edges();
  return std::move(out_);
}

}  // namespace

OpenMeshReport measure_open_mesh(const Ellipsoid& surface, std::span<const Vec3> position,
                                 std::span<const std::array<Index, 3>> corners) {
  return OpenMesh(surface, position, corners).report();
}

std::string report_text(const OpenMeshReport& report) {
  constexpr double kKm = 1000.0;
  return text("points     ", report.n_points, "\ntriangles  ", report.n_triangles, ", ",
              report.n_obtuse, " obtuse\nedges      ", report.n_edges, ", ", report.n_border_edges,
              " of them on the border\nparts      ", report.n_parts, "\narea       ",
              report.area_m2 / (kKm * kKm), " km2\nangles     ", report.angle_min_deg, " to ",
              report.angle_max_deg, " deg\nlengths    ", report.edge_min_m / kKm, " to ",
              report.edge_max_m / kKm, " km, mean ", report.edge_mean_m / kKm, " km\n");
}

}  // namespace delos
