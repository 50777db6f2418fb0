// SPDX-License-Identifier: BSD-3-Clause
// What Gmsh, VTK (ParaView's reader) and meshio find in our mesh files.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "io/gmsh.hpp"
#include "io/vtu.hpp"
#include "support/run_command.hpp"
#include "support/sample_grids.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using delos::testing::Outcome;
using delos::testing::run;
using delos::testing::TemporaryFolder;

namespace {

// Debian's own, for which the packages of the readers are.
const std::string kReader =
    std::string("/usr/bin/python3 ") + DELOS_SOURCE_DIR + "/tests/referee/read_mesh.py ";

/// Those of the readers that this machine has; a message for each of the others.
std::vector<std::string> present(const std::vector<std::string>& readers) {
  std::vector<std::string> out;
  for (const std::string& reader : readers) {
    if (run(kReader + "--has " + reader).status == 0) {
      out.push_back(reader);
    } else {
      MESSAGE("skipped: Python has no " << reader);
    }
  }
  return out;
}

/// What the reader tells of the file, by key.
std::map<std::string, double> read(const std::string& reader, const std::string& path) {
  const Outcome outcome = run(kReader + reader + " " + path);
  REQUIRE_MESSAGE(outcome.status == 0, outcome.output);
  std::map<std::string, double> out;
  std::istringstream lines(outcome.output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key;
    double value = 0.0;
    if (words >> key >> value) out[key] = value;
  }
  return out;
}

TriangleSet sphere_set(int levels) {
  const Ellipsoid sphere = Ellipsoid::sphere(6371220.0);
  return triangle_set(sphere, LatitudeKind::geodetic,
                      samples::bisected_icosahedron(sphere, levels));
}

/// Of the flat triangles.
double area_m2(const TriangleSet& set) {
  double area = 0.0;
  for (const auto& corners : set.corners) {
    const auto at = [&](std::size_t k) {
      return set.position[static_cast<std::size_t>(corners[k])];
    };
    area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
  }
  return area * set.surface->scale_m() * set.surface->scale_m();
}

void check_triangles(std::map<std::string, double> found, const TriangleSet& set,
                     double n_border = 0.0) {
  CHECK(found["n_points"] == static_cast<double>(set.position.size()));
  CHECK(found["n_cells"] == static_cast<double>(set.corners.size()));
  CHECK(found["n_border"] == n_border);
  CHECK(found["n_other"] == 0.0);
  CHECK(found["area"] == doctest::Approx(area_m2(set)).epsilon(1e-12));
}

}  // namespace

TEST_CASE("gmsh -check finds nothing wrong with our triangles") {
  if (run("command -v gmsh").status != 0) {
    MESSAGE("skipped: there is no gmsh");
    return;
  }
  const TemporaryFolder folder;
  const TriangleSet set = sphere_set(3);
  write_gmsh(folder.file("sphere.msh"), set);
  const Outcome outcome = run("gmsh -check " + folder.file("sphere.msh") + " -");
  CHECK_MESSAGE(outcome.status == 0, outcome.output);
  CHECK(outcome.says("642 nodes"));
  CHECK(outcome.says("1280 elements"));
  CHECK_MESSAGE(!outcome.says("Warning"), outcome.output);
  CHECK_MESSAGE(!outcome.says("Error"), outcome.output);
}

TEST_CASE("Gmsh and meshio read our .msh files, with a border or none") {
  const TemporaryFolder folder;
  for (const std::string& reader : present({"gmsh", "meshio"})) {
    CAPTURE(reader);
    TriangleSet set = sphere_set(3);
    write_gmsh(folder.file("closed.msh"), set);
    check_triangles(read(reader, folder.file("closed.msh")), set);
    set.corners.erase(set.corners.begin());
    set.spacing_m.assign(set.position.size(), 1e5);
    set.depth_m.assign(set.position.size(), 4000.0);
    write_gmsh(folder.file("open.msh"), set);
    check_triangles(read(reader, folder.file("open.msh")), set, 3.0);
  }
}

TEST_CASE("VTK and meshio read our .vtu triangles") {
  const TemporaryFolder folder;
  for (const std::string& reader : present({"vtk", "meshio"})) {
    CAPTURE(reader);
    for (const int levels : {0, 1, 3}) {
      TriangleSet set = sphere_set(levels);
      write_vtu_triangles(folder.file("a.vtu"), set);
      check_triangles(read(reader, folder.file("a.vtu")), set);
      set.depth_m.assign(set.position.size(), 4000.0);
      write_vtu_triangles(folder.file("b.vtu"), set);
      check_triangles(read(reader, folder.file("b.vtu")), set);
    }
  }
}

TEST_CASE("VTK and meshio read our .vtu cells with their areas and spacings") {
  const TemporaryFolder folder;
  for (const std::string& reader : present({"vtk", "meshio"})) {
    CAPTURE(reader);
    for (const int levels : {0, 1, 2, 4}) {
      const Ellipsoid sphere = Ellipsoid::sphere(6371220.0);
      const Grid grid = samples::grid_of(sphere, samples::bisected_icosahedron(sphere, levels));
      write_vtu_cells(folder.file("cells.vtu"), grid);
      auto found = read(reader, folder.file("cells.vtu"));
      CHECK(found["n_points"] == static_cast<double>(grid.n_vertices()));
      CHECK(found["n_cells"] == static_cast<double>(grid.n_cells()));
      CHECK(found["n_border"] == 0.0);
      CHECK(found["n_other"] == 0.0);
      const auto sum = [](const Array<double>& values) {
        return std::accumulate(values.begin(), values.end(), 0.0);
      };
      CHECK(found["area_m2"] == doctest::Approx(sum(grid.cell_area_m2)).epsilon(1e-12));
      CHECK(found["spacing_m"] == doctest::Approx(sum(grid.cell_spacing_m)).epsilon(1e-12));
    }
  }
}
