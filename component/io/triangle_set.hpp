// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the files that hold triangles in space have in common (VTU, Gmsh, JIGSAW, FESOM2).
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/array.hpp"
#include "geometry/ellipsoid.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// Triangles over points of a surface, which may have a border.
struct TriangleSet {
  std::optional<Ellipsoid> surface;  ///< nothing when the file does not say
  LatitudeKind latitude = LatitudeKind::geodetic;
  Array<Vec3> position;                 ///< [n_points] scaled, on the surface
  Array<std::array<Index, 3>> corners;  ///< [n_triangles], from 0, in the order of the file
  std::vector<double> spacing_m;        ///< [n_points] asked for there; empty: not known
  std::vector<double> depth_m;          ///< [n_points] positive down; empty: not known
  std::vector<double> level_m;          ///< depths of the levels, 0 first; empty: not known
};

/// The triangles of a mesh; spacing when every vertex has one.
TriangleSet triangle_set(const Ellipsoid& surface, LatitudeKind latitude, const Mesh& mesh);

/// Positions in metres brought to the surface and scaled. Without `surface`: the sphere that they
/// are on. Error(input) naming the file and the point (from 1) that is not within a millionth
/// of the radius of it.
void settle_on_surface(const std::string& path, TriangleSet& set);

/// Turns triangles that are clockwise seen from outside; how many.
std::int64_t orient(TriangleSet& set);

/// Takes out the points that belong to no triangle; the others keep their order.
void drop_lone_points(TriangleSet& set);

/// 1 for points on an edge with a triangle on one side only, else 0.
std::vector<char> border_points(const TriangleSet& set);

/// Whether every edge has one triangle on each side.
bool is_closed(std::span<const std::array<Index, 3>> corners);
inline bool is_closed(const TriangleSet& set) { return is_closed(std::span(set.corners)); }

}  // namespace delos
