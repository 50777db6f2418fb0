// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Gmsh's mesh files, version 4.1, in ASCII.
#include <string>

#include "io/triangle_set.hpp"

namespace delos {

/// The triangles as one surface entity over points in metres, tags from 1; where known the spacing
/// and the depth as $NodeData "spacing_m" and "depth_m"; the surface as
/// $Comments "delos_radii_m A B C" and "delos_latitude KIND". Atomic.
void write_gmsh(const std::string& path, const TriangleSet& set);

/// Triangles of any ASCII file of version 4.1, as they stand there; points and lines beside
/// them and sections of other programs are passed over, node tags may have gaps. Without our
/// comments the surface is the sphere through the points. Error(input) "file:line: ...".
TriangleSet read_gmsh(const std::string& path);

}  // namespace delos
