// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Spring relaxation (Persson & Strang 2004; Engwirda 2015, Eq. 2).
#include "core/parallel.hpp"
#include "relax/moves.hpp"
#include "relax/target.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// One round of moves by dt * sum_j (l_ij - h_ij) e_ij, h_ij the mean of the two ends' spacings.
void spring_round(parallel::Executor& exec, const Target& target, Moving& moving, Mesh& mesh);

}  // namespace delos
