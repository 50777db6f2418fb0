// SPDX-License-Identifier: BSD-3-Clause
#include "io/triangle_set.hpp"

#include <algorithm>
#include <string>

#include "core/error.hpp"

namespace delos {
namespace {

// Published files hold as few as seven digits.
constexpr double kOffSurface = 1e-6;

/// The sphere through the points, by their mean distance from the centre.
Ellipsoid sphere_through(const Array<Vec3>& points) {
  double sum = 0.0;
  for (const Vec3& p : points) sum += p.norm();
  const double radius_m = points.empty() ? 0.0 : sum / static_cast<double>(points.size());
  return radius_m > 0.0 ? Ellipsoid::sphere(radius_m) : Ellipsoid();
}

/// The two ends of each side of each triangle, the lower one first, in order.
std::vector<std::array<Index, 2>> sorted_sides(std::span<const std::array<Index, 3>> corners) {
  std::vector<std::array<Index, 2>> sides;
  sides.reserve(3 * corners.size());
  for (const auto& corner : corners) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = corner[k], b = corner[(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

}  // namespace

TriangleSet triangle_set(const Ellipsoid& surface, LatitudeKind latitude, const Mesh& mesh) {
  TriangleSet out;
  out.surface = surface;
  out.latitude = latitude;
  out.position.reserve(mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) out.position.push_back(vertex.position());
  out.corners.reserve(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) out.corners.push_back(triangle.vertex);
  const bool has_spacing = std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                                       [](const Vertex& vertex) { return vertex.spacing > 0.0; });
  if (!has_spacing) return out;
  out.spacing_m.reserve(mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) {
    out.spacing_m.push_back(vertex.spacing * surface.scale_m());
  }
  return out;
}

void settle_on_surface(const std::string& path, TriangleSet& set) {
  if (!set.surface) set.surface = sphere_through(set.position);
  const Ellipsoid& surface = *set.surface;
  for (std::size_t i = 0; i < set.position.size(); ++i) {
    const Vec3 scaled = set.position[i] / surface.scale_m();
    const bool is_near = scaled.allFinite() && scaled.norm() > kOffSurface &&
                         (surface.project(scaled) - scaled).norm() <= kOffSurface;
    DELOS_CHECK(is_near, ErrorKind::input, path, ": point ", i + 1, " (from 1) at ",
                set.position[i].x(), " ", set.position[i].y(), " ", set.position[i].z(),
                " is not on the surface with radii ", surface.radii().x() * surface.scale_m(), " ",
                surface.radii().y() * surface.scale_m(), " ",
                surface.radii().z() * surface.scale_m(), " m. Give a mesh of a surface.");
    set.position[i] = scaled;
  }
}

std::int64_t orient(TriangleSet& set) {
  std::int64_t n_turned = 0;
  for (auto& corner : set.corners) {
    const auto at = [&](std::size_t k) -> const Vec3& {
      return set.position[static_cast<std::size_t>(corner[k])];
    };
    const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0));
    if (normal.dot(at(0) + at(1) + at(2)) >= 0.0) continue;
    std::swap(corner[1], corner[2]);
    ++n_turned;
  }
  return n_turned;
}

void drop_lone_points(TriangleSet& set) {
  std::vector<Index> new_id(set.position.size(), kNone);
  for (const auto& corner : set.corners) {
    for (const Index point : corner) new_id[static_cast<std::size_t>(point)] = 0;
  }
  std::size_t n = 0;
  for (std::size_t i = 0; i < new_id.size(); ++i) {
    if (new_id[i] == kNone) continue;
    set.position[n] = set.position[i];
    for (std::vector<double>* values : {&set.spacing_m, &set.depth_m}) {
      if (!values->empty()) (*values)[n] = (*values)[i];
    }
    new_id[i] = static_cast<Index>(n++);
  }
  set.position.resize(n);
  for (std::vector<double>* values : {&set.spacing_m, &set.depth_m}) {
    if (!values->empty()) values->resize(n);
  }
  for (auto& corner : set.corners) {
    for (Index& point : corner) point = new_id[static_cast<std::size_t>(point)];
  }
}

std::vector<char> border_points(const TriangleSet& set) {
  std::vector<char> out(set.position.size(), 0);
  const auto sides = sorted_sides(set.corners);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t next = i + 1;
    while (next < sides.size() && sides[next] == sides[i]) ++next;
    if (next == i + 1) {
      for (const Index point : sides[i]) out[static_cast<std::size_t>(point)] = 1;
    }
    i = next;
  }
  return out;
}

bool is_closed(std::span<const std::array<Index, 3>> corners) {
  const auto sides = sorted_sides(corners);
  for (std::size_t i = 0; i < sides.size(); i += 2) {
    if (i + 1 == sides.size() || sides[i] != sides[i + 1]) return false;
    if (i + 2 < sides.size() && sides[i] == sides[i + 2]) return false;
  }
  return !sides.empty();
}

}  // namespace delos
