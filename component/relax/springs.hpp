// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Spring relaxation (Persson & Strang 2004; Engwirda 2015, Eq. 2).
#include "core/parallel.hpp"
#include "relax/neighbours.hpp"
#include "relax/target.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// One round: x <- project(x + dt * sum_j (l_ij - h_ij) e_ij + mu * (x - x')) for every vertex at
/// once (Jacobi, so the order of evaluation can't matter), h_ij the mean of the two ends' spacings,
/// x' where the vertex was a round ago (heavy-ball momentum: Polyak 1964,
/// doi:10.1016/0041-5553(64)90137-5), the step limited to a fraction of h. Spacings are looked up
/// anew. A move that flattens a triangle or turns it over is taken back, so every triangle stays
/// counter-clockwise. `other` holds the vertices of a round ago, or nothing (no momentum then), and
/// receives the moved ones; the caller swaps it with mesh.vertices.
void spring_round(parallel::Executor& exec, const Target& target, const NeighbourRows& rows,
                  const Mesh& mesh, Array<Vertex>& other);

/// What a local relaxation may move.
struct SpringPart {
  NeighbourRows rows;            ///< of the vertices that may move
  std::vector<Index> triangles;  ///< all that have one of them as a corner
};

/// The same for a part; the other vertices stay. `other` goes by place in part.rows: where each
/// vertex was a round ago, or empty; it receives where each was before this round.
void spring_round(parallel::Executor& exec, const Target& target, const SpringPart& part,
                  Mesh& mesh, Array<Vertex>& other);

}  // namespace delos
