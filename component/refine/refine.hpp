// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Frontal-Delaunay refinement: from a spacing field to a triangulation.
#include <cstdint>

#include "core/progress.hpp"
#include "geometry/ellipsoid.hpp"
#include "refine/given_line.hpp"
#include "sizing/spacing.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

struct RefineOptions {
  /// Bound on circumradius / shortest edge (Engwirda 2015, section 2.2): 1.05 means no angle
  /// under 28.4 degrees.
  double radius_edge = 1.05;
  /// alpha: bound on sqrt(3) * circumradius / spacing.
  double size_ratio = 4.0 / 3.0;
  /// Expected vertices of a tile; part of the answer, not of the thread count.
  double tile_vertices = 36000.0;
  /// Their points become vertices and their arcs chains of edges.
  std::vector<GivenLine> lines;
};

struct RefineReport {
  std::int64_t n_tiles = 0;
  std::int64_t n_skeleton_vertices = 0;
  std::int64_t n_inserted = 0;
  std::int64_t n_flips = 0;
  /// Triangles that break a bound at the end (0 on every admissible spacing field without lines).
  std::int64_t n_over_size = 0;
  std::int64_t n_over_radius_edge = 0;
  std::int64_t n_given_points = 0;  ///< different points of the lines
  std::int64_t n_crossings = 0;     ///< vertices put where lines cross
  /// Where lines meet at less than 60 degrees, which a triangle then has to have.
  struct SharpCorner {
    Vec3 place;
    double angle_deg;
  };
  std::vector<SharpCorner> sharp_corners;
};

/// Builds the Delaunay triangulation of the whole surface whose triangles meet both bounds.
/// The same bits for any number of threads. Error(resource) when the expected count passes 32-bit
/// ids or memory, before anything is allocated.
///
/// With options.lines the mesh's first vertices are theirs (mesh.fixed): every given point to the
/// last bit, where they cross, and what follows the spacing along their arcs; no triangle crosses
/// an arc. An edge of a line may not be Delaunay and triangles beside it may break a bound, which
/// relax() mends where the lines' angles allow. Errors as make_network() and check_distances().
Mesh refine(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
            const RefineOptions& options, RefineReport& report);

}  // namespace delos
