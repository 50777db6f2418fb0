// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtu.hpp"

#include <bit>
#include <functional>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/byte_stream.hpp"

namespace delos {
namespace {

static_assert(std::endian::native == std::endian::little, "the files are little-endian");

constexpr std::uint8_t kTriangle = 5, kPolygon = 7;  // VTK's codes of shapes

struct ArrayToWrite {
  const char* section;  ///< FieldData, PointData, CellData, Points, Cells
  const char* name;
  const char* type;
  int n_components;
  std::int64_t n_tuples;
  std::uint64_t bytes;
  std::function<void(ByteStream&)> put;
};

template <class T>
constexpr const char* kTypeName = "";
template <>
constexpr const char* kTypeName<double> = "Float64";
template <>
constexpr const char* kTypeName<std::int32_t> = "Int32";
template <>
constexpr const char* kTypeName<std::int64_t> = "Int64";
template <>
constexpr const char* kTypeName<std::uint8_t> = "UInt8";

class VtuFile {
 public:
  VtuFile(std::int64_t n_points, std::int64_t n_cells) : n_points_(n_points), n_cells_(n_cells) {}

  /// value(i) gives value i of an array [n].
  template <class T, class Value>
  void add(const char* section, const char* name, std::int64_t n, Value value) {
    arrays_.push_back({section, name, kTypeName<T>, 1, n, static_cast<std::uint64_t>(n) * sizeof(T),
                       [n, value](ByteStream& out) {
                         for (std::int64_t i = 0; i < n; ++i) out.raw(static_cast<T>(value(i)));
                       }});
  }
  /// The same for points in space.
  template <class Value>
  void add_points(const char* section, const char* name, std::int64_t n, Value value) {
    arrays_.push_back({section, name, "Float64", 3, n,
                       static_cast<std::uint64_t>(n) * 3 * sizeof(double),
                       [n, value](ByteStream& out) {
                         for (std::int64_t i = 0; i < n; ++i) {
                           const Vec3 p = value(i);
                           for (int k = 0; k < 3; ++k) out.raw(p[k]);
                         }
                       }});
  }
  void add_surface(const Ellipsoid& surface, LatitudeKind latitude) {
    const Vec3 radii_m = surface.radii() * surface.scale_m();
    add<double>("FieldData", "delos_radii_m", 3,
                [radii_m](std::int64_t i) { return radii_m[static_cast<Eigen::Index>(i)]; });
    // Of eight bytes: with four meshio 7.0 takes the offset of one array for that of another.
    add<std::int64_t>("FieldData", "delos_latitude", 1, [latitude](std::int64_t) {
      return latitude == LatitudeKind::geodetic ? 0 : latitude == LatitudeKind::geocentric ? 1 : 2;
    });
  }

  void write(const std::string& path) const;

 private:
  void put_section(ByteStream& out, const char* section) const;

  std::int64_t n_points_, n_cells_;
  std::vector<ArrayToWrite> arrays_;
};

void VtuFile::put_section(ByteStream& out, const char* section) const {
  out << "<" << section << ">\n";
  std::uint64_t offset = 0;
  for (const ArrayToWrite& array : arrays_) {
    if (std::string_view(section) == array.section) {
      out << "<DataArray type=\"" << array.type << "\" Name=\"" << array.name << "\"";
      if (array.n_components > 1) {
        out << " NumberOfComponents=\"" << std::int32_t{array.n_components} << "\"";
      }
      if (std::string_view(section) == "FieldData") {
        out << " NumberOfTuples=\"" << array.n_tuples << "\"";
      }
      out << " format=\"appended\" offset=\"" << offset << "\"/>\n";
    }
    offset += sizeof(std::uint64_t) + array.bytes;
  }
  out << "</" << section << ">\n";
}

void VtuFile::write(const std::string& path) const {
  std::uint64_t bytes = 4096;  // the header
  for (const ArrayToWrite& array : arrays_) bytes += array.bytes;
  AtomicFile target(path, bytes);
  target.fill([&](const std::string& temporary) {
    ByteStream out(temporary);
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
           "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n";
    put_section(out, "FieldData");
    out << "<Piece NumberOfPoints=\"" << n_points_ << "\" NumberOfCells=\"" << n_cells_ << "\">\n";
    for (const char* const section : {"PointData", "CellData", "Points", "Cells"}) {
      put_section(out, section);
    }
    out << "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    for (const ArrayToWrite& array : arrays_) {
      out.raw(array.bytes);
      array.put(out);
    }
    out << "\n</AppendedData>\n</VTKFile>\n";
    out.close();
  });
  target.commit();
}

}  // namespace

void write_vtu_cells(const std::string& path, const Grid& grid) {
  const double scale_m = grid.surface.scale_m();
  const std::int64_t n = grid.n_cells();
  VtuFile file(grid.n_vertices(), n);
  file.add_surface(grid.surface, grid.latitude);
  file.add_points("CellData", "centre", n,
                  [&](std::int64_t i) -> Vec3 { return scale_m * grid.cell_position[at(i)]; });
  file.add<double>("CellData", "area_m2", n,
                   [&](std::int64_t i) { return grid.cell_area_m2[at(i)]; });
  if (!grid.cell_spacing_m.empty()) {
    file.add<double>("CellData", "spacing_m", n,
                     [&](std::int64_t i) { return grid.cell_spacing_m[at(i)]; });
  }
  if (!grid.cell_ring.empty()) {
    file.add<std::int32_t>("CellData", "bdyMaskCell", n,
                           [&](std::int64_t i) { return grid.cell_ring[at(i)]; });
  }
  file.add_points("Points", "Points", grid.n_vertices(),
                  [&](std::int64_t i) -> Vec3 { return scale_m * grid.vertex_position[at(i)]; });
  const Ragged<Index>& nodes = grid.vertices_on_cell;
  file.add<std::int32_t>("Cells", "connectivity", nodes.offsets.n_values(),
                         [&](std::int64_t i) { return nodes.values[at(i)]; });
  file.add<std::int64_t>("Cells", "offsets", n,
                         [&](std::int64_t i) { return nodes.offsets.end_of(i); });
  file.add<std::uint8_t>("Cells", "types", n, [](std::int64_t) { return kPolygon; });
  file.write(path);
}

void write_vtu_triangles(const std::string& path, const TriangleSet& set) {
  DELOS_ASSERT(set.surface.has_value());
  const double scale_m = set.surface->scale_m();
  const auto n_points = static_cast<std::int64_t>(set.position.size());
  const auto n = static_cast<std::int64_t>(set.corners.size());
  VtuFile file(n_points, n);
  file.add_surface(*set.surface, set.latitude);
  const auto add_column = [&](const char* name, const std::vector<double>& values) {
    if (values.empty()) return;
    file.add<double>("PointData", name, n_points,
                     [&values](std::int64_t i) { return values[at(i)]; });
  };
  add_column("spacing_m", set.spacing_m);
  add_column("depth_m", set.depth_m);
  file.add_points("Points", "Points", n_points,
                  [&](std::int64_t i) -> Vec3 { return scale_m * set.position[at(i)]; });
  file.add<std::int32_t>("Cells", "connectivity", 3 * n,
                         [&](std::int64_t i) { return set.corners[at(i / 3)][at(i % 3)]; });
  file.add<std::int64_t>("Cells", "offsets", n, [](std::int64_t i) { return 3 * (i + 1); });
  file.add<std::uint8_t>("Cells", "types", n, [](std::int64_t) { return kTriangle; });
  file.write(path);
}

}  // namespace delos
