// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The outline of a region as lines that the grid keeps, so that its rings run along it.
#include <string>
#include <vector>

#include "geometry/ellipsoid.hpp"
#include "refine/given_line.hpp"
#include "sizing/region.hpp"
#include "sizing/spacing.hpp"

namespace delos {

struct Outline {
  std::vector<GivenLine> rings;  ///< of points one spacing apart
  std::string refusal;           ///< why there are none: the grid can't keep them
};

/// What a grid of this spacing can follow of the region's outline: rounded where it turns within
/// some cells. No rings, and the reason with a place, where it comes nearer to itself than a grid
/// needs for its triangles.
Outline outline_of(const Ellipsoid& surface, LatitudeKind latitude, const RegionShape& region,
                   const SpacingField& spacing);

}  // namespace delos
