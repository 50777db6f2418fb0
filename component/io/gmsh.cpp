// SPDX-License-Identifier: BSD-3-Clause
#include "io/gmsh.hpp"

#include <algorithm>
#include <unordered_map>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/byte_stream.hpp"
#include "io/file_text.hpp"

namespace delos {
namespace {

constexpr std::int64_t kMostIds = 2147483646;  // ids are 32 bit
constexpr std::int64_t kMostEntities = 1'000'000;

// Gmsh's codes of elements (manual, section 10.1), and how many nodes each has.
constexpr std::int64_t kGmshTriangle = 2;
std::int64_t nodes_of_passed_over(std::int64_t type) {
  return type == 15 ? 1 : type == 1 ? 2 : 0;  // points and lines
}

const char* name_of(LatitudeKind kind) {
  return kind == LatitudeKind::geodetic     ? "geodetic"
         : kind == LatitudeKind::geocentric ? "geocentric"
                                            : "parametric";
}

void put_head(ByteStream& out, const TriangleSet& set) {
  const Vec3 radii_m = set.surface->radii() * set.surface->scale_m();
  out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\ndelos_radii_m " << radii_m.x() << ' '
      << radii_m.y() << ' ' << radii_m.z() << "\ndelos_latitude " << name_of(set.latitude)
      << "\n$EndComments\n$Entities\n0 0 1 0\n1 " << -radii_m.x() << ' ' << -radii_m.y() << ' '
      << -radii_m.z() << ' ' << radii_m.x() << ' ' << radii_m.y() << ' ' << radii_m.z()
      << " 0 0\n$EndEntities\n";
}

void put_nodes(ByteStream& out, const TriangleSet& set) {
  const auto n = static_cast<std::int64_t>(set.position.size());
  out << "$Nodes\n1 " << n << " 1 " << n << "\n2 1 0 " << n << '\n';
  for (std::int64_t tag = 1; tag <= n; ++tag) out << tag << '\n';
  const double scale_m = set.surface->scale_m();
  for (const Vec3& p : set.position) {
    out << scale_m * p.x() << ' ' << scale_m * p.y() << ' ' << scale_m * p.z() << '\n';
  }
  out << "$EndNodes\n";
}

void put_elements(ByteStream& out, const TriangleSet& set) {
  const auto n = static_cast<std::int64_t>(set.corners.size());
  out << "$Elements\n1 " << n << " 1 " << n << "\n2 1 " << kGmshTriangle << ' ' << n << '\n';
  for (std::int64_t tag = 1; tag <= n; ++tag) {
    const auto& corner = set.corners[static_cast<std::size_t>(tag - 1)];
    out << tag << ' ' << corner[0] + 1 << ' ' << corner[1] + 1 << ' ' << corner[2] + 1 << '\n';
  }
  out << "$EndElements\n";
}

void put_data(ByteStream& out, const char* name, const std::vector<double>& values) {
  if (values.empty()) return;
  const auto n = static_cast<std::int64_t>(values.size());
  out << "$NodeData\n1\n\"" << name << "\"\n1\n0\n3\n0\n1\n" << n << '\n';
  for (std::int64_t tag = 1; tag <= n; ++tag) {
    out << tag << ' ' << values[static_cast<std::size_t>(tag - 1)] << '\n';
  }
  out << "$EndNodeData\n";
}

class GmshReader {
 public:
  explicit GmshReader(const std::string& path)
      : path_(path), bytes_(read_file_bytes(path)), file_(path, bytes_) {}

  TriangleSet read();

 private:
  void read_format();
  void read_comments();
  void read_nodes();
  void read_elements();
  void read_data();
  void skip(const std::string& section);
  void end(const char* section);
  Index point_of(std::int64_t tag) const;

  std::string path_, bytes_;
  TextScanner file_;
  TriangleSet set_;
  std::vector<std::int64_t> tags_;                        // of the points
  std::unordered_map<std::int64_t, Index> point_of_tag_;  // empty: tag i + 1 is point i
};

void GmshReader::end(const char* section) {
  const std::string_view word = file_.word(section);
  if (word != section) file_.fail("expected ", section, ", found '", word.substr(0, 40), "'.");
}

void GmshReader::read_format() {
  const std::string_view version = file_.word("the version");
  if (version != "4.1") {
    file_.fail("version ", version.substr(0, 10), ", only 4.1 can be read. Save it as 4.1.");
  }
  if (file_.integer("the kind of file") != 0) {
    file_.fail("the file is binary, only ASCII can be read. Save it in ASCII.");
  }
  file_.integer("the size of numbers");
  end("$EndMeshFormat");
}

void GmshReader::read_comments() {
  for (;;) {
    const std::string_view word = file_.word("$EndComments");
    if (word == "$EndComments") return;
    if (word == "delos_radii_m") {
      const double a = file_.real("a radius"), b = file_.real("a radius"),
                   c = file_.real("a radius");
      if (std::min({a, b, c}) <= 0.0) file_.fail("radii must be > 0.");
      set_.surface = Ellipsoid(Vec3(a, b, c), Vec3::Zero());
    } else if (word == "delos_latitude") {
      const std::string_view kind = file_.word("the kind of latitude");
      if (kind == "geocentric") set_.latitude = LatitudeKind::geocentric;
      if (kind == "parametric") set_.latitude = LatitudeKind::parametric;
    }
  }
}

void GmshReader::read_nodes() {
  const std::int64_t n_blocks = file_.integer("the number of blocks", 0, kMostEntities);
  const std::int64_t n = file_.integer("the number of nodes", 0, kMostIds);
  file_.integer("the least tag");
  file_.integer("the largest tag");
  for (std::int64_t block = 0; block < n_blocks; ++block) {
    const std::int64_t dimension = file_.integer("the dimension of a block", 0, 3);
    file_.integer("the tag of an entity");
    const std::int64_t n_parameters = file_.integer("0 or 1", 0, 1) * dimension;
    const auto most = n - static_cast<std::int64_t>(tags_.size());
    const std::int64_t n_here = file_.integer("the number of nodes of a block", 0, most);
    for (std::int64_t i = 0; i < n_here; ++i) tags_.push_back(file_.integer("the tag of a node"));
    for (std::int64_t i = 0; i < n_here; ++i) {
      const double x = file_.real("x"), y = file_.real("y"), z = file_.real("z");
      for (std::int64_t k = 0; k < n_parameters; ++k) file_.real("a parameter");
      set_.position.push_back({x, y, z});
    }
  }
  end("$EndNodes");
  bool in_order = true;
  for (std::size_t i = 0; i < tags_.size() && in_order; ++i) {
    in_order = tags_[i] == static_cast<std::int64_t>(i + 1);
  }
  for (std::size_t i = 0; i < tags_.size() && !in_order; ++i) {
    if (!point_of_tag_.emplace(tags_[i], static_cast<Index>(i)).second) {
      file_.fail("two nodes have the tag ", tags_[i], ".");
    }
  }
}

Index GmshReader::point_of(std::int64_t tag) const {
  if (point_of_tag_.empty()) {
    if (tag >= 1 && tag <= static_cast<std::int64_t>(tags_.size())) {
      return static_cast<Index>(tag - 1);
    }
  } else if (const auto found = point_of_tag_.find(tag); found != point_of_tag_.end()) {
    return found->second;
  }
  file_.fail("there is no node with the tag ", tag, ".");
}

void GmshReader::read_elements() {
  const std::int64_t n_blocks = file_.integer("the number of blocks", 0, kMostEntities);
  file_.integer("the number of elements", 0, kMostIds);
  file_.integer("the least tag");
  file_.integer("the largest tag");
  for (std::int64_t block = 0; block < n_blocks; ++block) {
    file_.integer("the dimension of a block", 0, 3);
    file_.integer("the tag of an entity");
    const std::int64_t type = file_.integer("the type of elements");
    const std::int64_t n_here = file_.integer("the number of elements of a block", 0, kMostIds);
    const std::int64_t n_skipped = nodes_of_passed_over(type);
    if (type != kGmshTriangle && n_skipped == 0) {
      file_.fail("elements of Gmsh's type ", type,
                 "; only triangles (2), lines (1) and points (15) can be read.");
    }
    for (std::int64_t i = 0; i < n_here; ++i) {
      file_.integer("the tag of an element");
      for (std::int64_t k = 0; k < n_skipped; ++k) file_.integer("a node");
      if (type != kGmshTriangle) continue;
      std::array<Index, 3> corners{};
      for (Index& corner : corners) corner = point_of(file_.integer("a node"));
      set_.corners.push_back(corners);
    }
  }
  end("$EndElements");
}

void GmshReader::read_data() {
  const std::int64_t n_names = file_.integer("the number of names", 0, kMostEntities);
  std::string name;
  for (std::int64_t i = 0; i < n_names; ++i) {
    const std::string_view word = file_.word("the name of the data");
    if (i == 0) name = word;
  }
  std::vector<double>* const out = name == "\"spacing_m\"" ? &set_.spacing_m
                                   : name == "\"depth_m\"" ? &set_.depth_m
                                                           : nullptr;
  if (out == nullptr) return skip("NodeData");
  for (std::int64_t k = file_.integer("the number of reals", 0, kMostEntities); k > 0; --k) {
    file_.real("a real");
  }
  std::int64_t n = 0;
  for (std::int64_t k = file_.integer("the number of integers", 3, kMostEntities); k > 0; --k) {
    const std::int64_t value = file_.integer("an integer");
    if (k == 1) n = value;
  }
  if (n != static_cast<std::int64_t>(tags_.size())) {
    file_.fail(name, " has ", n, " values for ", tags_.size(), " nodes.");
  }
  out->resize(tags_.size());
  for (std::int64_t i = 0; i < n; ++i) {
    const Index point = point_of(file_.integer("the tag of a node"));
    (*out)[static_cast<std::size_t>(point)] = file_.real("a value");
  }
  end("$EndNodeData");
}

void GmshReader::skip(const std::string& section) {
  const std::string last = "$End" + section;
  while (file_.word(last.c_str()) != last) {
  }
}

TriangleSet GmshReader::read() {
  if (file_.word("$MeshFormat") != "$MeshFormat") file_.fail("no $MeshFormat, no file of Gmsh.");
  read_format();
  while (!file_.at_end()) {
    const std::string section(file_.word("a section"));
    if (section.empty() || section[0] != '$') {
      file_.fail("expected a section, found '", section.substr(0, 40), "'.");
    } else if (section == "$Comments") {
      read_comments();
    } else if (section == "$Nodes") {
      read_nodes();
    } else if (section == "$Elements") {
      read_elements();
    } else if (section == "$NodeData") {
      read_data();
    } else {
      skip(section.substr(1));
    }
  }
  if (set_.corners.empty()) file_.fail("there are no triangles.");
  settle_on_surface(path_, set_);
  return std::move(set_);
}

}  // namespace

void write_gmsh(const std::string& path, const TriangleSet& set) {
  DELOS_ASSERT(set.surface.has_value());
  AtomicFile target(path, set.position.size() * 64 + set.corners.size() * 32);
  target.fill([&](const std::string& temporary) {
    ByteStream out(temporary);
    put_head(out, set);
    put_nodes(out, set);
    put_elements(out, set);
    put_data(out, "spacing_m", set.spacing_m);
    put_data(out, "depth_m", set.depth_m);
    out.close();
  });
  target.commit();
}

TriangleSet read_gmsh(const std::string& path) { return GmshReader(path).read(); }

}  // namespace delos
