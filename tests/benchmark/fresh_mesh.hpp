// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "refine/refine.hpp"
#include "relax/relax.hpp"

namespace delos::benchmark {

/// Refined and relaxed with the defaults.
inline Mesh fresh_mesh(Context& context, const Ellipsoid& surface, const SpacingField& spacing) {
  RefineReport report;
  Mesh mesh = refine(context, surface, spacing, {}, report);
  relax(context, surface, spacing, {}, mesh);
  return mesh;
}

}  // namespace delos::benchmark
