// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Shapefiles (ESRI 1998, "Shapefile Technical Description") as the features of GeoJSON.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace delos {

/// Whether the path ends in .shp, in any case.
bool is_shapefile(const std::string& path);

/// The shapes of a file with longitudes and latitudes in degrees, each as a Feature: Polygon (its
/// rings even-odd, which is what their orientation says where it is right), MultiLineString,
/// MultiPoint or no geometry, heights and measures left out; its `properties` are the texts of the
/// .dbf file beside it, in UTF-8 (what is none is taken for Latin-1). Error(input) naming file and
/// shape for what is cut off or damaged, without a .shx file, in projected coordinates (by the .prj
/// file, where there is one) or of another kind, and for all of them where shapelib was not built
/// in.
std::vector<nlohmann::json> shapefile_features(const std::string& path);

}  // namespace delos
