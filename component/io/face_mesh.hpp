// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the files that hold polygons have in common (UGRID, SCRIP, ESMF mesh, VTU).
#include <optional>
#include <string>
#include <vector>

#include "dual/grid.hpp"
#include "io/netcdf.hpp"

namespace delos {

/// Polygons on a surface, as a file has them.
struct FaceMesh {
  std::vector<LonLat> node;             ///< radians, lon in (-pi, pi]
  std::vector<LonLat> face_centre;      ///< the same; empty when the file has none
  Ragged<Index> nodes_on_face;          ///< from 0, in the order of the file
  std::vector<double> face_area_m2;     ///< empty when the file has none
  std::vector<std::int32_t> face_ring;  ///< Grid::cell_ring; empty when the file has none
  std::optional<Ellipsoid> ellipsoid;   ///< when the file says so
  LatitudeKind latitude = LatitudeKind::geodetic;
};

/// Global attributes `delos_radii_m` (three, metres) and `delos_latitude` (geodetic, geocentric or
/// parametric), for formats that have no place of their own for the surface.
void write_surface(netcdf::Writer& file, const Ellipsoid& surface, LatitudeKind latitude);

/// Entries of the longest row: the width of a padded table, at least 1.
std::size_t longest_row(const RowOffsets& rows);

/// Areas in square radians, 4 pi in all on any body, as SCRIP and ESMF want them.
double square_radians_in_m2(const Ellipsoid& surface);

/// A variable in square radians as areas in m2 of the mesh's body, of the unit sphere when the file
/// names none; what is not there leaves face_area_m2 as it was.
void read_areas(const netcdf::Reader& file, const std::string& variable, FaceMesh& mesh);

/// The surface, read back; what is not there stays as it was. Error(input) for radii that are none.
void read_surface(const netcdf::Reader& file, FaceMesh& mesh);

/// Variable `bdyMaskCell`: the ring of each face of a regional grid, as MPAS files name it.
netcdf::VariableId define_rings(netcdf::Writer& file, netcdf::DimensionId faces);

/// The same read back; empty when the file has none. Error(input) unless it has `n_faces` rings
/// that count from 0.
std::vector<std::int32_t> read_rings(const netcdf::Reader& file, std::size_t n_faces);

/// A whole variable in radians, by its units ("degrees" where it has none). Error(input) naming the
/// entry that is not a finite number.
std::vector<double> read_radians(const netcdf::Reader& file, const std::string& variable);

/// Longitudes (radians, any turn) and latitudes as places with lon in (-pi, pi]. Error(input) with
/// the entry where a latitude is beyond the poles; `what` names the variables.
std::vector<LonLat> places(const netcdf::Reader& file, const std::string& what,
                           const std::vector<double>& lon_rad, const std::vector<double>& lat_rad);

}  // namespace delos
