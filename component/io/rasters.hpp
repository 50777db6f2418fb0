// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lat-lon fields of netCDF files that follow the CF conventions more or less, as arrays in memory.
#include <optional>
#include <string>

#include "sizing/raster.hpp"

namespace delos {

/// Which field of a file.
struct RasterRequest {
  std::string variable;  ///< empty: the only variable on a latitude and a longitude
  /// Position along a further dimension, from 0. Needed unless that dimension has one entry.
  std::optional<std::size_t> time_index;
  std::optional<std::size_t> level_index;
  /// What the values are converted to, e.g. "m", "m2 s-2", "degree_Celsius"; empty: as they are.
  std::string units;
  /// Taken instead of the file's `units` attribute, or where it has none.
  std::string file_units;
};

/// One level of one variable: latitudes ascending, longitudes ascending without a repeated column,
/// values unpacked (scale_factor, add_offset), NaN where the file says missing (_FillValue,
/// missing_value, valid_min, valid_max, valid_range, NaN). Accepted: either order of latitudes, any
/// range of longitudes of at most 360 degrees plus one column, (lat, lon) or (lon, lat), uneven
/// latitudes, cell centres or nodes. Error(input) with file, variable and reason for all the rest.
/// The C library reads on one thread; what follows, unpacking and reordering, is parallel.
Raster read_raster(parallel::Executor& exec, const std::string& path, const RasterRequest& request);

/// All levels of a variable with a depth dimension, shallowest first.
RasterStack read_raster_stack(parallel::Executor& exec, const std::string& path,
                              const RasterRequest& request);

/// The same on the calling thread alone.
Raster read_raster(const std::string& path, const RasterRequest& request);
RasterStack read_raster_stack(const std::string& path, const RasterRequest& request);

}  // namespace delos
