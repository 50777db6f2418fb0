// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The two bounds that every triangle meets when refinement ends.
#include "refine/refine.hpp"

namespace delos {

struct BoundsReport {
  std::int64_t n_inserted = 0;
  std::int64_t n_over_size = 0;  ///< triangles left that break a bound
  std::int64_t n_over_radius_edge = 0;
};

/// What the bounds are measured against.
struct BoundsInput {
  const Ellipsoid& surface;
  const SpacingField& spacing;
  const RefineOptions& options;
};

/// Inserts ball centres (Chew 1993; Engwirda 2015, section 2.2) until every triangle meets
/// radius-edge <= options.radius_edge and size <= options.size_ratio * spacing, or a fixed number
/// of rounds has passed. Nothing is left over on an admissible spacing. `suspects` holds every
/// triangle that may break a bound, in any order.
BoundsReport enforce_bounds(Context& context, const BoundsInput& input, std::vector<Index> suspects,
                            Mesh& mesh);

}  // namespace delos
