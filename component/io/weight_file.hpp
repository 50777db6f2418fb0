// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Weights of a transfer between two grids in the netCDF layout that ESMF's regridding writes and
// reads (also NCO's and TempestRemap's maps); SCRIP's own layout is read as well.
#include <string>
#include <vector>

#include "core/array.hpp"
#include "dual/grid.hpp"
#include "io/netcdf.hpp"
#include "io/provenance.hpp"

namespace delos {

/// One grid of the two, as the file describes it.
struct WeightFileGrid {
  std::vector<double> lon_deg, lat_deg;  ///< [n] centres
  std::int64_t n_corners = 0;            ///< of a row of the two tables
  /// [n, n_corners] counter-clockwise, the last corner repeated; empty when the file has none
  std::vector<double> corner_lon_deg, corner_lat_deg;
  std::vector<double> area;  ///< [n] in units of the squared largest radius: radians^2 on a sphere
  std::vector<double> fraction;  ///< [n] of the area that takes part

  std::int64_t n() const { return static_cast<std::int64_t>(area.size()); }
};

/// The cells of a grid, all of which take part.
WeightFileGrid weight_file_grid(const Grid& grid);

/// Entries sorted by (row, column) as written by write_weights; in the file's order when read.
struct WeightFile {
  WeightFileGrid source, target;
  Array<Index> row;     ///< target, from 0
  Array<Index> column;  ///< source, from 0
  Array<double> value;  ///< target = sum of value times source
  std::string method;   ///< e.g. "First-order Conservative"
  /// Rows are means over the covered part of a cell ("fracarea"), not over the cell ("destarea").
  bool is_of_covered = false;
};

/// Atomic. Ids from 1 in the file. Error(output) when it can't be written.
void write_weights(const std::string& path, const WeightFile& weights, const Provenance& provenance,
                   netcdf::Format format = netcdf::Format::cdf5);

/// Reads ESMF's names (S, row, col) or SCRIP's (remap_matrix, dst_address, src_address; degrees or
/// radians). Error(input) for another file, an id outside its grid, a value that is not finite, or
/// SCRIP weights that multiply gradients too.
WeightFile read_weights(const std::string& path);

}  // namespace delos
