// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What every picture of a grid is told.
#include <string>

#include "sizing/raster.hpp"

namespace delos::pictures {

struct PictureOptions {
  std::string title;
  int width = 1600, height = 1000;  ///< pixels; the layout scales with the smaller side
  double view_lon_deg = -30.0;      ///< the point the globe turns to the reader
  double view_lat_deg = 25.0;
  bool has_view = false;         ///< the point was asked for; else pictures of a region turn to it
  double view_radius_deg = 0.0;  ///< > 0: globe and map show this disc around the point close up
  const Raster* land = nullptr;  ///< elevation (m), land where >= 0; none: no land shown
};

}  // namespace delos::pictures
