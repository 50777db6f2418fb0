// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Regions from GeoJSON files (RFC 7946), or from shapefiles (*.shp, see shapefile.hpp).
#include <array>
#include <string>
#include <vector>

#include "geometry/lines.hpp"
#include "sizing/raster.hpp"

namespace delos {

/// The polygons of a file, or only those of the features whose `name` property is `feature_name`
/// (unless that is empty). FeatureCollection, Feature, Polygon, MultiPolygon and
/// GeometryCollection; holes are rings like the others (even-odd rule). Each ring closes (its first
/// point is not repeated) and its longitudes are continued: neighbours differ by at most 180
/// degrees, so a ring over the date line passes +-180. Error(input) names the file, the feature by
/// number and name, and what is wrong.
PolygonSet read_polygons(const std::string& path, const std::string& feature_name = "");

/// The lines (LineString, MultiLineString) of the features of a file whose `name`, or one of whose
/// `tags` (separated by ';'), is `select`; of all features with lines when that is empty. Without
/// those whose name or tag is one of `except`. Longitudes as written. Error(input) as above, when
/// no line is found, and when a word of `except` leaves nothing out.
std::vector<LonLatLine> read_lines(const std::string& path, const std::string& select = "",
                                   const std::vector<std::string>& except = {});

/// Single points, a line, or one that closes (its first point is not repeated).
struct LineFeature {
  enum class Kind { points, line, ring };
  std::string name;  ///< "file: feature 3 'Iceland'"
  Kind kind = Kind::line;
  std::vector<std::array<double, 2>> lon_lat_deg;  ///< as written
};

/// All points, lines and rings of polygons of a file, in its order: Point, MultiPoint, LineString,
/// MultiLineString (a feature each line), Polygon, MultiPolygon (each ring) and GeometryCollection.
/// Errors as read_polygons().
std::vector<LineFeature> read_line_features(const std::string& path);

}  // namespace delos
