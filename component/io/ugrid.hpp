// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// UGRID 1.0 files that CDO and ESMF read too, on any ellipsoid.
#include <array>
#include <span>
#include <string>
#include <vector>

#include "dual/grid.hpp"
#include "io/face_mesh.hpp"
#include "io/netcdf.hpp"
#include "io/provenance.hpp"
#include "sizing/spacing.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

struct UgridOptions {
  netcdf::Format format = netcdf::Format::cdf5;
  /// The corners of every face, which CDO needs: 48 bytes a triangle. Leave out for huge meshes.
  bool bounds = true;
  /// Converts while the file is written; null: all on the calling thread.
  parallel::Executor* exec = nullptr;
};

/// What a UGRID file is told about the surface that its longitudes and latitudes are on, and about
/// the spacing that was asked for there: `delos_edge_spacing` in metres at the middle of each edge
/// (of the triangulation), left out when the field is null.
struct UgridSurface {
  Ellipsoid ellipsoid;
  LatitudeKind latitude = LatitudeKind::geodetic;
  const SpacingField* spacing = nullptr;
  /// In place of the field: [n_edges], each side once, from the triangle of lower id, in the order
  /// of triangles and their sides.
  std::span<const double> edge_spacing_m = {};
};

/// The triangulation, topology `delos_triangles`: faces are triangles, nodes their corners, face
/// coordinates the centres of their surface Delaunay balls. The mesh may have a border (neighbour
/// kNone) and vertices of no triangle. Atomic. Needs no dual: blocks of triangles stream to the
/// file.
void write_ugrid_triangles(const std::string& path, const Mesh& mesh, const UgridSurface& surface,
                           const Provenance& provenance, const UgridOptions& options = {});

/// The Voronoi cells, topology `delos_cells`: faces are cells, nodes their corners; with
/// `delos_edge_spacing` when the grid has edge_spacing_m and `bdyMaskCell` when it has rings.
/// Atomic.
void write_ugrid_cells(const std::string& path, const Grid& grid, const Provenance& provenance,
                       const UgridOptions& options = {});

/// A UGRID topology of dimension 2.
struct UgridMesh : FaceMesh {
  std::string topology;  ///< name of the variable
  /// Where the file has `delos_edge_spacing`: that, and the nodes of its edges; else empty.
  std::vector<double> edge_spacing_m;
  std::vector<std::array<Index, 2>> nodes_on_edge;  ///< from 0
};

/// Reads the first topology of dimension 2 of any UGRID file: start_index 0 or 1, padding by
/// _FillValue, degrees or radians, either order of the connectivity's dimensions.
UgridMesh read_ugrid(const std::string& path);

/// Bytes of the file that write_ugrid_triangles makes with the spacing, within a few per cent.
std::uint64_t ugrid_triangles_size_bytes(std::int64_t n_vertices, const UgridOptions& options = {});

}  // namespace delos
