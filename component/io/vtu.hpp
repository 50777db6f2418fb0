// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// VTK's XML unstructured grids, for ParaView and VisIt.
#include <string>

#include "dual/grid.hpp"
#include "io/triangle_set.hpp"

namespace delos {

/// The Voronoi cells as polygons over points in metres, with cell data `centre` (three), `area_m2`,
/// `spacing_m` where the grid has it, `bdyMaskCell` where it has rings; field data `delos_radii_m`
/// and `delos_latitude` (0 geodetic, 1 geocentric, 2 parametric). Binary, appended raw,
/// little-endian. Atomic.
void write_vtu_cells(const std::string& path, const Grid& grid);

/// Triangles, which may have a border, with point data `spacing_m` and `depth_m` where known.
void write_vtu_triangles(const std::string& path, const TriangleSet& set);

/// Polygons on a surface in space.
struct VtuMesh {
  TriangleSet points;           ///< positions, surface, point data; and triangles, when all are
  Ragged<Index> nodes_on_face;  ///< from 0
  Array<Vec3> centre;           ///< scaled, on the surface; empty when the file has none
  std::vector<double> cell_spacing_m;   ///< empty when the file has none
  std::vector<std::int32_t> cell_ring;  ///< Grid::cell_ring; empty when the file has none
};

/// Reads triangles and polygons in raw appended or ASCII arrays. Error(input) with the array and
/// the reason for what is compressed, in base64, of other shapes, cut off, or names what is not
/// there.
VtuMesh read_vtu(const std::string& path);

}  // namespace delos
