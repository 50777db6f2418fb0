// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a mesh is relaxed towards.
#include "geometry/ellipsoid.hpp"
#include "sizing/spacing.hpp"

namespace delos {

struct Target {
  const Ellipsoid& surface;
  const SpacingField& spacing;
};

}  // namespace delos
