// SPDX-License-Identifier: BSD-3-Clause
#include "io/geojson.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/error.hpp"
#include "io/names.hpp"
#include "io/shapefile.hpp"

namespace delos {
namespace {

using Json = nlohmann::json;

/// Latitudes and longitudes beyond their range by less than this are rounding.
constexpr double kTolerance_deg = 1e-6;
/// Brackets within each other: RFC 7946 needs about twenty, and the library takes each apart by a
/// call within a call.
constexpr int kMaxDepth = 100;
/// GeometryCollections within each other: RFC 7946 advises against any; deeper is damage.
constexpr int kMaxNesting = 8;

bool is_too_deep(const std::string& text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMaxDepth) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

/// As it stands in the file, its beginning when that is long.
std::string shown(const Json& json) {
  constexpr std::size_t kLongest = 80;
  const std::string all = json.dump();
  return all.size() <= kLongest ? all : all.substr(0, kLongest) + " ...";
}

Json parse_file(const std::string& path) {
  std::error_code error;
  DELOS_CHECK(std::filesystem::exists(path, error), ErrorKind::input, path,
              ": no such file. Check the path.");
  std::ifstream in(path, std::ios::binary);
  DELOS_CHECK(in.good() && !std::filesystem::is_directory(path, error), ErrorKind::input, path,
              ": can't be opened for reading. Check that it is a file and its permissions.");
  const std::string content{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  DELOS_CHECK(!is_too_deep(content), ErrorKind::input, path, ": its brackets are nested more than ",
              kMaxDepth, " deep, which is no GeoJSON. Repair it.");
  try {
    return Json::parse(content);
  } catch (const Json::exception& e) {
    throw Error(ErrorKind::input,
                text(path, ": is not valid JSON: ", e.what(), ". Give a GeoJSON file here."));
  }
}

std::string type_of(const Json& object, const std::string& where) {
  DELOS_CHECK(object.is_object() && object.contains("type") && object["type"].is_string(),
              ErrorKind::input, where, ": has no \"type\". Give a GeoJSON file (RFC 7946).");
  return object["type"];
}

std::string name_of(const Json& feature) {
  if (!feature.is_object() || !feature.contains("properties")) return "";
  const Json& properties = feature["properties"];
  for (const char* key : {"name", "Name", "NAME"}) {
    if (properties.is_object() && properties.contains(key) && properties[key].is_string()) {
      return properties[key];
    }
  }
  return "";
}

/// Old files may name a coordinate system; only longitude and latitude in degrees can be used.
void check_coordinate_system(const Json& root, const std::string& path) {
  if (!root.contains("crs") || !root["crs"].is_object()) return;
  const std::string crs = root["crs"].dump();
  DELOS_CHECK(
      crs.find("CRS84") != std::string::npos || crs.find("4326") != std::string::npos,
      ErrorKind::input, path, ": its coordinate system is ", crs,
      ". Convert it to longitude and latitude first, e.g. with `ogr2ogr -t_srs EPSG:4326`.");
}

/// How far to step in longitude: the short way, so that a ring over the date line continues.
/// Kept as written are steps of a full turn (the side of a box around the globe) and steps along
/// a pole, where longitude says nothing.
double longitude_step(double from_lon, double to_lon, double from_lat, double to_lat) {
  const double step = to_lon - from_lon;
  const bool along_pole = std::abs(from_lat) == 90.0 && from_lat == to_lat;
  const bool full_turn = std::abs(std::abs(step) - 360.0) <= kTolerance_deg;
  if (along_pole || full_turn) return step;
  return step - 360.0 * std::round(step / 360.0);
}

/// A ring that goes once round a pole is closed along that pole: the one of its mean latitude.
void close_around_pole(PolygonRing& ring, double turn_deg) {
  double sum_lat = 0.0;
  for (const double lat : ring.lat_deg) sum_lat += lat;
  const double pole = sum_lat < 0.0 ? -90.0 : 90.0;
  const double first_lon = ring.lon_deg.front();
  const double first_lat = ring.lat_deg.front();
  for (const double lon : {first_lon + turn_deg, first_lon}) {
    if (lon != first_lon) {
      ring.lon_deg.push_back(lon);
      ring.lat_deg.push_back(first_lat);
    }
    ring.lon_deg.push_back(lon);
    ring.lat_deg.push_back(pole);
  }
}

std::array<double, 2> read_position(const Json& position, const std::string& where) {
  DELOS_CHECK(position.is_array() && position.size() >= 2 && position[0].is_number() &&
                  position[1].is_number(),
              ErrorKind::input, where, ": ", shown(position),
              " is not a position. It must be [longitude, latitude] in degrees.");
  const double lon = position[0];
  const double lat = position[1];
  DELOS_CHECK(std::abs(lat) <= 90.0 + kTolerance_deg && std::abs(lon) <= 720.0, ErrorKind::input,
              where, ": position [", lon, ", ", lat,
              "] is outside the globe. Positions must be [longitude, latitude] in degrees.");
  return {lon, std::fmax(-90.0, std::fmin(90.0, lat))};
}

PolygonRing read_ring(const Json& positions, const std::string& where) {
  DELOS_CHECK(positions.is_array(), ErrorKind::input, where,
              ": a ring is not an array. Repair it.");
  std::vector<std::array<double, 2>> points;
  for (const Json& position : positions) points.push_back(read_position(position, where));
  if (points.size() > 1 && points.front() == points.back()) points.pop_back();
  DELOS_CHECK(points.size() >= 3, ErrorKind::input, where, ": a ring has ", points.size(),
              " different points: at least 3 are needed. Repair or remove it.");
  PolygonRing ring;
  double lon = points[0][0];
  for (std::size_t i = 0; i < points.size(); ++i) {
    ring.lon_deg.push_back(lon);
    ring.lat_deg.push_back(points[i][1]);
    const auto& next = points[(i + 1) % points.size()];
    lon += longitude_step(points[i][0], next[0], points[i][1], next[1]);
  }
  const double turn_deg = lon - points[0][0];
  if (std::abs(turn_deg) > 180.0) close_around_pole(ring, turn_deg);
  return ring;
}

void add_polygon(const Json& rings, const std::string& where, PolygonSet& polygons) {
  DELOS_CHECK(rings.is_array(), ErrorKind::input, where,
              ": its coordinates are not an array of rings. Repair them.");
  const Index polygon = polygons.rings.empty() ? 0 : polygons.rings.back().polygon + 1;
  for (const Json& ring : rings) {
    polygons.rings.push_back(read_ring(ring, where));
    polygons.rings.back().polygon = polygon;
  }
}

void add_geometry(const Json& geometry, const std::string& where, int nesting,
                  PolygonSet& polygons) {
  if (geometry.is_null()) return;  // an unlocated feature
  DELOS_CHECK(nesting <= kMaxNesting, ErrorKind::input, where,
              ": GeometryCollections are nested too deeply. Repair it.");
  const std::string type = type_of(geometry, where);
  const bool is_collection = type == "GeometryCollection";
  DELOS_CHECK(is_collection || type == "Polygon" || type == "MultiPolygon", ErrorKind::input, where,
              ": it is a ", type, " where polygons are needed. Remove it, or choose another ",
              "feature by name.");
  const char* key = is_collection ? "geometries" : "coordinates";
  DELOS_CHECK(geometry.contains(key) && geometry[key].is_array(), ErrorKind::input, where, ": its ",
              type, " has no \"", key, "\". Repair it.");
  const Json& parts = geometry[key];
  if (type == "Polygon") {
    add_polygon(parts, where, polygons);
    return;
  }
  for (const Json& part : parts) {
    if (is_collection) {
      add_geometry(part, where, nesting + 1, polygons);
    } else {
      add_polygon(part, where, polygons);
    }
  }
}

std::string feature_where(const std::string& path, std::size_t number, const std::string& name) {
  return text(path, ": feature ", number, name.empty() ? " (no name)" : " '" + name + "'");
}

/// The features of the file, whatever its outermost object is.
std::vector<Json> features_of(Json root, const std::string& path) {
  const std::string type = type_of(root, path);
  check_coordinate_system(root, path);
  if (type == "Feature") return {std::move(root)};
  if (type == "FeatureCollection") {
    DELOS_CHECK(root.contains("features") && root["features"].is_array(), ErrorKind::input, path,
                ": the FeatureCollection has no \"features\". Repair it.");
    return root["features"].get<std::vector<Json>>();
  }
  return {Json{{"type", "Feature"}, {"geometry", std::move(root)}}};
}

/// Of a GeoJSON file or a shapefile.
std::vector<Json> features_in(const std::string& path) {
  return is_shapefile(path) ? shapefile_features(path) : features_of(parse_file(path), path);
}

[[noreturn]] void refuse_unknown_name(const std::string& path, const std::string& wanted,
                                      const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(wanted, names);
  throw Error(
      ErrorKind::input,
      text(path, ": no feature named '", wanted, "'. ",
           nearest.empty() ? "" : "Did you mean '" + nearest + "'? ",
           names.empty() ? "Its features have no names" : "It has: " + join_names(names), "."));
}

/// The parts of a feature's `tags`, and its name.
std::vector<std::string> labels_of(const Json& feature) {
  std::vector<std::string> labels;
  if (const std::string name = name_of(feature); !name.empty()) labels.push_back(name);
  const Json& properties =
      feature.is_object() && feature.contains("properties") ? feature["properties"] : Json();
  std::string rest;
  for (const char* const key : {"tags", "Tags", "TAGS"}) {
    if (!properties.is_object() || !properties.contains(key)) continue;
    if (properties[key].is_string()) rest = properties[key];
  }
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(';'), rest.size());
    if (end > 0) labels.push_back(rest.substr(0, end));
    rest.erase(0, end + 1);
  }
  return labels;
}

void add_line(const Json& positions, const std::string& where, const std::string& name,
              std::vector<LonLatLine>& lines) {
  DELOS_CHECK(positions.is_array() && positions.size() >= 2, ErrorKind::input, where,
              ": a line needs two positions at least. Repair or remove it.");
  LonLatLine line;
  line.name = name;
  for (const Json& position : positions) {
    const auto [lon, lat] = read_position(position, where);
    line.lon_deg.push_back(lon);
    line.lat_deg.push_back(lat);
  }
  lines.push_back(std::move(line));
}

/// The lines of a feature; none when it has something else.
void add_lines(const Json& feature, const std::string& where, std::vector<LonLatLine>& lines) {
  if (!feature.is_object() || !feature.contains("geometry") || feature["geometry"].is_null())
    return;
  const Json& geometry = feature["geometry"];
  const std::string type = type_of(geometry, where);
  if (type != "LineString" && type != "MultiLineString") return;
  DELOS_CHECK(geometry.contains("coordinates") && geometry["coordinates"].is_array(),
              ErrorKind::input, where, ": its ", type, " has no \"coordinates\". Repair it.");
  const Json& parts = geometry["coordinates"];
  if (type == "LineString") return add_line(parts, where, name_of(feature), lines);
  for (const Json& part : parts) add_line(part, where, name_of(feature), lines);
}

const Json& geometry_of(const Json& feature, const std::string& where) {
  DELOS_CHECK(feature.is_object() && feature.contains("geometry"), ErrorKind::input, where,
              ": has no \"geometry\". Repair it.");
  return feature["geometry"];
}

}  // namespace

PolygonSet read_polygons(const std::string& path, const std::string& feature_name) {
  const std::vector<Json> features = features_in(path);
  PolygonSet polygons;
  polygons.source = feature_name.empty() ? path : path + ":" + feature_name;
  std::vector<std::string> names;
  bool found = feature_name.empty();
  for (std::size_t i = 0; i < features.size(); ++i) {
    const std::string name = name_of(features[i]);
    if (!name.empty()) names.push_back(name);
    if (!feature_name.empty() && name != feature_name) continue;
    found = true;
    const std::string where = feature_where(path, i, name);
    add_geometry(geometry_of(features[i], where), where, 0, polygons);
  }
  if (!found) refuse_unknown_name(path, feature_name, names);
  DELOS_CHECK(!polygons.rings.empty(), ErrorKind::input, polygons.source,
              ": holds no polygon. Give a file with polygons.");
  return polygons;
}

std::vector<LonLatLine> read_lines(const std::string& path, const std::string& select,
                                   const std::vector<std::string>& except) {
  const std::vector<Json> features = features_in(path);
  std::vector<LonLatLine> lines;
  std::vector<std::string> known, selected;
  const auto has = [](const std::vector<std::string>& labels, const std::string& label) {
    return std::find(labels.begin(), labels.end(), label) != labels.end();
  };
  bool found = select.empty();
  for (std::size_t i = 0; i < features.size(); ++i) {
    const std::vector<std::string> labels = labels_of(features[i]);
    known.insert(known.end(), labels.begin(), labels.end());
    if (!select.empty() && !has(labels, select)) continue;
    found = true;
    selected.insert(selected.end(), labels.begin(), labels.end());
    const bool is_left_out = std::any_of(except.begin(), except.end(),
                                         [&](const std::string& out) { return has(labels, out); });
    if (!is_left_out) add_lines(features[i], feature_where(path, i, name_of(features[i])), lines);
  }
  if (!found) refuse_unknown_name(path, select, known);
  for (const std::string& label : except) {
    if (!has(selected, label)) refuse_unknown_name(path, label, selected);
  }
  DELOS_CHECK(!lines.empty() || !except.empty(), ErrorKind::input, path,
              ": holds no line. Give a file with LineStrings.");
  return lines;
}

namespace {

LineFeature read_line_feature(const Json& positions, const std::string& where,
                              LineFeature::Kind kind) {
  DELOS_CHECK(positions.is_array(), ErrorKind::input, where,
              ": its coordinates are not an array of positions. Repair them.");
  LineFeature out{where, kind, {}};
  for (const Json& position : positions) out.lon_lat_deg.push_back(read_position(position, where));
  const bool closes =
      out.lon_lat_deg.size() > 1 && out.lon_lat_deg.front() == out.lon_lat_deg.back();
  if (closes && kind != LineFeature::Kind::points) {
    out.lon_lat_deg.pop_back();
    out.kind = LineFeature::Kind::ring;
  }
  const std::size_t least = kind == LineFeature::Kind::points ? 1 : out.kind == kind ? 2 : 3;
  DELOS_CHECK(out.lon_lat_deg.size() >= least, ErrorKind::input, where, ": it has ",
              out.lon_lat_deg.size(), " different points: at least ", least,
              " are needed. Repair or remove it.");
  return out;
}

void add_line_features(const Json& geometry, const std::string& where, int nesting,
                       std::vector<LineFeature>& lines) {
  if (geometry.is_null()) return;  // an unlocated feature
  DELOS_CHECK(nesting <= kMaxNesting, ErrorKind::input, where,
              ": GeometryCollections are nested too deeply. Repair it.");
  const std::string type = type_of(geometry, where);
  const char* const key = type == "GeometryCollection" ? "geometries" : "coordinates";
  DELOS_CHECK(geometry.contains(key) && geometry[key].is_array(), ErrorKind::input, where, ": its ",
              type, " has no \"", key, "\". Repair it.");
  const Json& parts = geometry[key];
  if (type == "Point") {
    lines.push_back(read_line_feature(Json::array({parts}), where, LineFeature::Kind::points));
  } else if (type == "MultiPoint") {
    lines.push_back(read_line_feature(parts, where, LineFeature::Kind::points));
  } else if (type == "LineString") {
    lines.push_back(read_line_feature(parts, where, LineFeature::Kind::line));
  } else if (type == "MultiLineString" || type == "Polygon") {
    const bool is_ring = type == "Polygon";
    for (const Json& part : parts) {
      lines.push_back(read_line_feature(
          part, where, is_ring ? LineFeature::Kind::ring : LineFeature::Kind::line));
    }
  } else if (type == "MultiPolygon") {
    for (const Json& part : parts) {
      add_line_features(Json{{"type", "Polygon"}, {"coordinates", part}}, where, nesting, lines);
    }
  } else {
    DELOS_CHECK(type == "GeometryCollection", ErrorKind::input, where, ": '", type,
                "' is no geometry of GeoJSON. Repair it.");
    for (const Json& part : parts) add_line_features(part, where, nesting + 1, lines);
  }
}

}  // namespace

std::vector<LineFeature> read_line_features(const std::string& path) {
  const std::vector<Json> features = features_in(path);
  std::vector<LineFeature> lines;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const std::string where = feature_where(path, i, name_of(features[i]));
    add_line_features(geometry_of(features[i], where), where, 0, lines);
  }
  DELOS_CHECK(!lines.empty(), ErrorKind::input, path,
              ": holds no point, line or polygon. Give a file with some.");
  return lines;
}

}  // namespace delos
