// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Towards a centroidal grid, each generator the centre of mass of its Voronoi cell, by Lloyd's
// method (Lloyd 1982, doi:10.1109/TIT.1982.1056489; Du, Faber & Gunzburger 1999,
// doi:10.1137/S0036144599352836; on the sphere Ringler, Ju & Gunzburger 2008,
// doi:10.1007/s10236-008-0157-2).
#include "core/parallel.hpp"
#include "relax/moves.hpp"
#include "relax/target.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// The centre of mass of the Voronoi cell of a row's vertex, as a point near the surface, for the
/// density h^-4, with which centroidal cells have spacings in proportion to h (Du et al., section
/// 4.3); between the corners of the triangles (generator, corner, corner) it is linear. Of a
/// vertex of more than eight neighbours: the vertex.
Vec3 cell_centroid(const Ellipsoid& surface, const Array<Vertex>& vertices,
                   const NeighbourRows& rows, Index place);

/// How a run of that many rounds carries the last move on. A swing fades by the root of the
/// momentum in a round, so that of the first offsets e^-5, less than one per cent, is left of what
/// swings.
double centroidal_momentum(int n_rounds);

/// One round of moves to the centroids. The mesh must be Delaunay before each.
void centroidal_round(parallel::Executor& exec, const Target& target, double momentum,
                      Moving& moving, Mesh& mesh);

}  // namespace delos
