// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numbers about triangles that may have a border, as other programs write them: ocean meshes with
// coasts, say.
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "geometry/ellipsoid.hpp"

namespace delos {

struct OpenMeshReport {
  std::int64_t n_points = 0, n_triangles = 0, n_edges = 0;
  std::int64_t n_border_edges = 0;  ///< with a triangle on one side
  std::int64_t n_parts = 0;         ///< that hang together by edges
  std::int64_t n_obtuse = 0;
  double angle_min_deg = 0.0, angle_max_deg = 0.0;
  double edge_min_m = 0.0, edge_mean_m = 0.0, edge_max_m = 0.0;
  double area_m2 = 0.0;
  /// What no mesh may have, one sentence each with ids from 1: an edge with more than two triangles
  /// or passed twice in the same direction, a point of no triangle, a triangle with two equal
  /// corners, one that is clockwise seen from outside.
  std::vector<std::string> defects;
};

/// Positions scaled and on the surface, ids from 0 and in range. O(n log n).
OpenMeshReport measure_open_mesh(const Ellipsoid& surface, std::span<const Vec3> position,
                                 std::span<const std::array<Index, 3>> corners);

/// Some lines for people.
std::string report_text(const OpenMeshReport& report);

}  // namespace delos
