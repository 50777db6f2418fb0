// SPDX-License-Identifier: BSD-3-Clause
#include "io/shapefile.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>

#include "core/error.hpp"
#include "io/file_text.hpp"

#ifdef DELOS_HAVE_SHAPELIB
#include <shapefil.h>
#endif

namespace delos {

bool is_shapefile(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return ending == ".shp";
}

#ifndef DELOS_HAVE_SHAPELIB

std::vector<nlohmann::json> shapefile_features(const std::string& path) {
  throw Error(ErrorKind::input,
              text(path,
                   ": shapefiles can't be read, because delos was built without shapelib "
                   "(Debian's libshp-dev). Build it with that, or convert the file: "
                   "ogr2ogr -f GeoJSON land.geojson ",
                   path));
}

#else

namespace {

using Json = nlohmann::json;

constexpr std::size_t kHeaderBytes = 100;

/// What the library would print.
void say_nothing(const char*) {}

SAHooks silent_hooks() {
  SAHooks hooks;
  SASetupDefaultHooks(&hooks);
  hooks.Error = say_nothing;
  return hooks;
}

struct Closer {
  void operator()(SHPInfo* file) const { SHPClose(file); }
  void operator()(DBFInfo* file) const { DBFClose(file); }
  void operator()(SHPObject* shape) const { SHPDestroyObject(shape); }
};

/// The file of the same name with another ending, in either case; empty when there is none.
std::string beside(const std::string& path, const char* lower, const char* upper) {
  std::error_code ignored;
  for (const char* const ending : {lower, upper}) {
    std::string candidate = std::filesystem::path(path).replace_extension(ending).string();
    if (std::filesystem::exists(candidate, ignored)) return candidate;
  }
  return "";
}

std::int64_t big_endian(const std::string& bytes, std::size_t offset) {
  std::int64_t value = 0;
  for (std::size_t i = offset; i < offset + 4; ++i) {
    value = value * 256 + static_cast<unsigned char>(bytes[i]);
  }
  return value;
}

/// The library reads what is left of a file that was cut off.
void check_length(const std::string& path) {
  std::error_code error;
  DELOS_CHECK(std::filesystem::is_regular_file(path, error), ErrorKind::input, path,
              ": no such file. Check the path.");
  std::string header(kHeaderBytes, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(header.data(), static_cast<std::streamsize>(kHeaderBytes));
  constexpr std::int64_t kFileCode = 9994;
  DELOS_CHECK(in.gcount() == static_cast<std::streamsize>(kHeaderBytes) &&
                  big_endian(header, 0) == kFileCode,
              ErrorKind::input, path, ": is no shapefile. Give one, or a GeoJSON file.");
  const std::int64_t expected = 2 * big_endian(header, 24);  // counted in words of two bytes
  const auto actual = static_cast<std::int64_t>(std::filesystem::file_size(path, error));
  DELOS_CHECK(actual >= expected, ErrorKind::input, path, ": is cut off: it has ", actual,
              " bytes, its header says ", expected, ". Get it again.");
}

/// Well-known text of a geographic system begins with one of these.
void check_geographic(const std::string& path) {
  const std::string prj = beside(path, ".prj", ".PRJ");
  if (prj.empty()) return;  // positions beyond the globe are refused later
  const std::string words = read_file_bytes(prj);
  const std::size_t first = words.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  const std::string head = first == std::string::npos ? "" : words.substr(first, 80);
  const bool is_geographic =
      std::ranges::any_of(std::array{"GEOGCS", "GEOGCRS", "GEOGRAPHICCRS", "GEODCRS"},
                          [&](const char* word) { return head.rfind(word, 0) == 0; });
  DELOS_CHECK(is_geographic, ErrorKind::input, prj, ": the coordinates are not longitudes and ",
              "latitudes, but ", head,
              "... Convert them first, e.g. with `ogr2ogr -t_srs EPSG:4326 ", "lonlat.shp ", path,
              "`.");
}

bool is_utf8(const std::string& word) {
  for (std::size_t i = 0; i < word.size();) {
    const auto byte = static_cast<unsigned char>(word[i]);
    const std::size_t n_more = byte < 0x80 ? 0 : byte >= 0xf0 ? 3 : byte >= 0xe0 ? 2 : 1;
    if (byte >= 0x80 && (byte < 0xc2 || byte > 0xf4 || i + n_more >= word.size())) return false;
    for (std::size_t k = 1; k <= n_more; ++k) {
      if ((static_cast<unsigned char>(word[i + k]) & 0xc0U) != 0x80U) return false;
    }
    i += n_more + 1;
  }
  return true;
}

std::string utf8(const std::string& word) {
  if (is_utf8(word)) return word;
  std::string out;
  for (const char c : word) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      out += c;
    } else {
      out += static_cast<char>(0xc0U | (byte >> 6U));
      out += static_cast<char>(0x80U | (byte & 0x3fU));
    }
  }
  return out;
}

/// The texts of the table beside the shapes.
class ShapeTable {
 public:
  ShapeTable(const std::string& path, int n_shapes) {
    const std::string dbf = beside(path, ".dbf", ".DBF");
    if (dbf.empty()) return;
    SAHooks hooks = silent_hooks();
    table_.reset(DBFOpenLL(dbf.c_str(), "rb", &hooks));
    const int n_rows = table_ ? DBFGetRecordCount(table_.get()) : 0;
    DELOS_CHECK(table_ && n_rows == n_shapes, ErrorKind::input, dbf, ": has ", n_rows,
                " rows for the ", n_shapes, " shapes of ", path, ". The file is damaged.");
  }

  Json properties(int shape) const {
    Json out = Json::object();
    const int n_fields = table_ ? DBFGetFieldCount(table_.get()) : 0;
    for (int field = 0; field < n_fields; ++field) {
      std::array<char, XBASE_FLDNAME_LEN_READ + 1> name{};
      if (DBFGetFieldInfo(table_.get(), field, name.data(), nullptr, nullptr) != FTString) continue;
      const char* const value = DBFReadStringAttribute(table_.get(), shape, field);
      if (value != nullptr) out[utf8(name.data())] = utf8(value);
    }
    return out;
  }

 private:
  std::unique_ptr<DBFInfo, Closer> table_;
};

Json positions(const SHPObject& shape, int begin, int end) {
  Json out = Json::array();
  for (int i = begin; i < end; ++i) out.push_back(Json::array({shape.padfX[i], shape.padfY[i]}));
  return out;
}

Json parts_of(const SHPObject& shape) {
  Json out = Json::array();
  for (int part = 0; part < shape.nParts; ++part) {
    const int end = part + 1 < shape.nParts ? shape.panPartStart[part + 1] : shape.nVertices;
    out.push_back(positions(shape, shape.panPartStart[part], end));
  }
  return out;
}

Json geometry_of(const SHPObject& shape, const std::string& where) {
  switch (shape.nSHPType) {
    case SHPT_NULL:
      return {};
    case SHPT_POLYGON:
    case SHPT_POLYGONZ:
    case SHPT_POLYGONM:
      return {{"type", "Polygon"}, {"coordinates", parts_of(shape)}};
    case SHPT_ARC:
    case SHPT_ARCZ:
    case SHPT_ARCM:
      return {{"type", "MultiLineString"}, {"coordinates", parts_of(shape)}};
    case SHPT_POINT:
    case SHPT_POINTZ:
    case SHPT_POINTM:
    case SHPT_MULTIPOINT:
    case SHPT_MULTIPOINTZ:
    case SHPT_MULTIPOINTM:
      return {{"type", "MultiPoint"}, {"coordinates", positions(shape, 0, shape.nVertices)}};
    default:
      throw Error(ErrorKind::input, text(where, ": it is a ", SHPTypeName(shape.nSHPType),
                                         ", which lies on no surface. Remove it."));
  }
}

}  // namespace

std::vector<Json> shapefile_features(const std::string& path) {
  check_length(path);
  check_geographic(path);
  DELOS_CHECK(
      !beside(path, ".shx", ".SHX").empty(), ErrorKind::input, path,
      ": the index of the shapes, of the same name with .shx, is not beside it. Put it there.");
  SAHooks hooks = silent_hooks();
  const std::unique_ptr<SHPInfo, Closer> file(SHPOpenLL(path.c_str(), "rb", &hooks));
  DELOS_CHECK(file, ErrorKind::input, path,
              ": can't be opened as a shapefile. It or the .shx beside it is damaged.");
  int n_shapes = 0;
  SHPGetInfo(file.get(), &n_shapes, nullptr, nullptr, nullptr);
  const ShapeTable table(path, n_shapes);
  std::vector<Json> out;
  for (int i = 0; i < n_shapes; ++i) {
    const std::string where = text(path, ": shape ", i + 1, " (from 1)");
    const std::unique_ptr<SHPObject, Closer> shape(SHPReadObject(file.get(), i));
    DELOS_CHECK(shape, ErrorKind::input, where, ": can't be read. The file is damaged.");
    out.push_back({{"type", "Feature"},
                   {"properties", table.properties(i)},
                   {"geometry", geometry_of(*shape, where)}});
  }
  return out;
}

#endif

}  // namespace delos
