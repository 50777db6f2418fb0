// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Regions from GeoJSON files (RFC 7946).
#include <string>

#include "sizing/raster.hpp"

namespace delos {

/// The polygons of a file, or only those of the features whose `name` property is `feature_name`
/// (unless that is empty). FeatureCollection, Feature, Polygon, MultiPolygon and
/// GeometryCollection; holes are rings like the others (even-odd rule). Each ring closes (its first
/// point is not repeated) and its longitudes are continued: neighbours differ by at most 180
/// degrees, so a ring over the date line passes +-180. Error(input) names the file, the feature by
/// number and name, and what is wrong.
PolygonSet read_polygons(const std::string& path, const std::string& feature_name = "");

}  // namespace delos
