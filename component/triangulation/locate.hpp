// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The triangle of a point.
#include "triangulation/mesh.hpp"

namespace delos {

/// The triangle whose cone from the origin holds p (p on a side or corner: one of the triangles
/// there), by a walk from `start` with exact orientations. The walk needs about sqrt(n) steps from
/// afar, one or two from next door; on a mesh that is far from Delaunay it may fall back to looking
/// at all triangles. kNone only when no triangle holds p: the mesh is not closed.
Index locate(const Mesh& mesh, const Vec3& p, Index start);

}  // namespace delos
