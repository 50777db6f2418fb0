// SPDX-License-Identifier: BSD-3-Clause
#include "io/fesom.hpp"

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/byte_stream.hpp"
#include "io/file_text.hpp"

namespace delos {
namespace {

namespace fs = std::filesystem;

constexpr double kFesomRadiusM = 6367500.0;  // r_earth of FESOM2's o_PARAM
constexpr char kNodes[] = "nod2d.out";
constexpr std::int64_t kMostFesomIds = 2147483646;  // ids are 32 bit

/// The node file itself.
fs::path nodes_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored) ? path / kNodes : path;
}

fs::path companion(const fs::path& nodes, const char* kind) {
  std::string name = nodes.filename().string();
  name.replace(name.size() - sizeof(kNodes) + 1, sizeof(kNodes) - 1, kind);
  return nodes.parent_path() / name;
}

void read_nodes(const std::string& path, TriangleSet& set) {
  const std::string bytes = read_file_bytes(path);
  TextScanner file(path, bytes);
  const std::int64_t n = file.integer("the number of nodes", 3, kMostFesomIds);
  for (std::int64_t i = 1; i <= n; ++i) {
    const std::int64_t id = file.integer("the id of a node");
    if (id != i) file.fail("node ", id, " stands where ", i, " should; ids go from 1 to ", n, ".");
    const double lon_deg = file.real("a longitude");
    const double lat_deg = file.real("a latitude");
    if (lat_deg < -90.0 || lat_deg > 90.0) file.fail("latitude ", lat_deg, " is beyond a pole.");
    file.integer("the mark of the border");
    set.position.push_back(
        set.surface->point({lon_deg * kRadPerDeg, lat_deg * kRadPerDeg}, set.latitude));
  }
  if (!file.at_end()) file.fail("there is more than the ", n, " nodes of the first line.");
}

void read_elements(const std::string& path, TriangleSet& set) {
  const std::string bytes = read_file_bytes(path);
  TextScanner file(path, bytes);
  const std::int64_t n = file.integer("the number of triangles", 1, kMostFesomIds);
  const auto n_nodes = static_cast<std::int64_t>(set.position.size());
  for (std::int64_t i = 0; i < n; ++i) {
    std::array<Index, 3> corners{};
    for (Index& corner : corners) {
      corner = static_cast<Index>(file.integer("a corner", 1, n_nodes) - 1);
    }
    set.corners.push_back(corners);
  }
  if (!file.at_end()) file.fail("there is more than the ", n, " triangles of the first line.");
}

/// Some files have depths below zero, some above.
void read_depths(const std::string& path, TriangleSet& set) {
  const std::string bytes = read_file_bytes(path);
  TextScanner file(path, bytes);
  constexpr std::int64_t kMostLevels = 100'000;
  const std::int64_t n_levels = file.integer("the number of levels", 1, kMostLevels);
  for (std::int64_t i = 0; i < n_levels; ++i) {
    set.level_m.push_back(std::abs(file.real("the depth of a level")));
  }
  for (std::size_t i = 0; i < set.position.size(); ++i) {
    set.depth_m.push_back(std::abs(file.real("the depth at a node")));
  }
  if (!file.at_end()) file.fail("there is more than ", set.position.size(), " depths of nodes.");
}

void put_nodes(const std::string& path, const TriangleSet& set) {
  const std::vector<char> mark = border_points(set);
  AtomicFile target(path, set.position.size() * 48);
  target.fill([&](const std::string& temporary) {
    ByteStream out(temporary);
    out << static_cast<std::int64_t>(set.position.size()) << '\n';
    for (std::size_t i = 0; i < set.position.size(); ++i) {
      const LonLat place = set.surface->lon_lat(set.position[i], set.latitude);
      out << static_cast<std::int64_t>(i + 1) << ' ' << place.lon_rad * kDegPerRad << ' '
          << std::clamp(place.lat_rad * kDegPerRad, -90.0, 90.0) << ' ' << std::int32_t{mark[i]}
          << '\n';
    }
    out.close();
  });
  target.commit();
}

void put_elements(const std::string& path, const TriangleSet& set) {
  AtomicFile target(path, set.corners.size() * 24);
  target.fill([&](const std::string& temporary) {
    ByteStream out(temporary);
    out << static_cast<std::int64_t>(set.corners.size()) << '\n';
    for (const auto& corner : set.corners) {
      out << corner[0] + 1 << ' ' << corner[2] + 1 << ' ' << corner[1] + 1 << '\n';
    }
    out.close();
  });
  target.commit();
}

void put_depths(const std::string& path, const TriangleSet& set) {
  AtomicFile target(path, set.depth_m.size() * 20);
  target.fill([&](const std::string& temporary) {
    ByteStream out(temporary);
    out << static_cast<std::int64_t>(set.level_m.size()) << '\n';
    for (const double level_m : set.level_m) out << 0.0 - level_m << '\n';
    for (const double depth_m : set.depth_m) out << 0.0 - depth_m << '\n';
    out.close();
  });
  target.commit();
}

}  // namespace

bool is_fesom(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return fs::exists(fs::path(path) / kNodes, ignored);
  const std::string name = fs::path(path).filename().string();
  return name.size() >= sizeof(kNodes) - 1 &&
         name.compare(name.size() - sizeof(kNodes) + 1, std::string::npos, kNodes) == 0;
}

std::vector<FesomFile> fesom_files(const TriangleSet& set) {
  DELOS_ASSERT(set.surface.has_value());
  std::vector<char> is_used(set.position.size(), 0);
  for (const auto& corner : set.corners) {
    for (const Index i : corner) is_used[static_cast<std::size_t>(i)] = 1;
  }
  const auto unused = std::find(is_used.begin(), is_used.end(), 0);
  DELOS_CHECK(unused == is_used.end(), ErrorKind::output, "node ", unused - is_used.begin() + 1,
              " (from 1) belongs to no triangle, which FESOM2 does not take.");
  std::vector<FesomFile> out;
  out.push_back({kNodes, [&set](const std::string& path) { put_nodes(path, set); }});
  out.push_back({"elem2d.out", [&set](const std::string& path) { put_elements(path, set); }});
  if (!set.depth_m.empty() && !set.level_m.empty()) {
    out.push_back({"aux3d.out", [&set](const std::string& path) { put_depths(path, set); }});
  }
  return out;
}

void write_fesom(const std::string& folder, const TriangleSet& set) {
  OutputSet files;
  for (const FesomFile& file : fesom_files(set)) {
    files.add(fs::path(folder) / file.name, 0, file.write);
  }
  files.commit();
}

TriangleSet read_fesom(const std::string& path) {
  const fs::path nodes = nodes_file(path);
  TriangleSet out;
  out.surface = Ellipsoid::sphere(kFesomRadiusM);
  out.latitude = LatitudeKind::geocentric;
  read_nodes(nodes.string(), out);
  read_elements(companion(nodes, "elem2d.out").string(), out);
  const fs::path depths = companion(nodes, "aux3d.out");
  std::error_code ignored;
  if (fs::exists(depths, ignored)) read_depths(depths.string(), out);
  return out;
}

}  // namespace delos
