// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A lat-lon variable in memory, as a file gave it: what every gridded source starts from.
#include <string>
#include <vector>

#include "core/types.hpp"

namespace delos {

struct Raster {
  std::string source;            ///< "file:variable" (or "built in"), for messages
  std::vector<double> lat_deg;   ///< strictly ascending, possibly uneven, within [-90, 90]
  std::vector<double> lon_deg;   ///< strictly ascending, possibly uneven, spans at most 360 degrees
  std::vector<double> values;    ///< [n_lat, n_lon] row-major, unpacked; NaN where missing
  bool periodic = false;         ///< the columns go round the globe (no column is repeated)

  std::size_t n_lat() const { return lat_deg.size(); }
  std::size_t n_lon() const { return lon_deg.size(); }
};

/// Levels of one variable, shallowest first; missing values are NaN.
struct RasterStack {
  std::vector<double> depth_m;   ///< ascending, >= 0
  std::vector<Raster> levels;
};

/// A closed lon-lat ring; longitudes are continued across the date line.
struct PolygonRing {
  std::vector<double> lon_deg, lat_deg;
};

/// Polygons with holes (even-odd rule over all rings).
struct PolygonSet {
  std::string source;
  std::vector<PolygonRing> rings;
};

}  // namespace delos
