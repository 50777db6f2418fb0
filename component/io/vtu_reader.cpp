// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <map>

#include "core/error.hpp"
#include "io/file_text.hpp"
#include "io/vtu.hpp"

namespace delos {
namespace {

constexpr std::int64_t kTriangleCode = 5, kPolygonCode = 7, kQuadCode = 9;  // VTK's codes of shapes

struct Tag {
  std::string_view name;
  std::map<std::string_view, std::string_view> attributes;
  std::size_t end = 0;  ///< behind its '>'
};

struct DataArray {
  std::map<std::string_view, std::string_view> attributes;
  std::string_view content;  ///< between the tags
};

/// One file in memory: the tags up to the appended data, and the arrays under "section/name".
class VtuDocument {
 public:
  explicit VtuDocument(const std::string& path) : path_(path), bytes_(read_file_bytes(path)) {
    scan();
  }
  bool has(const std::string& array) const { return arrays_.count(array) != 0; }
  std::int64_t count(const char* attribute) const { return whole(piece_, attribute); }
  template <class T>
  std::vector<T> values(const std::string& array) const;
  const std::string& path() const { return path_; }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw Error(ErrorKind::input, text(path_, ": ", reason));
  }
  void scan();
  Tag next_tag(std::size_t from) const;
  void take(const Tag& tag, const std::string& section);
  std::int64_t whole(const std::map<std::string_view, std::string_view>& attributes,
                     const char* name) const;
  std::string_view appended(const std::string& array, const DataArray& data) const;
  template <class T, class Stored>
  std::vector<T> converted(const std::string& array, std::string_view bytes) const;
  template <class T>
  std::vector<T> parsed(const std::string& array, std::string_view words) const;

  std::string path_, bytes_;
  std::map<std::string, DataArray> arrays_;
  std::map<std::string_view, std::string_view> file_, piece_;
  std::size_t data_begin_ = 0;  // of the appended data; 0: none
  int n_pieces_ = 0;
};

std::string_view attribute(const std::map<std::string_view, std::string_view>& attributes,
                           const char* name, std::string_view fallback) {
  const auto found = attributes.find(name);
  return found == attributes.end() ? fallback : found->second;
}

Tag VtuDocument::next_tag(std::size_t from) const {
  const std::string_view all(bytes_);
  const std::size_t begin = all.find('<', from);
  const std::size_t end = begin == all.npos ? all.npos : all.find('>', begin);
  if (end == all.npos) fail("the XML ends before </VTKFile>. The file is cut off.");
  std::string_view inside = all.substr(begin + 1, end - begin - 1);
  Tag out;
  out.end = end + 1;
  const std::size_t name_end = std::min(inside.find_first_of(" \t\r\n/", 1), inside.size());
  out.name = inside.substr(0, name_end);
  inside.remove_prefix(name_end);
  for (;;) {
    const std::size_t key = inside.find_first_not_of(" \t\r\n/?");
    const std::size_t equals = inside.find('=');
    if (key == inside.npos || equals == inside.npos || equals < key) return out;
    const std::size_t open = inside.find_first_of("\"'", equals);
    const std::size_t close =
        open == inside.npos ? inside.npos : inside.find(inside[open], open + 1);
    if (close == inside.npos) fail(text("the attributes of <", out.name, "> can't be read."));
    out.attributes[inside.substr(key, equals - key)] = inside.substr(open + 1, close - open - 1);
    inside.remove_prefix(close + 1);
  }
}

void VtuDocument::take(const Tag& tag, const std::string& section) {
  DataArray data{tag.attributes, {}};
  const std::string_view all(bytes_);
  if (attribute(tag.attributes, "format", "ascii") != "appended") {
    const std::size_t end = all.find('<', tag.end);
    if (end == all.npos) fail("a <DataArray> does not end. The file is cut off.");
    data.content = all.substr(tag.end, end - tag.end);
  }
  // The name of the points is nobody's business.
  const std::string name(attribute(tag.attributes, "Name", "Points"));
  arrays_[section == "Points" ? "Points" : section + "/" + name] = data;
}

void VtuDocument::scan() {
  std::string section;
  for (std::size_t from = 0;;) {
    const Tag tag = next_tag(from);
    from = tag.end;
    if (tag.name == "VTKFile") file_ = tag.attributes;
    if (tag.name == "Piece") {
      piece_ = tag.attributes;
      ++n_pieces_;
    }
    for (const char* const name : {"FieldData", "PointData", "CellData", "Points", "Cells"}) {
      if (tag.name == name) section = name;
    }
    if (tag.name == "DataArray") take(tag, section);
    if (tag.name == "/VTKFile") break;
    if (tag.name != "AppendedData") continue;
    if (attribute(tag.attributes, "encoding", "base64") != "raw") {
      fail("the appended data are in base64. Write it with raw or ASCII data.");
    }
    data_begin_ = bytes_.find('_', tag.end);
    if (data_begin_ == std::string::npos) fail("the appended data are missing.");
    ++data_begin_;
    break;
  }
  if (attribute(file_, "type", "") != "UnstructuredGrid") {
    fail("not a VTK file of the type UnstructuredGrid.");
  }
  if (attribute(file_, "byte_order", "LittleEndian") != "LittleEndian") {
    fail("big-endian data can't be read. Write it little-endian.");
  }
  if (file_.count("compressor") != 0) {
    fail("compressed data can't be read. Write it without a compressor.");
  }
  if (n_pieces_ != 1) fail(text("has ", n_pieces_, " pieces, only one can be read."));
}

std::int64_t VtuDocument::whole(const std::map<std::string_view, std::string_view>& attributes,
                                const char* name) const {
  const std::string_view word = attribute(attributes, name, "");
  std::int64_t value = -1;
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (status != std::errc() || end != word.data() + word.size() || value < 0) {
    fail(text("the attribute ", name, " is '", word, "', no whole number >= 0."));
  }
  return value;
}

std::string_view VtuDocument::appended(const std::string& array, const DataArray& data) const {
  const auto offset = static_cast<std::size_t>(whole(data.attributes, "offset"));
  const bool is_long = attribute(file_, "header_type", "UInt32") == "UInt64";
  const std::size_t head = is_long ? sizeof(std::uint64_t) : sizeof(std::uint32_t);
  const std::size_t room = bytes_.size() - data_begin_;
  if (data_begin_ == 0 || offset > room || room - offset < head) {
    fail(text("the array ", array, " begins behind the end of the file, which is cut off."));
  }
  std::uint64_t size = 0;  // little-endian, so the low bytes come first
  std::memcpy(&size, bytes_.data() + data_begin_ + offset, head);
  if (size > room - offset - head) {
    fail(text("the array ", array, " has ", size, " bytes, of which ", room - offset - head,
              " are there. The file is cut off."));
  }
  return std::string_view(bytes_).substr(data_begin_ + offset + head, size);
}

template <class T, class Stored>
std::vector<T> VtuDocument::converted(const std::string& array, std::string_view bytes) const {
  if (bytes.size() % sizeof(Stored) != 0) {
    fail(text("the array ", array, " has no whole number of values. The file is damaged."));
  }
  std::vector<T> out(bytes.size() / sizeof(Stored));
  for (std::size_t i = 0; i < out.size(); ++i) {
    Stored value;
    std::memcpy(&value, bytes.data() + i * sizeof(Stored), sizeof(Stored));
    out[i] = static_cast<T>(value);
  }
  return out;
}

template <class T>
std::vector<T> VtuDocument::parsed(const std::string& array, std::string_view words) const {
  std::vector<T> out;
  const char* at = words.data();
  const char* const end = at + words.size();
  for (;;) {
    while (at != end && (*at == ' ' || *at == '\n' || *at == '\t' || *at == '\r')) ++at;
    if (at == end) return out;
    T value{};
    const auto [next, status] = std::from_chars(at, end, value);
    if (status != std::errc()) {
      const auto line = 1 + std::count(bytes_.data(), at, '\n');
      fail(text("line ", line, ": the array ", array, " has something that is no number."));
    }
    out.push_back(value);
    at = next;
  }
}

template <class T>
std::vector<T> VtuDocument::values(const std::string& array) const {
  const auto found = arrays_.find(array);
  if (found == arrays_.end()) fail(text("there is no array ", array, "."));
  const DataArray& data = found->second;
  const std::string_view format = attribute(data.attributes, "format", "ascii");
  if (format == "ascii") return parsed<T>(array, data.content);
  if (format != "appended") {
    fail(text("the array ", array, " is in format ", format,
              ", which can't be read. Write it with raw appended or ASCII data."));
  }
  const std::string_view bytes = appended(array, data);
  const std::string_view type = attribute(data.attributes, "type", "");
  if (type == "Float64") return converted<T, double>(array, bytes);
  if (type == "Float32") return converted<T, float>(array, bytes);
  if (type == "Int64") return converted<T, std::int64_t>(array, bytes);
  if (type == "Int32") return converted<T, std::int32_t>(array, bytes);
  if (type == "UInt8") return converted<T, std::uint8_t>(array, bytes);
  fail(text("the array ", array, " has the type '", type, "', which can't be read."));
}

Array<Vec3> points_of(const VtuDocument& file, const std::string& array, std::int64_t n) {
  const std::vector<double> values = file.values<double>(array);
  DELOS_CHECK(values.size() == 3 * static_cast<std::size_t>(n), ErrorKind::input, file.path(),
              ": the array ", array, " has ", values.size(),
              " numbers, expected three for each of ", n, ". The file is damaged.");
  Array<Vec3> out(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  }
  return out;
}

std::vector<double> column_of(const VtuDocument& file, const std::string& array, std::int64_t n) {
  if (!file.has(array)) return {};
  std::vector<double> out = file.values<double>(array);
  DELOS_CHECK(out.size() == static_cast<std::size_t>(n), ErrorKind::input, file.path(),
              ": the array ", array, " has ", out.size(), " numbers, expected ", n,
              ". The file is damaged.");
  return out;
}

void read_surface(const VtuDocument& file, TriangleSet& out) {
  if (file.has("FieldData/delos_radii_m")) {
    const std::vector<double> radii = file.values<double>("FieldData/delos_radii_m");
    DELOS_CHECK(radii.size() == 3 && *std::min_element(radii.begin(), radii.end()) > 0.0,
                ErrorKind::input, file.path(),
                ": delos_radii_m must be three numbers > 0. The file is damaged.");
    out.surface = Ellipsoid(Vec3(radii[0], radii[1], radii[2]), Vec3::Zero());
  }
  if (file.has("FieldData/delos_latitude")) {
    const auto kind = file.values<std::int64_t>("FieldData/delos_latitude");
    if (kind == std::vector<std::int64_t>{1}) out.latitude = LatitudeKind::geocentric;
    if (kind == std::vector<std::int64_t>{2}) out.latitude = LatitudeKind::parametric;
  }
}

Ragged<Index> faces_of(const VtuDocument& file, std::int64_t n_points, std::int64_t n_cells) {
  const auto nodes = file.values<std::int64_t>("Cells/connectivity");
  const auto ends = file.values<std::int64_t>("Cells/offsets");
  const auto types = file.values<std::int64_t>("Cells/types");
  const auto n = static_cast<std::size_t>(n_cells);
  DELOS_CHECK(ends.size() == n && types.size() == n, ErrorKind::input, file.path(),
              ": Cells/offsets and Cells/types must have one value for each of the ", n, " cells.");
  Ragged<Index> out;
  Array<std::int64_t> offsets(1, 0);
  for (std::size_t cell = 0; cell < n; ++cell) {
    const bool is_face =
        types[cell] == kTriangleCode || types[cell] == kPolygonCode || types[cell] == kQuadCode;
    DELOS_CHECK(is_face, ErrorKind::input, file.path(), ": cell ", cell,
                " (from 0) has VTK's type ", types[cell],
                "; only triangles (5), polygons (7) and quadrangles (9) can be read.");
    DELOS_CHECK(
        ends[cell] >= offsets.back() + 3 && ends[cell] <= static_cast<std::int64_t>(nodes.size()),
        ErrorKind::input, file.path(), ": Cells/offsets is ", ends[cell], " for cell ", cell,
        " (from 0), which begins at ", offsets.back(), ". The file is damaged.");
    offsets.push_back(ends[cell]);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(offsets.back()); ++i) {
    DELOS_CHECK(nodes[i] >= 0 && nodes[i] < n_points, ErrorKind::input, file.path(),
                ": Cells/connectivity names point ", nodes[i], " (from 0) of ", n_points,
                ". The file is damaged.");
    out.values.push_back(static_cast<Index>(nodes[i]));
  }
  out.offsets = RowOffsets(std::move(offsets));
  return out;
}

}  // namespace

VtuMesh read_vtu(const std::string& path) {
  const VtuDocument file(path);
  const std::int64_t n_points = file.count("NumberOfPoints");
  const std::int64_t n_cells = file.count("NumberOfCells");
  VtuMesh out;
  read_surface(file, out.points);
  out.points.position = points_of(file, "Points", n_points);
  settle_on_surface(path, out.points);
  out.points.spacing_m = column_of(file, "PointData/spacing_m", n_points);
  out.points.depth_m = column_of(file, "PointData/depth_m", n_points);
  out.nodes_on_face = faces_of(file, n_points, n_cells);
  bool all_triangles = true;
  for (std::int64_t cell = 0; cell < n_cells; ++cell) {
    all_triangles = all_triangles && out.nodes_on_face.offsets.length_of(cell) == 3;
  }
  for (std::int64_t cell = 0; all_triangles && cell < n_cells; ++cell) {
    const auto row = out.nodes_on_face.row(cell);
    out.points.corners.push_back({row[0], row[1], row[2]});
  }
  if (file.has("CellData/centre")) {
    TriangleSet centres;
    centres.surface = out.points.surface;
    centres.position = points_of(file, "CellData/centre", n_cells);
    settle_on_surface(path, centres);
    out.centre = std::move(centres.position);
  }
  out.cell_spacing_m = column_of(file, "CellData/spacing_m", n_cells);
  if (file.has("CellData/bdyMaskCell")) {
    const auto rings = file.values<std::int64_t>("CellData/bdyMaskCell");
    const bool are_rings = static_cast<std::int64_t>(rings.size()) == n_cells &&
                           std::all_of(rings.begin(), rings.end(), [](std::int64_t ring) {
                             return ring >= 0 && ring <= std::numeric_limits<std::int32_t>::max();
                           });
    DELOS_CHECK(are_rings, ErrorKind::input, path,
                ": bdyMaskCell must be a ring, from 0, for each of ", n_cells,
                " cells. The file is damaged.");
    out.cell_ring.assign(rings.begin(), rings.end());
  }
  return out;
}

}  // namespace delos
