// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Small closed meshes made without the engine: bisected Platonic solids, shaken and made Delaunay.
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/hash.hpp"
#include "geometry/ellipsoid.hpp"
#include "triangulation/mesh.hpp"

namespace delos::samples {

using Corners = std::vector<std::array<Index, 3>>;

/// Mesh of the given points and triangles, neighbours found by their sides.
inline Mesh connect(const std::vector<Vec3>& points, const Corners& corners, double spacing) {
  Mesh mesh;
  for (const Vec3& p : points) mesh.vertices.push_back({p.x(), p.y(), p.z(), spacing});
  std::map<std::pair<Index, Index>, Index> triangle_left_of;
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      triangle_left_of[{corners[t][(k + 1) % 3], corners[t][(k + 2) % 3]}] = static_cast<Index>(t);
    }
  }
  for (const auto& corner : corners) {
    Triangle triangle{corner, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.neighbour[k] = triangle_left_of.at({corner[(k + 2) % 3], corner[(k + 1) % 3]});
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

/// Turns a flat-faced polyhedron's quadrilaterals or triangles outward.
inline Corners outward(const std::vector<Vec3>& points, Corners corners) {
  const auto at = [&](Index i) { return points[static_cast<std::size_t>(i)]; };
  for (auto& c : corners) {
    if (at(c[0]).dot((at(c[1]) - at(c[0])).cross(at(c[2]) - at(c[0]))) < 0.0) std::swap(c[1], c[2]);
  }
  return corners;
}

inline std::pair<std::vector<Vec3>, Corners> icosahedron() {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vec3> points;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-g, g}) {
      points.insert(points.end(), {Vec3(0, s, t), Vec3(s, t, 0), Vec3(t, 0, s)});
    }
  }
  Corners corners;
  const auto near = [&](std::size_t i, std::size_t j) {
    return std::abs((points[i] - points[j]).norm() - 2.0) < 1e-9;
  };
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = i + 1; j < 12; ++j) {
      for (std::size_t k = j + 1; k < 12; ++k) {
        if (near(i, j) && near(j, k) && near(i, k)) {
          corners.push_back({static_cast<Index>(i), static_cast<Index>(j), static_cast<Index>(k)});
        }
      }
    }
  }
  return {points, outward(points, corners)};
}

/// Every triangle into four, `levels` times; points on the surface.
inline Mesh bisected_icosahedron(const Ellipsoid& surface, int levels) {
  auto solid = icosahedron();
  std::vector<Vec3>& points = solid.first;
  Corners& corners = solid.second;
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<Index, Index>, Index> middle;
    const auto halve = [&](Index a, Index b) {
      const auto key = std::minmax(a, b);
      const auto [found, is_new] = middle.try_emplace(key, static_cast<Index>(points.size()));
      if (is_new) {
        const Vec3 p = points[static_cast<std::size_t>(a)].normalized();
        const Vec3 q = points[static_cast<std::size_t>(b)].normalized();
        points.push_back(Vec3((p + q).normalized()));
      }
      return found->second;
    };
    Corners finer;
    for (const auto& [a, b, c] : corners) {
      const Index ab = halve(a, b), bc = halve(b, c), ca = halve(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    corners = std::move(finer);
  }
  for (Vec3& p : points) p = surface.project(p.normalized().cwiseProduct(surface.radii()));
  const double spacing = std::sqrt(8.0 * kPi / std::sqrt(3.0) / static_cast<double>(points.size()));
  return connect(points, corners, spacing);
}

/// cot(angle at o) + cot(angle at p) over the diagonal u v.
inline double opposite_cotangents(const Vec3& u, const Vec3& v, const Vec3& o, const Vec3& p) {
  const auto cotangent = [&](const Vec3& apex) {
    const Vec3 a = u - apex, b = v - apex;
    return a.dot(b) / a.cross(b).norm();
  };
  return cotangent(o) + cotangent(p);
}

/// Lawson flips of a list of corners until no diagonal prefers the other way.
inline Mesh make_delaunay(Mesh mesh) {
  const auto side_at = [&](Index tri, Index from) {
    return side_towards(mesh.triangle(tri), from);
  };
  const auto relink = [&](Index tri, Index from, Index to) {
    mesh.triangle(tri).neighbour[static_cast<std::size_t>(side_at(tri, from))] = to;
  };
  bool flipped = true;
  for (int sweep = 0; flipped && sweep < 50; ++sweep) {
    flipped = false;
    for (Index t = 0; t < mesh.n_triangles(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        Triangle& left = mesh.triangle(t);
        const Index r = left.neighbour[k];
        Triangle& right = mesh.triangle(r);
        const auto m = static_cast<std::size_t>(side_towards(right, t));
        const Index o = left.vertex[k], u = left.vertex[(k + 1) % 3], v = left.vertex[(k + 2) % 3];
        const Index p = right.vertex[m];
        if (opposite_cotangents(mesh.position(u), mesh.position(v), mesh.position(o),
                                mesh.position(p)) >= -1e-12) {
          continue;
        }
        const Index ou = left.neighbour[(k + 2) % 3], vo = left.neighbour[(k + 1) % 3];
        const Index up = right.neighbour[(m + 1) % 3], pv = right.neighbour[(m + 2) % 3];
        left = {{o, u, p}, {up, r, ou}};
        right = {{p, v, o}, {vo, t, pv}};
        relink(up, r, t);
        relink(vo, t, r);
        flipped = true;
      }
    }
  }
  return mesh;
}

/// A Delaunay mesh of the bisected icosahedron's points, each moved by up to `shake` spacings.
inline Mesh shaken(const Ellipsoid& surface, int levels, double shake, std::uint64_t seed) {
  Mesh mesh = bisected_icosahedron(surface, levels);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    Vertex& v = mesh.vertices[i];
    Vec3 step;
    for (int axis = 0; axis < 3; ++axis) {
      step[axis] = (2.0 * uniform01(seed, i, static_cast<std::uint64_t>(axis)) - 1.0) * shake;
    }
    const Vec3 p = surface.project(v.position() + v.spacing * step);
    v = {p.x(), p.y(), p.z(), v.spacing};
  }
  return make_delaunay(std::move(mesh));
}

/// The cube with split faces: cocircular corners, right angles, dual edges of no length.
inline Mesh split_cube(const Ellipsoid& surface) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back(surface.project(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  }
  const Corners corners{{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                        {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
  return connect(points, outward(points, corners), 1.0);
}

/// The smallest closed mesh.
inline Mesh tetrahedron(const Ellipsoid& surface) {
  const std::vector<Vec3> points{surface.project(Vec3(1, 1, 1)), surface.project(Vec3(1, -1, -1)),
                                 surface.project(Vec3(-1, 1, -1)),
                                 surface.project(Vec3(-1, -1, 1))};
  return connect(points, outward(points, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}), 1.6);
}

}  // namespace delos::samples
