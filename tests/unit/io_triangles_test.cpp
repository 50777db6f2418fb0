// SPDX-License-Identifier: BSD-3-Clause
// Gmsh, JIGSAW and FESOM2: what is written is read back; what is malformed is refused by its line.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "io/fesom.hpp"
#include "io/file_text.hpp"
#include "io/gmsh.hpp"
#include "io/jigsaw.hpp"
#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"
#include "support/temporary_folder.hpp"

using delos::Ellipsoid;
using delos::ErrorKind;
using delos::LatitudeKind;
using delos::TriangleSet;
using delos::Vec3;
using delos::testing::expect_error;
using delos::testing::TemporaryFolder;

namespace {

constexpr double kRounding = 1e-14;

std::array<Ellipsoid, 3> bodies() {
  return {Ellipsoid::sphere(6371220.0), Ellipsoid::wgs84(),
          Ellipsoid(Vec3(1.2e6, 1.0e6, 0.8e6), Vec3(0, 0, 0))};
}

/// The whole body, or half of it with a border.
TriangleSet sample(const Ellipsoid& body, bool is_open) {
  TriangleSet set =
      delos::triangle_set(body, LatitudeKind::geodetic, delos::samples::shaken(body, 3, 0.1, 5));
  if (is_open) set.corners.resize(set.corners.size() / 2);
  set.spacing_m.assign(set.position.size(), 1.0 / 3.0);
  set.spacing_m[1] = 123456.789;
  return set;
}

double difference(const TriangleSet& a, const TriangleSet& b) {
  REQUIRE(a.position.size() == b.position.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    worst = std::max(worst, (a.position[i] - b.position[i]).norm());
  }
  return worst;
}

void write_text(const std::string& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

}  // namespace

TEST_CASE("Gmsh files are read back, triangles, spacing and body") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.msh");
  for (const Ellipsoid& body : bodies()) {
    for (const bool is_open : {false, true}) {
      const TriangleSet set = sample(body, is_open);
      delos::write_gmsh(path, set);
      const TriangleSet read = delos::read_gmsh(path);
      CHECK(read.corners == set.corners);
      CHECK(read.spacing_m == set.spacing_m);
      CHECK((read.surface->radii() - body.radii()).norm() < kRounding);
      CHECK(difference(read, set) < kRounding);
    }
  }
}

TEST_CASE("JIGSAW files are read back, triangles, spacing and body") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.msh");
  for (const Ellipsoid& body : bodies()) {
    for (const bool is_open : {false, true}) {
      const TriangleSet set = sample(body, is_open);
      delos::write_jigsaw(path, set);
      const TriangleSet read = delos::read_jigsaw(path);
      CHECK(read.corners == set.corners);
      REQUIRE(read.spacing_m.size() == set.spacing_m.size());
      for (std::size_t i = 0; i < set.spacing_m.size(); ++i) {
        CHECK(read.spacing_m[i] == doctest::Approx(set.spacing_m[i]).epsilon(1e-15));
      }
      CHECK((read.surface->radii() - body.radii()).norm() < kRounding);
      CHECK(difference(read, set) < kRounding);
    }
  }
}

TEST_CASE("FESOM2 meshes are written clockwise and read back, with depths and marks") {
  const TemporaryFolder folder;
  TriangleSet set = sample(Ellipsoid::sphere(6367500.0), false);
  set.spacing_m.clear();
  set.depth_m.assign(set.position.size(), 5400.5);
  set.level_m = {0.0, 5.0, 6000.0};
  delos::write_fesom(folder.file(""), set);
  TriangleSet read = delos::read_fesom(folder.file(""));
  CHECK(delos::orient(read) == static_cast<std::int64_t>(set.corners.size()));
  CHECK(read.corners == set.corners);
  CHECK(read.depth_m == set.depth_m);
  CHECK(read.level_m == set.level_m);
  CHECK(difference(read, set) < kRounding);
  const std::string levels = delos::read_file_bytes(folder.file("aux3d.out"));
  CHECK(levels.rfind("3\n0\n-5\n-6000\n-5400.5\n", 0) == 0);
  CHECK(delos::is_fesom(folder.file("nod2d.out")));
  CHECK(!delos::is_fesom(folder.file("elem2d.out")));

  set.corners.resize(set.corners.size() - 1);  // three border nodes
  delos::write_fesom(folder.file(""), set);
  const std::string nodes = delos::read_file_bytes(folder.file("nod2d.out"));
  std::size_t n_marked = 0;
  for (std::size_t at = 0; (at = nodes.find(" 1\n", at)) != std::string::npos; ++at) ++n_marked;
  CHECK(n_marked == 3);
  set.corners.resize(3);
  expect_error(ErrorKind::output, {"belongs to no triangle"},
               [&] { delos::write_fesom(folder.file(""), set); });
}

TEST_CASE("the companions of a FESOM2 node file share its prefix") {
  const TemporaryFolder folder;
  write_text(folder.file("pi_nod2d.out"), "   3\n 1 0 0 1\n 2 350. 10 1\r\n 3 370 -10 1\n");
  write_text(folder.file("pi_elem2d.out"), "1 \n 1 2 3\n");
  const TriangleSet read = delos::read_fesom(folder.file("pi_nod2d.out"));
  CHECK(read.corners.size() == 1);
  CHECK(read.depth_m.empty());
  const auto refused = [&](const char* name, const std::string& content, const char* where,
                           const char* reason) {
    write_text(folder.file(name), content);
    expect_error(ErrorKind::input, {folder.file(name) + where, reason},
                 [&] { delos::read_fesom(folder.file("pi_nod2d.out")); });
  };
  refused("pi_aux3d.out", "2\n0\n-5\n-1\n-2\n", ":6: ", "cut off");
  refused("pi_elem2d.out", "1\n1 2 4\n", ":2: ", "must be in [1, 3]");
  refused("pi_elem2d.out", "1\n1 2 3\n1 2 3\n", ":3: ", "more than");
  refused("pi_nod2d.out", "3\n1 0 0 1\n3 0 1 1\n2 1 1 1\n", ":3: ", "node 3 stands where 2");
  refused("pi_nod2d.out", "3\n1 0 91 1\n", ":2: ", "beyond a pole");
  refused("pi_nod2d.out", "3\n1 nan 9 1\n", ":2: ", "'nan'");
  refused("pi_nod2d.out", "", ":1: ", "cut off");
}

TEST_CASE("Gmsh files of others are read: gaps in tags, lines, parameters, sections") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.msh");
  const std::string head = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  const std::string rest =
      "$PhysicalNames\n1\n2 7 \"sea\"\n$EndPhysicalNames\n"
      "$Nodes\n2 3 10 30\n0 1 0 1\n10\n2 0 0\n2 1 1 2\n30\n20\n0 2 0 0.5 0.5\n0 0 2 0.25 0.5\n"
      "$EndNodes\n$Elements\n3 3 1 3\n0 1 15 1\n1 10\n1 1 1 1\n2 10 30\n2 1 2 1\n3 10 30 20\n"
      "$EndElements\n";
  write_text(path, head + rest);
  const TriangleSet read = delos::read_gmsh(path);
  REQUIRE(read.corners.size() == 1);
  CHECK(read.corners[0] == std::array<delos::Index, 3>{0, 1, 2});
  CHECK(read.surface->scale_m() == 2.0);

  const auto refused = [&](std::string content, const std::string& from, const std::string& to,
                           std::initializer_list<std::string> parts) {
    const std::size_t at = content.find(from);
    REQUIRE(at != std::string::npos);
    write_text(path, content.replace(at, from.size(), to));
    expect_error(ErrorKind::input, parts, [&] { delos::read_gmsh(path); });
  };
  const std::string all = head + rest;
  refused(all, "4.1", "2.2", {path + ":2: ", "2.2"});
  refused(all, "4.1 0", "4.1 1", {path + ":2: ", "binary"});
  refused(all, "3 10 30 20", "3 10 30 21", {path + ":26: ", "21"});
  refused(all, "30\n20\n", "30\n30\n", {"two nodes have the tag 30"});
  refused(all, "0 2 0 0.5", "0 2 O 0.5", {path + ":16: ", "'O'"});
  refused(all, "2 1 2 1\n3 10 30 20", "2 1 3 1\n3 10 30 20 10", {"type 3"});
  refused(all, "$EndElements\n", "", {"cut off"});
  refused(all, "0 0 2 0.25", "0 0 1 0.25", {"is not on the surface"});
}

TEST_CASE("JIGSAW files of others are read, on Cartesian points too") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.msh");
  const std::string all =
      "# by hand\nmshid=3;EUCLIDEAN-MESH\nNDIMS=3\nPOINT=3\n1;0;0;0\n0;1;0;7\n0;0;1;0\n"
      "EDGE2=1\n0;1;0\nTRIA3=1\n0;1;2;0\n";
  write_text(path, all);
  const TriangleSet read = delos::read_jigsaw(path);
  CHECK(read.corners.size() == 1);
  CHECK(read.surface->scale_m() == 1000.0);

  const auto refused = [&](std::string content, const std::string& from, const std::string& to,
                           std::initializer_list<std::string> parts) {
    const std::size_t at = content.find(from);
    REQUIRE(at != std::string::npos);
    write_text(path, content.replace(at, from.size(), to));
    expect_error(ErrorKind::input, parts, [&] { delos::read_jigsaw(path); });
  };
  refused(all, "0;1;2;0", "0;1;3;0", {path + ":11: ", "must be in [0, 2]"});
  refused(all, "0;1;0;7", "0;1;0", {path + ":6: ", "';'"});
  refused(all, "EUCLIDEAN-MESH", "EUCLIDEAN-GRID", {"no mesh"});
  refused(all, "TRIA3=1", "TRIA3=x", {"no count"});
  refused(all, "mshid", "something", {"no MSHID"});
  refused(all, "0;1;2;0\n", "", {"cut off"});
}
