// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Moves the free vertices of a patch so that its worst triangle gets better (worst element first:
// Freitag & Ollivier-Gooch 1997; Engwirda 2017, GMD 10, 2117, section 4).
#include "relax/patch.hpp"
#include "relax/target.hpp"

namespace delos {

struct ClimbOptions {
  double enough = 0.94;  ///< score above which a star is left alone
  int sweeps = 12;       ///< over all free vertices, at most
};

/// A vertex moves only where the worst score of its star rises. Connectivity stays.
void hill_climb(const Target& target, const ClimbOptions& options, Patch& patch);

struct SpringOptions {
  int sweeps = 12;
  /// A move is made only where the star's worst score stays above this, or rises.
  double floor = 0.0;
};

/// Spring sweeps over the free vertices, one after the other (Gauss-Seidel).
void relax_patch(const Target& target, const SpringOptions& options, Patch& patch);

}  // namespace delos
