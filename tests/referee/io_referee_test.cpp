// SPDX-License-Identifier: BSD-3-Clause
// The files before readers that share nothing with this library: the checkers in the folder that
// DELOS_REFEREE_TOOLS names (check_mpas.py, check_mesh.py) and CDO.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>

#include "io/mpas.hpp"
#include "io/scrip.hpp"
#include "io/spacing_file.hpp"
#include "io/ugrid.hpp"
#include "support/run_command.hpp"
#include "support/sample_grids.hpp"
#include "support/temporary_folder.hpp"

using delos::Ellipsoid;
using delos::LatitudeKind;
using delos::Mesh;
using delos::SphereMap;
using delos::Vec3;
using delos::testing::Outcome;
using delos::testing::run;
using delos::testing::TemporaryFolder;

namespace {

/// Command of a checker; empty, with a message, when it is not there.
std::string checker(const std::string& script) {
  const char* tools = std::getenv("DELOS_REFEREE_TOOLS");
  if (tools == nullptr) {
    MESSAGE("skipped: DELOS_REFEREE_TOOLS names no folder with " << script);
    return "";
  }
  return "/usr/bin/python3 " + std::string(tools) + "/" + script + " ";
}

bool has_cdo() {
  if (run("command -v cdo").status == 0) return true;
  MESSAGE("skipped: there is no cdo");
  return false;
}

struct Body {
  const char* name;
  Ellipsoid surface;
};

std::array<Body, 3> bodies() {
  return {{{"sphere", Ellipsoid::sphere(6371220.0)},
           {"WGS 84", Ellipsoid::wgs84()},
           {"triaxial", Ellipsoid(Vec3(1.2, 1.0, 0.8), Vec3(0, 0, 0))}}};
}

/// The surface point whose image is `target`, by steps against the error; the map is conformal.
Vec3 point_with_image(const Ellipsoid& surface, const SphereMap& map, const Vec3& target) {
  Vec3 p = surface.project(target);
  for (int step = 0; step < 100; ++step) {
    p = surface.project(p + 0.5 * (target - map(p)) / map.stretch(p));
  }
  return p;
}

/// Acute triangles on the body: the bisected icosahedron, taken back from the sphere.
Mesh sample_mesh(const Body& body) {
  const SphereMap map(body.surface, delos::SphereMapKind::conformal);
  Mesh mesh = delos::samples::bisected_icosahedron(Ellipsoid(), 3);
  for (delos::Vertex& vertex : mesh.vertices) {
    const Vec3 p = point_with_image(body.surface, map, vertex.position());
    vertex = {p.x(), p.y(), p.z(), vertex.spacing / map.stretch(p)};
  }
  return mesh;
}

}  // namespace

TEST_CASE("check_mpas.py accepts grids of the sphere, WGS 84 and a triaxial body") {
  const std::string check = checker("check_mpas.py");
  if (check.empty()) return;
  const TemporaryFolder folder;
  for (const Body& body : bodies()) {
    CAPTURE(std::string(body.name));
    const SphereMap map(body.surface);
    const delos::Grid grid =
        delos::samples::grid_of(map.sphere(), delos::samples::on_sphere(map, sample_mesh(body)));
    for (const bool on_unit_sphere : {false, true}) {
      delos::write_mpas(folder.file("grid.nc"), grid, delos::samples::provenance(),
                        {delos::netcdf::Format::cdf5, on_unit_sphere});
      const Outcome outcome = run(check + folder.file("grid.nc"));
      CHECK_MESSAGE(outcome.status == 0, outcome.output);
      CHECK(outcome.says("MPAS PASS"));
    }
  }
}

TEST_CASE("check_mesh.py accepts UGRID triangles and the spacing with them") {
  const std::string check = checker("check_mesh.py");
  if (check.empty()) return;
  const TemporaryFolder folder;
  for (const Body& body : bodies()) {
    CAPTURE(std::string(body.name));
    const Vec3 radii_m = body.surface.radii() * body.surface.scale_m();
    const Mesh mesh = sample_mesh(body);
    delos::write_ugrid_triangles(folder.file("a.nc"), mesh, {body.surface, LatitudeKind::geodetic},
                                 delos::samples::provenance());
    delos::LatLonField field{90, 180, delos::Array<double>(91 * 180)};
    field.values.assign(field.values.size(), mesh.vertices[0].spacing * body.surface.scale_m());
    delos::write_spacing(folder.file("h.nc"), field, {});
    const bool in_file = std::string(body.name) != "triaxial";
    const std::string radii = in_file ? std::string()
                                      : delos::text(" --radii ", radii_m[0], " ", radii_m[1], " ",
                                                    radii_m[2], " --lat geodetic");
    const Outcome outcome = run(check + folder.file("a.nc") + radii + " --hfun " +
                                folder.file("h.nc") + " --hvar spacing --hlat geodetic");
    CHECK_MESSAGE(outcome.status == 0, outcome.output);
    CHECK(outcome.says("\"valid\": true"));
  }
}

TEST_CASE("CDO takes the grid of both UGRID files and finds the areas in them") {
  if (!has_cdo()) return;
  const TemporaryFolder folder;
  const Ellipsoid sphere = Ellipsoid::sphere(6371000.0);  // CDO's own radius
  const Mesh mesh = delos::samples::bisected_icosahedron(sphere, 3);
  const delos::Grid grid = delos::samples::grid_of(sphere, mesh);
  delos::write_ugrid_triangles(folder.file("triangles.nc"), mesh, {sphere, {}}, {});
  delos::write_ugrid_cells(folder.file("cells.nc"), grid, {});
  for (const char* name : {"triangles.nc", "cells.nc"}) {
    CAPTURE(std::string(name));
    const std::string path = folder.file(name);
    const Outcome description = run("cdo -s griddes " + path);
    CHECK_MESSAGE(description.status == 0, description.output);
    CHECK(description.says("gridtype  = unstructured"));
    CHECK(
        description.says(std::string(name) == "cells.nc" ? "gridsize  = 642" : "gridsize  = 1280"));
    CHECK(description.says("xbounds"));
    // Largest relative difference between the file's areas and those that CDO computes.
    const Outcome compared = run("cdo -s -outputf,%.12g -fldmax -abs -subc,1 -div -selname,area " +
                                 path + " -gridarea -selname,area " + path);
    CHECK_MESSAGE(compared.status == 0, compared.output);
    CHECK_MESSAGE(std::abs(std::atof(compared.output.c_str())) < 1e-9, compared.output);
  }
}

TEST_CASE("CDO takes the grid of a SCRIP file and finds the areas in it") {
  if (!has_cdo()) return;
  const TemporaryFolder folder;
  const double radius_m = 6371000.0;  // CDO's own
  const Ellipsoid sphere = Ellipsoid::sphere(radius_m);
  const delos::Grid grid =
      delos::samples::grid_of(sphere, delos::samples::bisected_icosahedron(sphere, 3));
  const std::string path = folder.file("scrip.nc");
  delos::write_scrip(path, grid, {});
  const Outcome description = run("cdo -s griddes -const,1," + path);
  CHECK_MESSAGE(description.status == 0, description.output);
  CHECK(description.says("gridtype  = unstructured"));
  CHECK(description.says("gridsize  = 642"));
  CHECK(description.says("xbounds"));
  const Outcome areas = run("cdo -s -outputf,%.17g,1 -gridarea -const,1," + path);
  CHECK_MESSAGE(areas.status == 0, areas.output);
  std::istringstream lines(areas.output);
  double worst = 0.0, area_m2 = 0.0;
  std::size_t n = 0;
  for (; lines >> area_m2 && n < grid.cell_area_m2.size(); ++n) {
    worst = std::max(worst, std::abs(area_m2 / grid.cell_area_m2[n] - 1.0));
  }
  CHECK(n == 642);
  CHECK(worst < 1e-9);
}
