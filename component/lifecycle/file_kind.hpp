// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The kinds of grid files and their names.
#include <string>
#include <vector>

namespace delos {

enum class FileKind {
  mpas,
  ugrid_triangles,
  ugrid_cells,
  scrip,
  esmf,
  vtu,
  gmsh,
  jigsaw,
  fesom  ///< a folder with three files
};

/// As `output.formats` and `--to` name them, in the order of FileKind.
inline std::vector<std::string> file_kind_names() {
  return {"mpas", "ugrid_triangles", "ugrid_cells", "scrip", "esmf", "vtu",
          "gmsh", "jigsaw",          "fesom"};
}

/// What follows the name of a grid, "mpas.nc", "vtu", ..., in the order of FileKind.
inline std::vector<std::string> file_endings() {
  return {"mpas.nc", "ugrid_triangles.nc", "ugrid_cells.nc", "scrip.nc", "esmf.nc",
          "vtu",     "gmsh.msh",           "jigsaw.msh",     "fesom"};
}
inline std::string file_ending(FileKind kind) {
  return file_endings()[static_cast<std::size_t>(kind)];
}

/// Whether the file holds Voronoi cells, for which the dual is needed.
inline bool holds_cells(FileKind kind) {
  return kind == FileKind::mpas || kind == FileKind::ugrid_cells || kind == FileKind::scrip ||
         kind == FileKind::esmf || kind == FileKind::vtu;
}

}  // namespace delos
