// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A grid file of one kind made into another.
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "lifecycle/file_kind.hpp"

namespace delos {

/// The kind that `to` names or, when it is empty, that the ending of the path stands for: .vtu,
/// .gmsh.msh or .msh, .jigsaw.msh, .scrip.nc, .esmf.nc, .mpas.nc, .ugrid_cells.nc,
/// .ugrid_triangles.nc, a folder or a name with .fesom. Error(config) for other words and endings.
FileKind file_kind_of(const std::string& path, const std::string& to);

struct Conversion {
  std::string from, to;
  FileKind kind = FileKind::mpas;
  std::string command;  ///< for the history
};

/// Reads a grid file of any kind and writes another. What the first says about its origin goes
/// along; digest and certificate are those of the grid as it was read. The layers of an ocean go
/// along between MPAS and FESOM2, those of an atmosphere from MPAS to MPAS; the other kinds hold
/// none. Grids with a border (oceans, regions): cells become any kind, with the rings of a region
/// between all kinds of cells; of triangles those between three cells go along, and no way leads
/// back from them to cells. Returns what the file has and the kind does not hold, in words.
/// Error(input) for what can't be read and for triangles with a border that are to become cells,
/// Error(output) for what the kind can't hold at all (an ellipsoid as MPAS).
std::vector<std::string> convert_grid_file(Context& context, const Conversion& conversion);

}  // namespace delos
