// SPDX-License-Identifier: BSD-3-Clause
#include "io/jigsaw.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/byte_stream.hpp"
#include "io/file_text.hpp"

namespace delos {
namespace {

constexpr double kMetresPerUnit = 1000.0;
constexpr std::int64_t kMostJigsawIds = 2147483646;  // ids are 32 bit

std::string upper(std::string_view words) {
  std::string out;
  for (const char c : words) {
    if (c != ' ' && c != '\t') out += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return out;
}

class JigsawReader {
 public:
  explicit JigsawReader(const std::string& path)
      : path_(path), bytes_(read_file_bytes(path)), file_(path, bytes_) {}

  TriangleSet read();

 private:
  void read_key(const std::string& key, const std::string& value);
  std::int64_t count(const std::string& value) const;
  void read_points(std::int64_t n);
  void read_triangles(std::int64_t n);
  void read_values(const std::string& shape);
  void end_row();
  void place_points();

  std::string path_, bytes_;
  TextScanner file_;
  TriangleSet set_;
  bool is_ellipsoid_ = false;
  std::int64_t n_dimensions_ = 0;
  Array<Vec3> points_;
};

std::int64_t JigsawReader::count(const std::string& value) const {
  std::int64_t n = -1;
  const auto [end, status] = std::from_chars(value.data(), value.data() + value.size(), n);
  const bool is_count = status == std::errc() &&
                        (end == value.data() + value.size() || *end == ';') && n >= 0 &&
                        n <= kMostJigsawIds;
  if (!is_count)
    file_.fail("'", value.substr(0, 40), "' is no count in [0, ", kMostJigsawIds, "].");
  return n;
}

/// The tag behind the last number of a row.
void JigsawReader::end_row() {
  file_.expect(';');
  file_.integer("a tag");
}

void JigsawReader::read_points(std::int64_t n) {
  if (n_dimensions_ != (is_ellipsoid_ ? 2 : 3)) {
    file_.fail("NDIMS is ", n_dimensions_, ", must be 2 for an ELLIPSOID-MESH and 3 for others.");
  }
  for (std::int64_t i = 0; i < n; ++i) {
    Vec3 p(0.0, 0.0, 0.0);
    for (std::int64_t k = 0; k < n_dimensions_; ++k) {
      if (k > 0) file_.expect(';');
      p[static_cast<Eigen::Index>(k)] = file_.real("a coordinate");
    }
    end_row();
    points_.push_back(p);
  }
}

void JigsawReader::read_triangles(std::int64_t n) {
  for (std::int64_t i = 0; i < n; ++i) {
    std::array<Index, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (k > 0) file_.expect(';');
      const auto last = static_cast<std::int64_t>(points_.size()) - 1;
      corners[k] = static_cast<Index>(file_.integer("a corner", 0, last));
    }
    end_row();
    set_.corners.push_back(corners);
  }
}

void JigsawReader::read_values(const std::string& shape) {
  const std::int64_t n = count(shape);
  const bool is_spacing =
      n == static_cast<std::int64_t>(points_.size()) && shape.find(";1") == shape.size() - 2;
  for (std::int64_t i = 0; i < n; ++i) {
    if (is_spacing) {
      set_.spacing_m.push_back(kMetresPerUnit * file_.real("a value"));
    } else {
      file_.word("a row of values");
    }
  }
}

void JigsawReader::read_key(const std::string& key, const std::string& value) {
  if (key == "MSHID") {
    is_ellipsoid_ = value.find("ELLIPSOID-MESH") != std::string::npos;
    if (!is_ellipsoid_ && value.find("EUCLIDEAN-MESH") == std::string::npos) {
      file_.fail("'", value, "' is no mesh; only ELLIPSOID-MESH and EUCLIDEAN-MESH can be read.");
    }
  } else if (key == "NDIMS") {
    n_dimensions_ = count(value);
  } else if (key == "RADII") {
    TextScanner radii(path_, value);
    Vec3 radii_m;
    for (Eigen::Index k = 0; k < 3; ++k) {
      if (k > 0) radii.expect(';');
      radii_m[k] = kMetresPerUnit * radii.real("a radius");
      if (radii_m[k] <= 0.0) file_.fail("RADII=", value, " must be > 0.");
    }
    set_.surface = Ellipsoid(radii_m, Vec3::Zero());
  } else if (key == "POINT") {
    read_points(count(value));
  } else if (key == "TRIA3") {
    read_triangles(count(value));
  } else if (key == "VALUE") {
    read_values(value);
  } else {
    for (std::int64_t rows = count(value); rows > 0; --rows) file_.word("a row");
  }
}

void JigsawReader::place_points() {
  set_.latitude = LatitudeKind::parametric;
  if (!is_ellipsoid_) {
    for (const Vec3& p : points_) set_.position.push_back(kMetresPerUnit * p);
    settle_on_surface(path_, set_);
    return;
  }
  if (!set_.surface) set_.surface = Ellipsoid::sphere(kMetresPerUnit);
  for (const Vec3& p : points_) {
    set_.position.push_back(set_.surface->point({p.x(), p.y()}, LatitudeKind::parametric));
  }
}

TriangleSet JigsawReader::read() {
  bool is_mesh = false;
  while (!file_.at_end()) {
    const std::string line = upper(file_.take_line());
    if (line.empty() || line[0] == '#') continue;
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) file_.fail("the line before has no KEY=VALUE.");
    const std::string key = line.substr(0, equals);
    if (!is_mesh && key != "MSHID") file_.fail("no MSHID at the start, no file of JIGSAW.");
    is_mesh = true;
    read_key(key, line.substr(equals + 1));
  }
  if (set_.corners.empty()) file_.fail("there are no triangles (TRIA3).");
  place_points();
  return std::move(set_);
}

}  // namespace

void write_jigsaw(const std::string& path, const TriangleSet& set) {
  DELOS_ASSERT(set.surface.has_value());
  AtomicFile target(path, set.position.size() * 48 + set.corners.size() * 28);
  target.fill([&](const std::string& temporary) {
    ByteStream out(temporary);
    const Vec3 radii = set.surface->radii() * set.surface->scale_m() / kMetresPerUnit;
    out << "# made by delos\nMSHID=3;ELLIPSOID-MESH\nRADII=" << radii.x() << ';' << radii.y() << ';'
        << radii.z() << "\nNDIMS=2\nPOINT=" << static_cast<std::int64_t>(set.position.size())
        << '\n';
    for (const Vec3& p : set.position) {
      const LonLat place = set.surface->lon_lat(p, LatitudeKind::parametric);
      out << place.lon_rad << ';' << place.lat_rad << ";0\n";
    }
    if (!set.spacing_m.empty()) {
      out << "VALUE=" << static_cast<std::int64_t>(set.spacing_m.size()) << ";1\n";
      for (const double spacing_m : set.spacing_m) out << spacing_m / kMetresPerUnit << '\n';
    }
    out << "TRIA3=" << static_cast<std::int64_t>(set.corners.size()) << '\n';
    for (const auto& corner : set.corners) {
      out << corner[0] << ';' << corner[1] << ';' << corner[2] << ";0\n";
    }
    out.close();
  });
  target.commit();
}

TriangleSet read_jigsaw(const std::string& path) { return JigsawReader(path).read(); }

}  // namespace delos
