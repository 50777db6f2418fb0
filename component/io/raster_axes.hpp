// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the dimensions of a gridded variable stand for, and its latitudes and longitudes put in
// order.
#include <optional>
#include <string>
#include <vector>

#include "io/netcdf.hpp"

namespace delos {

enum class AxisKind { latitude, longitude, time, vertical, other };

/// One dimension of a variable.
struct RasterAxis {
  AxisKind kind = AxisKind::other;
  std::string coordinate;  ///< the 1-D variable that gives its values; empty when there is none
};

/// One entry for each dimension of the variable, in the file's order. A coordinate variable is
/// known by its units (degrees_north), else by standard_name, else by axis, else by its name.
std::vector<RasterAxis> identify_axes(const netcdf::Reader& file, const netcdf::Variable& variable);

/// The dimensions of `kind`, or nothing when there is none or more than one.
std::optional<std::size_t> find_axis(const std::vector<RasterAxis>& axes, AxisKind kind);

/// Rows or columns of the file in the order of the raster.
struct OrderedAxis {
  std::vector<double> values_deg;      ///< strictly ascending
  std::vector<std::size_t> file_rows;  ///< where each comes from
  bool periodic = false;               ///< longitudes only
};

/// Ascending latitudes; `where` ("file: variable 'x'") begins the messages. Error(input) unless
/// strictly monotonic and within [-90, 90] (beyond by 1e-4 is taken for rounding).
OrderedAxis order_latitudes(const std::vector<double>& lat_deg, const std::string& where);

/// Ascending longitudes that begin in [-180, 180), without the columns that repeat the first ones
/// 360 degrees on. Periodic when the columns go round the globe with a last gap like the others;
/// rounded coordinates of an even grid (ETOPO5: 359.92 for 359.9167) are made even again. One jump
/// by 360 degrees within the axis (0 ... 180, -180 ... -0.5) is undone. Error(input) unless
/// strictly monotonic apart from that, and at most 360 degrees wide.
OrderedAxis order_longitudes(const std::vector<double>& lon_deg, const std::string& where);

}  // namespace delos
