// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The sea floor that delos carries with it, for a first grid on a machine without any data.
#include "sizing/raster.hpp"

namespace delos {

/// Elevation in metres, negative below the sea: ETOPO5 (NOAA 1988, public domain) averaged by area
/// over cells of half a degree. Cell-centred: 360 rows -89.75 ... 89.75, 720 columns
/// -179.75 ... 179.75, periodic, whole metres, nothing missing.
Raster embedded_bathymetry();

}  // namespace delos
