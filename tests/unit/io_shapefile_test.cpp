// SPDX-License-Identifier: BSD-3-Clause
#include "io/shapefile.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/hash.hpp"
#include "io/file_text.hpp"
#include "io/geojson.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using testing::expect_error;
using testing::TemporaryFolder;

namespace {

constexpr std::int32_t kNull = 0, kPoint = 1, kArc = 3, kPolygon = 5, kMultiPatch = 31;

using Part = std::vector<std::array<double, 2>>;

struct Shape {
  std::int32_t kind;
  std::vector<Part> parts;
  std::string name;
};

template <class T>
std::string little(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));  // tests run on little-endian machines, as VTU does
  return bytes;
}

std::string big(std::int32_t value) {
  const std::string bytes = little(value);
  return {bytes.rbegin(), bytes.rend()};
}

std::string box() { return little(-180.0) + little(-90.0) + little(180.0) + little(90.0); }

std::string content_of(const Shape& shape) {
  std::string points, starts;
  std::int32_t n = 0;
  for (const Part& part : shape.parts) {
    starts += little(n);
    for (const auto& [lon, lat] : part) points += little(lon) + little(lat);
    n += static_cast<std::int32_t>(part.size());
  }
  const std::string kind = little(shape.kind);
  if (shape.kind == kNull) return kind;
  if (shape.kind == kPoint) return kind + points;
  const std::string types = shape.kind == kMultiPatch ? starts : "";  // as many, and heights behind
  return kind + box() + little(static_cast<std::int32_t>(shape.parts.size())) + little(n) + starts +
         types + points + std::string(shape.kind == kMultiPatch ? 16 + 8 * at(n) : 0, '\0');
}

std::string with_header(std::int32_t kind, const std::string& records) {
  const auto words = static_cast<std::int32_t>((100 + records.size()) / 2);
  return big(9994) + std::string(20, '\0') + big(words) + little(std::int32_t{1000}) +
         little(kind) + box() + std::string(32, '\0') + records;
}

std::string table_of(const std::vector<Shape>& shapes) {
  constexpr std::size_t kWidth = 24;
  std::string out = "\x03";
  out += std::string("\x5f\x07\x1a") + little(static_cast<std::int32_t>(shapes.size())) +
         little(std::int16_t{65}) + little(static_cast<std::int16_t>(kWidth + 1)) +
         std::string(20, '\0');
  std::string field = "NAME";
  field.resize(11);
  out +=
      field + "C" + std::string(4, '\0') + static_cast<char>(kWidth) + std::string(15, '\0') + "\r";
  for (const Shape& shape : shapes) {
    std::string name = shape.name;
    name.resize(kWidth, ' ');
    out += " " + name;
  }
  return out + "\x1a";
}

/// The three files NAME.shp, .shx and .dbf; returns the path of the first.
std::string write_shapes(const TemporaryFolder& folder, const std::string& name, std::int32_t kind,
                         const std::vector<Shape>& shapes) {
  std::string records, index;
  for (const Shape& shape : shapes) {
    const std::string content = content_of(shape);
    const auto offset = static_cast<std::int32_t>((100 + records.size()) / 2);
    const auto number = static_cast<std::int32_t>(index.size() / 8 + 1);
    const auto words = static_cast<std::int32_t>(content.size() / 2);
    index += big(offset) + big(words);
    records += big(number) + big(words) + content;
  }
  folder.write(name + ".shx", with_header(kind, index));
  folder.write(name + ".dbf", table_of(shapes));
  return folder.write(name + ".shp", with_header(kind, records));
}

bool is_built_in() {
  const TemporaryFolder folder;
  try {
    shapefile_features(folder.file("none.shp"));
  } catch (const Error& error) {
    if (std::string(error.what()).find("without shapelib") == std::string::npos) return true;
    MESSAGE("skipped: delos was built without shapelib");
    return false;
  }
  return true;
}

const Part kSquare = {{0, 0}, {0, 10}, {10, 10}, {10, 0}, {0, 0}};  // clockwise: an outer ring
const Part kHole = {{4, 4}, {6, 4}, {6, 6}, {4, 6}, {4, 4}};

/// Even-odd over all rings, at the longitude or a turn from it.
bool is_inside(const PolygonSet& set, double lon, double lat) {
  bool inside = false;
  for (const double turn : {-360.0, 0.0, 360.0}) {
    for (const PolygonRing& ring : set.rings) {
      const std::size_t n = ring.lon_deg.size();
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t j = (i + 1) % n;
        const double a = ring.lat_deg[i], b = ring.lat_deg[j];
        if ((a > lat) == (b > lat)) continue;
        const double where =
            ring.lon_deg[i] + (lat - a) / (b - a) * (ring.lon_deg[j] - ring.lon_deg[i]);
        if (where > lon + turn) inside = !inside;
      }
    }
  }
  return inside;
}

}  // namespace

TEST_CASE("shapefiles give polygons with holes, lines and points, by the names of their table") {
  if (!is_built_in()) return;
  const TemporaryFolder folder;
  const Part far = {{170, 20}, {170, 30}, {-170, 30}, {-170, 20}, {170, 20}};
  const Part turned(kHole.rbegin(), kHole.rend());
  const std::string path = write_shapes(
      folder, "land", kPolygon,
      {{kPolygon, {kHole, kSquare}, "main"}, {kNull, {}, "nowhere"}, {kPolygon, {far}, "C\xf4te"}});
  const PolygonSet all = read_polygons(path);
  REQUIRE(all.rings.size() == 3);
  CHECK(all.rings[0].polygon == all.rings[1].polygon);
  CHECK(all.rings[2].polygon != all.rings[1].polygon);
  CHECK(is_inside(all, 2, 5));
  CHECK_FALSE(is_inside(all, 5, 5));
  CHECK(is_inside(all, 179, 25));
  CHECK(is_inside(all, -179, 25));
  CHECK(read_polygons(path, "C\xc3\xb4te").rings.size() == 1);  // Latin-1 became UTF-8
  expect_error(ErrorKind::input, {"land.shp", "no feature named 'mein'", "Did you mean 'main'"},
               [&] { read_polygons(path, "mein"); });
  // A ring of the wrong orientation is a hole all the same.
  const PolygonSet wrong =
      read_polygons(write_shapes(folder, "w", kPolygon, {{kPolygon, {kSquare, turned}, "main"}}));
  CHECK_FALSE(is_inside(wrong, 5, 5));

  const std::string arcs =
      write_shapes(folder, "lines", kArc,
                   {{kArc, {{{0, 0}, {10, 5}}, {{20, 0}, {30, 5}, {40, 0}}}, "open"},
                    {kArc, {kSquare}, "coast"}});
  CHECK(read_lines(arcs).size() == 3);
  const auto open = read_lines(arcs, "open");
  REQUIRE(open.size() == 2);
  CHECK(open[1].lon_deg == std::vector<double>{20, 30, 40});
  const auto features = read_line_features(arcs);
  REQUIRE(features.size() == 3);
  CHECK(features[2].kind == LineFeature::Kind::ring);
  const auto points = read_line_features(
      write_shapes(folder, "p", kPoint, {{kPoint, {{{-60, 20}}}, "a"}, {kPoint, {{{5, 6}}}, "b"}}));
  REQUIRE(points.size() == 2);
  CHECK(points[1].lon_lat_deg.front() == std::array{5.0, 6.0});
}

TEST_CASE("shapefiles that are no longitudes and latitudes, cut off or damaged are refused") {
  if (!is_built_in()) return;
  const TemporaryFolder folder;
  const std::vector<Shape> land = {{kPolygon, {kSquare, kHole}, "main"}};
  const auto refused = [](const std::string& path, std::initializer_list<std::string> parts) {
    expect_error(ErrorKind::input, parts, [&] { read_polygons(path); });
  };
  const std::string path = write_shapes(folder, "a", kPolygon, land);
  folder.write("a.prj", "PROJCS[\"UTM 33N\",GEOGCS[]]");
  refused(path, {"a.prj", "UTM 33N", "ogr2ogr"});
  folder.write("a.prj", " GEOGCS[\"WGS84\"]");
  CHECK(read_polygons(path).rings.size() == 2);
  std::filesystem::remove(folder.file("a.shx"));
  refused(path, {"a.shp", ".shx", "Put it there"});
  refused(folder.file("none.shp"), {"none.shp", "no such file"});
  refused(folder.write("text.shp", std::string(200, 'x')), {"text.shp", "is no shapefile"});
  refused(write_shapes(folder, "m", kMultiPatch, {{kMultiPatch, {kSquare}, "m"}}),
          {"m.shp", "shape 1", "MultiPatch"});
  refused(write_shapes(folder, "arcs", kArc, {{kArc, {kSquare}, "coast"}}),
          {"arcs.shp", "feature 0 'coast'", "where polygons are needed"});
  refused(write_shapes(folder, "far", kPolygon,
                       {{kPolygon, {{{5e5, 4e6}, {5e5, 5e6}, {6e5, 5e6}}}, ""}}),
          {"far.shp", "outside the globe"});
  const std::string whole = write_shapes(folder, "b", kPolygon, land);
  folder.write("b.dbf", table_of({}));
  refused(whole, {"b.dbf", "0 rows for the 1 shapes"});
  std::filesystem::remove(folder.file("b.dbf"));
  CHECK(read_polygons(whole).rings.size() == 2);  // without names
  std::error_code ignored;
  for (const std::uintmax_t size : {std::uintmax_t{0}, std::uintmax_t{99}, std::uintmax_t{120},
                                    std::filesystem::file_size(whole, ignored) - 1}) {
    const std::string cut = write_shapes(folder, "cut", kPolygon, land);
    std::filesystem::resize_file(cut, size);
    refused(cut, {"cut.shp", size < 100 ? "is no shapefile" : "is cut off"});
  }
}

TEST_CASE("a shapefile with a byte changed is read or refused, and nothing else") {
  if (!is_built_in()) return;
  const TemporaryFolder folder;
  const std::string path =
      write_shapes(folder, "a", kPolygon, {{kPolygon, {kSquare, kHole}, "main"}, {kNull, {}, "x"}});
  constexpr std::uint64_t kSeed = 17;
  int n_refused = 0;
  for (const char* const ending : {".shp", ".shx", ".dbf"}) {
    const std::string file = std::filesystem::path(path).replace_extension(ending).string();
    const std::string sound = read_file_bytes(file);
    for (std::size_t i = 0; i < sound.size(); i += 3) {  // all of them take seconds
      std::string damaged = sound;
      damaged[i] = static_cast<char>(hash64(kSeed, i));
      std::ofstream(file, std::ios::binary) << damaged;
      try {
        read_polygons(path);
      } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::input);
        ++n_refused;
      }
    }
    std::ofstream(file, std::ios::binary) << sound;
  }
  CHECK(n_refused > 20);
}

TEST_CASE("Natural Earth's shapefile has the land of its GeoJSON") {
  const char* const folder = std::getenv("DELOS_TEST_DATA");
  const std::string path = "/usr/share/magics/110m/ne_110m_land.shp";  // Debian's libmagics++-data
  if (folder == nullptr || !std::filesystem::exists(path) || !is_built_in()) {
    MESSAGE("skipped: DELOS_TEST_DATA, libmagics++-data or shapelib is not there");
    return;
  }
  const PolygonSet shapes = read_polygons(path);
  const PolygonSet expected = read_polygons(std::string(folder) + "/land_ne110m.geojson");
  int n = 0, n_equal = 0;
  for (double lat = -88.7; lat < 90.0; lat += 8.0) {
    for (double lon = -178.7; lon < 180.0; lon += 8.0, ++n) {
      n_equal += is_inside(shapes, lon, lat) == is_inside(expected, lon, lat);
    }
  }
  CAPTURE(n - n_equal);
  CHECK(n_equal >= n - n / 200);  // editions differ by some islands
}
