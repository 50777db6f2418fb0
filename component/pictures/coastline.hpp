// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Land and sea for pictures: a raster of elevations brought to one regular grid.
#include <vector>

#include "pictures/canvas.hpp"
#include "sizing/raster.hpp"

namespace delos::pictures {

class LandMask {
 public:
  /// Bilinear; what the raster does not cover or marks missing is sea.
  explicit LandMask(const Raster& elevation);

  bool is_land(double lon_deg, double lat_deg) const { return elevation(lon_deg, lat_deg) >= 0.0; }
  /// Lit from the north-west: 1 on a plain, below on slopes turned away, above on sunny ones.
  double shade(double lon_deg, double lat_deg) const;
  /// The line of elevation 0 in short pieces: x = longitude in [-180, 180], y = latitude, degrees.
  const std::vector<Segment>& coastline() const { return coastline_; }

 private:
  double elevation(double lon_deg, double lat_deg) const;
  double node(std::ptrdiff_t row, std::ptrdiff_t column) const;
  void trace_coastline();

  std::vector<float> elevation_m_;  // [kRows, kColumns], nodes at kStep_deg from -90 and -180
  std::vector<Segment> coastline_;
};

}  // namespace delos::pictures
