// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Mends one patch: by moving its vertices and, where that stalls, by taking one out or putting one
// in.
#include "relax/patch.hpp"
#include "relax/target.hpp"

namespace delos {

struct RepairOptions {
  double enough = 0.94;          ///< score that every triangle is to reach
  bool change_topology = false;  ///< whether vertices may be removed and inserted
};

/// Improves the patch; its worst score never falls. False when nothing could be gained (the patch
/// is then as it was).
bool repair_patch(const Target& target, const RepairOptions& options, Patch& patch);

}  // namespace delos
