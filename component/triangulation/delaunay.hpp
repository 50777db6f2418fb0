// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Points to their Delaunay triangulation: on a convex surface around the origin that is the
// convex hull, which on the sphere has every circumcircle empty.
#include <cstdint>
#include <span>

#include "core/parallel.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

struct DelaunayReport {
  std::int64_t n_walk_steps = 0;         ///< triangles passed while locating
  std::int64_t n_removed = 0;            ///< triangles taken out by cavities
  std::int64_t n_exact = 0;              ///< predicates that the static filter left undecided
  std::int64_t n_orientation_walks = 0;  ///< locations that the walk over planes did not end
};

/// Vertex i of the mesh is point i, its spacing 0. Ties are broken by index
/// (predicates::in_circle), so that the set of triangles depends on the points alone; their order
/// too, being that of serial insertion along a Hilbert curve.
///
/// Error(input), naming the indices, for a coordinate that is not finite, two equal points (or two
/// so close, about 1e-8 radii, that rounding moves one inside the hull of its neighbours), and for
/// points confined to a half-space, whose hull does not enclose the origin. Error(resource) above
/// 5 * 10^8 points.
Mesh delaunay(parallel::Executor& exec, std::span<const Vec3> points,
              DelaunayReport* report = nullptr);

}  // namespace delos
