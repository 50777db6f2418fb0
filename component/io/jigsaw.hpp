// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The .msh files of JIGSAW: text, "MSHID=3;...".
#include <string>

#include "io/triangle_set.hpp"

namespace delos {

/// As ELLIPSOID-MESH: radii in km, points as longitude and parametric latitude in radians,
/// triangles with ids from 0, and the spacing in km as VALUE where it is known. Atomic.
void write_jigsaw(const std::string& path, const TriangleSet& set);

/// Triangles of an ELLIPSOID-MESH, or of a EUCLIDEAN-MESH in three dimensions on a surface: that
/// of RADII, else the sphere through the points. Lengths are taken as km, the custom of that tool's
/// users. In the orientation of the file; other tables are passed over. Error(input) "file:line:
/// ...".
TriangleSet read_jigsaw(const std::string& path);

}  // namespace delos
