// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Relaxation: springs, repair of defects, polish of the worst triangles.
#include <cstdint>

#include "core/progress.hpp"
#include "geometry/ellipsoid.hpp"
#include "sizing/spacing.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

struct RelaxOptions {
  /// Rounds of spring relaxation (Engwirda 2015, Eq. 2) between flips.
  int spring_rounds = 10;
  /// Rounds of repair and polish at most; stops when every triangle meets the targets.
  int polish_rounds = 40;
  /// Angle (degrees) that polishing tries to bring every triangle below.
  double max_angle_deg = 82.0;
  /// Degree defects (vertices of degree <= 4 or >= 8) are removed.
  bool repair = true;
};

struct RelaxReport {
  int spring_rounds = 0;
  int polish_rounds = 0;
  std::int64_t n_flips = 0;
  std::int64_t n_removed = 0;
  std::int64_t n_inserted = 0;
  std::int64_t n_obtuse = 0;  ///< triangles with an angle >= 90 degrees at the end
};

/// Improves the mesh in place; it stays a valid Delaunay triangulation of the surface. The same
/// bits for any number of threads.
RelaxReport relax(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
                  const RelaxOptions& options, Mesh& mesh);

}  // namespace delos
