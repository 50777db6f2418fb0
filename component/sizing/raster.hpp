// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A lat-lon variable in memory, as a file gave it: what every gridded source starts from.
#include <string>
#include <vector>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "core/types.hpp"
#include "sizing/spacing.hpp"

namespace delos {

struct Raster {
  std::string source;           ///< "file:variable" (or "built in"), for messages
  std::vector<double> lat_deg;  ///< strictly ascending, possibly uneven, within [-90, 90]
  std::vector<double> lon_deg;  ///< strictly ascending, possibly uneven, spans at most 360 degrees
  Array<double> values;         ///< [n_lat, n_lon] row-major, unpacked; NaN where missing
  bool periodic = false;        ///< the columns go round the globe (no column is repeated)

  std::size_t n_lat() const { return lat_deg.size(); }
  std::size_t n_lon() const { return lon_deg.size(); }
};

/// Levels of one variable, shallowest first; missing values are NaN.
struct RasterStack {
  std::vector<double> depth_m;  ///< ascending, >= 0
  std::vector<Raster> levels;
};

/// A closed lon-lat ring; longitudes are continued across the date line.
struct PolygonRing {
  std::vector<double> lon_deg, lat_deg;
  Index polygon = 0;  ///< the polygon that it bounds, from outside or as a hole
};

/// Polygons with holes: even-odd over the rings of one polygon, and the union of the polygons,
/// which may overlap. Rings of one polygon stand together.
struct PolygonSet {
  std::string source;
  std::vector<PolygonRing> rings;
};

/// A table of zeros whose rows and columns are at most `resolution_rad` apart (n_lon is twice
/// n_lat_cells). Error(resource) beyond 2^31 nodes.
LatLonField make_table(double resolution_rad);
/// The same with its values left unset, for a loop that sets them in parallel.
LatLonField unset_table(double resolution_rad);

/// Mean distance of rows or columns (rad), the smaller.
double resolution_rad(const Raster& raster);

/// The raster on the nodes of `field`: the mean over a node's cell in a direction where the raster
/// is finer than the table, else linear between its nodes; NaN where more than half of the
/// weight is missing or the raster does not reach. Around a pole that the raster leaves out by
/// less than two of its rows the last row is continued; the row of a pole is one value.
/// Error(input) for a raster of less than 2 x 2 nodes or without any valid value.
void sample(parallel::Executor& exec, const Raster& raster, LatLonField& field);

/// Replaces NaN by the value of the nearest valid node (spherical distance, lowest row-major
/// node among equals). Error(input) naming `source` when nothing is valid.
void fill_nearest(parallel::Executor& exec, const std::string& source, LatLonField& field);
void fill_value(parallel::Executor& exec, double value, LatLonField& field);

/// Gaussian mean on the unit sphere with standard deviation `sigma_rad`; NaN takes no part and
/// stays NaN. The heat equation, implicit, alternating between rows and columns in fixed steps.
void smooth(parallel::Executor& exec, double sigma_rad, LatLonField& field);

}  // namespace delos
