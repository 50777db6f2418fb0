// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// MPAS mesh files: the C-grid as MPAS-Ocean, MPAS-Atmosphere, MPAS-Tools and swe-python read it.
// MPAS knows spheres only: bring a grid of an ellipsoid to the sphere first (geometry/conformal).
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "dual/grid.hpp"
#include "io/mpas_layers.hpp"
#include "io/netcdf.hpp"
#include "io/provenance.hpp"

namespace delos {

struct MpasOptions {
  netcdf::Format format = netcdf::Format::cdf5;
  /// Lengths in units of the radius and sphere_radius = 1, as MPAS-Atmosphere's init wants; else
  /// metres.
  bool on_unit_sphere = false;
  /// Converts while the file is written; null: all on the calling thread.
  parallel::Executor* exec = nullptr;
  /// What the file says of the vertical; at most one of the two.
  const MpasOceanLayers* ocean = nullptr;
  const MpasTerrainLayers* terrain = nullptr;
};

/// Writes every variable of the MPAS mesh specification, ids from 1, 0 = none; atomically.
/// Error(output) when the surface is no sphere or the file can't be written: then nothing is.
/// Beyond the specification: `delos_spacing` [nCells] and `delos_edge_spacing` [nEdges] (at the
/// projected middle of the edge's cells), the spacing that was asked for, each when the grid has
/// it, and the attributes of write_provenance(). A grid with rings has bdyMaskCell, bdyMaskEdge and
/// bdyMaskVertex, as limited-area models read them: 0 inside, the outermost ring at the border.
void write_mpas(const std::string& path, const Grid& grid, const Provenance& provenance,
                const MpasOptions& options = {});

/// Reads all back: write_mpas, then read_mpas gives the grid's tables exactly and its numbers to
/// rounding (exactly, on a unit sphere). Any closed or open MPAS mesh on a sphere is accepted;
/// missing neighbours become kNone. A file without `delos_spacing` gets gridSpacing, or else the
/// mean distance to the neighbours, as cell_spacing_m; one without `delos_edge_spacing` gets no
/// edge_spacing_m, one with bdyMaskCell gets rings. The radius is that of the file: 1 m for a unit
/// sphere. Error(input) naming the variable and the entry when a table is missing or names what is
/// not there.
Grid read_mpas(const std::string& path);

/// What `parent_id` of a file that is derived from this one must hold; empty when the file has no
/// file_id.
std::string mpas_parent_id(const std::string& path);

/// Layers of each cell (maxLevelCell), [n_cells]; empty when the file has none. Error(input) when a
/// number is out of range.
std::vector<Index> read_mpas_layers(const std::string& path);

/// Bytes of the file that write_mpas makes, within a few per cent, to check the disk before a run.
std::uint64_t mpas_size_bytes(std::int64_t n_cells, std::int64_t n_levels = 0);

}  // namespace delos
