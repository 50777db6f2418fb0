// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Takes out of a mesh what patches of a part gave up.
#include "relax/patch.hpp"
#include "relax/relax.hpp"

namespace delos {

/// Puts the last vertex or triangle into each gap, so that no more is rewritten than what touches
/// those: a few triangles in place of all. at_vertex and is_free of the part follow, and
/// edits.dead_triangles is what now may hold another triangle. False, and nothing done, when the
/// last vertices are not free.
bool fill_gaps(Mesh& mesh, TriangleAtVertex& at_vertex, RelaxPart& part, MeshEdits& edits);

/// compact(); is_free of the part follows.
void compact_part(parallel::Executor& exec, Mesh& mesh, RelaxPart& part, MeshEdits& edits);

}  // namespace delos
