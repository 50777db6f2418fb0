// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The other definition of an edge's angle that files have.
#include <optional>

#include "core/progress.hpp"
#include "dual/grid.hpp"

namespace delos {

/// Name of the rule of check_grid() that such angles break.
inline constexpr char kEdgeAngleRule[] = "the angle of an edge is that of its normal from east";

struct AnglesByLatitude {
  double worst_rad = 0.0;  ///< largest distance from the angle of the normal
  Index worst_edge = kNone;
};

/// Whether every angle, on a sphere, is arccos((lat_2 - lat_1) / dv) for an edge of length dv from
/// vertex 1 to vertex 2, with the sign of the normal's northward part: that is what the converter
/// of MPAS-Tools writes (seen in published files, to the last bits). It is the angle of the normal
/// where meridians are parallel, and differs from it by up to some dv tan(lat) elsewhere. Nothing
/// when some edge has another angle by more than `tolerance` (in the cosine). Linear.
std::optional<AnglesByLatitude> angles_by_latitude(Context& context, const Grid& grid,
                                                   double tolerance);

}  // namespace delos
