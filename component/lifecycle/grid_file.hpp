// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Grids read back from files, as triangulation and C-grid.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "dual/grid.hpp"
#include "io/triangle_set.hpp"
#include "lifecycle/inputs.hpp"
#include "metrics/certificate.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// What a file says about where it came from; empty texts where it says nothing.
struct FileOrigin {
  std::string format;  ///< "MPAS", "UGRID", "SCRIP", "ESMF mesh", "VTU", "Gmsh", "JIGSAW", "FESOM2"
  std::string version, config, digest, history;
  std::vector<InputRecord> inputs;
  std::optional<Certificate> certificate;  ///< as recorded, not as measured
};

struct GridFile {
  std::string path;
  FileOrigin origin;
  Ellipsoid surface;
  LatitudeKind latitude = LatitudeKind::geodetic;
  /// The triangulation; none for a grid with a border, which is not a closed surface.
  std::optional<Mesh> mesh;
  /// The spacing that was asked for at the sides of `mesh` or `open_mesh`; null where the file does
  /// not say.
  SideSpacing spacing;
  /// The C-grid as the file has it (MPAS), or made of Voronoi cells with a border (other files of
  /// cells); none for other files of the whole surface, which hold no C-grid tables.
  std::optional<Grid> grid;
  /// Triangles with a border, points of no triangle left out; then there is neither of the others.
  std::optional<TriangleSet> triangles;
  /// These, numbered as in the file and with all its points; UGRID only, which certifies them.
  std::optional<Mesh> open_mesh;
  std::int64_t n_turned =
      0;  ///< triangles, or cells with a border, that were clockwise in the file
  std::vector<double> depth_m, level_m;  ///< at the mesh's vertices; FESOM2 only, else empty
};

/// The grid files of a folder (netCDF of a kind that can be read, *.vtu, *.msh, *nod2d.out) in
/// alphabetical order, or the path itself. Error(input) when there is none.
std::vector<std::string> grid_files(const std::string& path);

/// Reads a grid file of any kind (see FileOrigin::format), by its content. Polygons must be Voronoi
/// cells with their centres, or triangles. Error(input) with the reason when the file is none or
/// its tables name what is not there.
GridFile read_grid_file(Context& context, const std::string& path);

enum class Border { refused, allowed };

/// Joins triangles over points to a mesh: finds the neighbours, kNone at a border. Error(input),
/// naming the edge, unless every edge has exactly one triangle on each side, or at an allowed
/// border one alone.
Mesh mesh_from_triangles(Array<Vertex> vertices, std::span<const std::array<Index, 3>> corners,
                         Border border = Border::refused);

}  // namespace delos
