// SPDX-License-Identifier: BSD-3-Clause
#include "io/geojson.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using testing::expect_error;
using testing::TemporaryFolder;

namespace {

const std::string kSquare = "[[0,0],[10,0],[10,10],[0,10],[0,0]]";
const std::string kHole = "[[4,4],[4,6],[6,6],[6,4],[4,4]]";

std::string feature(const std::string& name, const std::string& geometry) {
  const std::string properties = name.empty() ? "null" : R"({"name":")" + name + R"("})";
  return R"({"type":"Feature","properties":)" + properties + R"(,"geometry":)" + geometry + "}";
}

std::string collection(const std::string& features) {
  return R"({"type":"FeatureCollection","features":[)" + features + "]}";
}

std::string polygon(const std::string& rings) {
  return R"({"type":"Polygon","coordinates":[)" + rings + "]}";
}

PolygonSet read_text(const std::string& content, const std::string& name = "") {
  const TemporaryFolder folder;
  return read_polygons(folder.write("r.geojson", content), name);
}

/// Whether a point is inside by the even-odd rule, at its longitude or a turn from it.
bool contains(const PolygonSet& polygons, double lon, double lat) {
  int n_crossed = 0;
  for (const PolygonRing& ring : polygons.rings) {
    for (const double turn : {-360.0, 0.0, 360.0}) {
      for (std::size_t i = 0, j = ring.lon_deg.size() - 1; i < ring.lon_deg.size(); j = i++) {
        const double y0 = ring.lat_deg[j], y1 = ring.lat_deg[i];
        if ((y0 > lat) == (y1 > lat)) continue;
        const double x =
            ring.lon_deg[j] + (lat - y0) / (y1 - y0) * (ring.lon_deg[i] - ring.lon_deg[j]) - turn;
        n_crossed += lon < x ? 1 : 0;
      }
    }
  }
  return n_crossed % 2 == 1;
}

}  // namespace

TEST_CASE("polygons are found in every kind of GeoJSON object") {
  const std::string multi =
      R"({"type":"MultiPolygon","coordinates":[[)" + kSquare + "],[" + kHole + "]]}";
  const std::string both = R"({"type":"GeometryCollection","geometries":[)" + polygon(kSquare) +
                           "," + polygon(kHole) + "]}";
  CHECK(read_text(polygon(kSquare)).rings.size() == 1);
  CHECK(read_text(polygon(kSquare + "," + kHole)).rings.size() == 2);
  CHECK(read_text(multi).rings.size() == 2);
  CHECK(read_text(both).rings.size() == 2);
  CHECK(read_text(feature("a", multi)).rings.size() == 2);
  const std::string three = collection(feature("a", multi) + "," + feature("", "null") + "," +
                                       feature("b", polygon(kHole)));
  CHECK(read_text(three).rings.size() == 3);
  CHECK(read_text(three, "a").rings.size() == 2);
  const PolygonSet b = read_text(three, "b");
  REQUIRE(b.rings.size() == 1);
  CHECK(b.rings[0].lon_deg == std::vector<double>{4, 4, 6, 6});
  CHECK(b.rings[0].lat_deg == std::vector<double>{4, 6, 6, 4});
  CHECK(b.source.find("r.geojson:b") != std::string::npos);
}

TEST_CASE("a hole is outside by the even-odd rule") {
  const PolygonSet polygons = read_text(polygon(kSquare + "," + kHole));
  CHECK(contains(polygons, 2, 2));
  CHECK_FALSE(contains(polygons, 5, 5));
  CHECK_FALSE(contains(polygons, 12, 5));
}

TEST_CASE("a ring over the date line is continued") {
  const PolygonSet polygons =
      read_text(polygon("[[170,-10],[-170,-10],[-170,10],[170,10],[170,-10]]"));
  CHECK(polygons.rings[0].lon_deg == std::vector<double>{170, 190, 190, 170});
  CHECK(contains(polygons, 175, 0));
  CHECK(contains(polygons, -175, 0));
  CHECK_FALSE(contains(polygons, 160, 0));
  CHECK_FALSE(contains(polygons, 0, 0));
}

TEST_CASE("a ring round a pole holds the pole") {
  for (const char* ring :
       {"[[0,60],[120,60],[-120,60],[0,60]]", "[[0,60],[-120,60],[120,60],[0,60]]"}) {
    const PolygonSet arctic = read_text(polygon(ring));
    CHECK(contains(arctic, 77, 89.5));
    CHECK(contains(arctic, -100, 70));
    CHECK_FALSE(contains(arctic, 10, 50));
  }
  // As Natural Earth draws Antarctica: along the date line and the pole.
  const PolygonSet antarctica = read_text(
      polygon("[[-180,-90],[180,-90],[180,-70],[90,-65],[0,-70],[-90,-65],[-180,-70],[-180,-90]]"));
  CHECK(contains(antarctica, 0.5, -89.9));
  CHECK(contains(antarctica, 170, -75));
  CHECK_FALSE(contains(antarctica, 0.5, -60));
}

TEST_CASE("a box all round the globe is that box") {
  const PolygonSet tropics =
      read_text(polygon("[[-180,-20],[180,-20],[180,20],[-180,20],[-180,-20]]"));
  CHECK(contains(tropics, 0.5, 0));
  CHECK(contains(tropics, 179, 10));
  CHECK_FALSE(contains(tropics, 0.5, 30));
}

TEST_CASE("a GeoJSON error names file, feature and reason") {
  const TemporaryFolder folder;
  const auto refuse = [&](const std::string& content, const std::string& name,
                          std::initializer_list<std::string> parts) {
    const std::string path = folder.write("r.geojson", content);
    expect_error(ErrorKind::input, {"r.geojson"}, [&] { read_polygons(path, name); });
    expect_error(ErrorKind::input, parts, [&] { read_polygons(path, name); });
  };
  expect_error(ErrorKind::input, {"none.geojson", "no such file"},
               [&] { read_polygons(folder.file("none.geojson")); });
  expect_error(ErrorKind::input, {"can't be opened"}, [&] { read_polygons(folder.file("")); });
  refuse("{", "", {"not valid JSON"});
  refuse("[1, 2]", "", {"no \"type\""});
  refuse(R"({"type":"Topology"})", "", {"Topology", "polygons are needed"});
  refuse(R"({"type":"FeatureCollection"})", "", {"no \"features\""});
  refuse(collection(""), "", {"no polygon"});
  const std::string good = feature("North Atlantic", polygon(kSquare));
  refuse(collection(good + "," + feature("x", R"({"type":"Point","coordinates":[0,0]})")), "",
         {"feature 1 'x'", "Point", "polygons are needed"});
  refuse(collection(good), "north atlantc", {"'north atlantc'", "mean 'North Atlantic'"});
  refuse(collection(feature("", polygon(kSquare))), "a", {"no names"});
  refuse(collection(good + "," + feature("y", polygon("[[0,0],[1,1],[0,0]]"))), "",
         {"feature 1 'y'", "2 different points"});
  refuse(collection(feature("", polygon("[[0,0],[1,95],[2,0],[0,0]]"))), "",
         {"feature 0 (no name)", "[1, 95]", "outside the globe"});
  refuse(feature("z", polygon("[[0,0],[1],[2,0],[0,0]]")), "", {"'z'", "[1]", "not a position"});
  refuse(feature("z", polygon("7")), "", {"'z'", "ring is not an array"});
  refuse(feature("z", R"({"type":"Polygon"})"), "", {"'z'", "no \"coordinates\""});
  refuse(R"({"type":"Feature","properties":{"name":"q"}})", "", {"'q'", "no \"geometry\""});
  refuse(R"({"type":"FeatureCollection","crs":{"properties":{"name":"EPSG:3857"}},"features":[]})",
         "", {"EPSG:3857", "ogr2ogr"});
  std::string nested = polygon(kSquare);
  for (int i = 0; i < 20; ++i) {
    nested = R"({"type":"GeometryCollection","geometries":[)" + nested + "]}";
  }
  refuse(nested, "", {"nested too deeply"});
  // Far deeper than a stack: no position, and none to be taken apart for the message.
  constexpr std::size_t kDeep = 200'000;
  refuse(feature("deep", polygon(std::string(kDeep, '[') + std::string(kDeep, ']'))), "",
         {"nested more than 100 deep"});
  // Brackets within a text do not count.
  const std::string brackets(kDeep, '[');
  refuse(collection(feature("\\\"" + brackets, "null")), "", {"holds no polygon"});
}

TEST_CASE("lines are taken by name or tag, but for those left out") {
  const TemporaryFolder folder;
  const auto strait = [](const std::string& name, const std::string& tags) {
    return R"({"type":"Feature","properties":{"name":")" + name + R"(","tags":")" + tags +
           R"("},"geometry":{"type":"LineString","coordinates":[[0,0],[1,1]]}})";
  };
  const std::string path = folder.write(
      "l.geojson",
      collection(strait("a", "sea;narrow") + "," + strait("b", "sea") + "," + strait("c", "land")));
  const auto names = [&](const std::string& select, const std::vector<std::string>& except) {
    std::string joined;
    for (const LonLatLine& line : read_lines(path, select, except)) joined += line.name;
    return joined;
  };
  CHECK(names("", {}) == "abc");
  CHECK(names("sea", {}) == "ab");
  CHECK(names("sea", {"b"}) == "a");
  CHECK(names("sea", {"narrow"}) == "b");
  CHECK(names("sea", {"a", "b"}).empty());
  expect_error(ErrorKind::input, {"l.geojson", "'c'", "It has: "}, [&] { names("sea", {"c"}); });
  expect_error(ErrorKind::input, {"'narow'", "mean 'narrow'"}, [&] { names("sea", {"narow"}); });
}

TEST_CASE("published regions and land polygons are read as they are") {
  const char* folder = std::getenv("DELOS_TEST_DATA");
  if (folder == nullptr) {
    MESSAGE("skipped: DELOS_TEST_DATA is not set");
    return;
  }
  const std::string data(folder);
  const PolygonSet land = read_polygons(data + "/land_ne110m.geojson");
  CHECK(contains(land, 20.3, 10.3));     // Africa
  CHECK(contains(land, 100.3, 60.3));    // Siberia
  CHECK(contains(land, -179.3, 67.0));   // Chukotka, beyond the date line
  CHECK(contains(land, 40.3, -89.5));    // the South Pole
  CHECK(contains(land, -100.3, -85.0));  // Antarctica
  CHECK_FALSE(contains(land, -150.3, 0.3));
  CHECK_FALSE(contains(land, 179.3, -40.3));
  const PolygonSet regions = read_polygons(data + "/mpas_mesh_regions.geojson");
  CHECK(regions.rings.size() >= 19);
  for (const PolygonRing& ring : regions.rings) {
    const auto [low, high] = std::minmax_element(ring.lon_deg.begin(), ring.lon_deg.end());
    CHECK(*high - *low <= 360.0);
  }
  expect_error(ErrorKind::input, {"feature 0", "LineString"},
               [&] { read_polygons(data + "/mpas_transects_passages.geojson"); });
}

TEST_CASE("points, lines and rings are found in every kind of GeoJSON object") {
  const TemporaryFolder folder;
  const std::string path = folder.write(
      "l.geojson",
      collection(
          feature("moorings", R"({"type":"MultiPoint","coordinates":[[1,2],[3,4]]})") + "," +
          feature("", R"({"type":"Point","coordinates":[-170.5,80]})") + "," +
          feature("section", R"({"type":"LineString","coordinates":[[0,0],[10,5],[20,0]]})") + "," +
          feature("coast", polygon(kSquare + "," + kHole)) + "," +
          feature("closed", R"({"type":"MultiLineString","coordinates":[)" + kSquare + "]}")));
  const std::vector<LineFeature> lines = read_line_features(path);
  REQUIRE(lines.size() == 6);
  using Kind = LineFeature::Kind;
  const std::vector<Kind> kinds = {Kind::points, Kind::points, Kind::line,
                                   Kind::ring,   Kind::ring,   Kind::ring};
  for (std::size_t i = 0; i < kinds.size(); ++i) CHECK(lines[i].kind == kinds[i]);
  CHECK(lines[0].lon_lat_deg.size() == 2);
  CHECK(lines[1].lon_lat_deg[0] == std::array<double, 2>{-170.5, 80.0});
  CHECK(lines[2].lon_lat_deg.size() == 3);
  CHECK(lines[3].lon_lat_deg.size() == 4);  // the first point is not repeated
  CHECK(lines[2].name == path + ": feature 2 'section'");
}

TEST_CASE("a line of one point and an unknown geometry are refused by name") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& geometry) {
    return read_line_features(folder.write("l.geojson", collection(feature("x", geometry))));
  };
  expect_error(ErrorKind::input, {"feature 0 'x'", "1 different points: at least 2"},
               [&] { read(R"({"type":"LineString","coordinates":[[0,0]]})"); });
  expect_error(ErrorKind::input, {"feature 0 'x'", "'Blob' is no geometry"},
               [&] { read(R"({"type":"Blob","coordinates":[[0,0]]})"); });
}
