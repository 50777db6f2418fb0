// SPDX-License-Identifier: BSD-3-Clause
#include "io/ugrid.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/spacing_file.hpp"
#include "support/expect_error.hpp"
#include "support/file_size_limit.hpp"
#include "support/sample_grids.hpp"
#include "support/temporary_folder.hpp"

using delos::Ellipsoid;
using delos::ErrorKind;
using delos::Grid;
using delos::kPi;
using delos::LatitudeKind;
using delos::LonLat;
using delos::Mesh;
using delos::SpacingField;
using delos::UgridMesh;
using delos::Vec3;
using delos::netcdf::Format;
using delos::netcdf::Reader;
using delos::testing::expect_error;
using delos::testing::TemporaryFolder;

namespace {

const Ellipsoid kTriaxial(Vec3(1.2e6, 1.0e6, 0.8e6), Vec3(0, 0, 0));

bool is_empty(const TemporaryFolder& folder) { return std::filesystem::is_empty(folder.file("")); }

double distance(const LonLat& a, const LonLat& b) {
  return std::hypot(std::remainder(a.lon_rad - b.lon_rad, 2.0 * kPi) * std::cos(a.lat_rad),
                    a.lat_rad - b.lat_rad);
}

/// A file with the least that UGRID asks for: two triangles, corners in `face_nodes`.
void write_foreign(const std::string& path, const std::vector<std::int32_t>& face_nodes,
                   bool transposed, std::int32_t start, const char* units) {
  delos::netcdf::Writer file(path, Format::cdf5);
  const auto nodes = file.define_dimension("n", 4), faces = file.define_dimension("f", 2),
             corners = file.define_dimension("c", 4);
  const auto mesh = file.define_variable("m", delos::netcdf::Type::int32, {});
  file.attribute(mesh, "cf_role", "mesh_topology");
  file.attribute(mesh, "topology_dimension", std::int32_t{2});
  file.attribute(mesh, "node_coordinates", "y x");
  file.attribute(mesh, "face_node_connectivity", "fn");
  file.attribute(mesh, "face_dimension", "f");
  const auto x = file.define_variable("x", delos::netcdf::Type::float64, {nodes});
  const auto y = file.define_variable("y", delos::netcdf::Type::float64, {nodes});
  file.attribute(x, "standard_name", "longitude");
  file.attribute(x, "units", units);
  file.attribute(y, "standard_name", "latitude");
  file.attribute(y, "units", units);
  const auto fn = transposed
                      ? file.define_variable("fn", delos::netcdf::Type::int32, {corners, faces})
                      : file.define_variable("fn", delos::netcdf::Type::int32, {faces, corners});
  file.attribute(fn, "start_index", start);
  file.attribute(fn, "_FillValue", std::int32_t{-999});
  file.end_definitions();
  const double unit = std::string(units) == "radians" ? delos::kRadPerDeg : 1.0;
  const std::vector<double> lon = {0.0, 10.0 * unit, 350.0 * unit, 20.0 * unit};
  const std::vector<double> lat = {0.0, 0.0, 10.0 * unit, 10.0 * unit};
  file.put(x, std::span<const double>(lon));
  file.put(y, std::span<const double>(lat));
  file.put(fn, std::span<const std::int32_t>(face_nodes));
  file.close();
}

}  // namespace

TEST_CASE("a triangulation is read back with its corners, places and body") {
  const TemporaryFolder folder;
  const std::string path = folder.file("triangles.nc");
  for (const Ellipsoid& body :
       {Ellipsoid::sphere(6371220.0), Ellipsoid::wgs84(), Ellipsoid(kTriaxial)}) {
    for (const LatitudeKind latitude : {LatitudeKind::geodetic, LatitudeKind::parametric}) {
      const Mesh mesh = delos::samples::shaken(body, 3, 0.1, 5);
      delos::write_ugrid_triangles(path, mesh, {body, latitude}, delos::samples::provenance());
      const UgridMesh read = delos::read_ugrid(path);
      CHECK(read.topology == "delos_triangles");
      CHECK(read.latitude == latitude);
      REQUIRE(read.ellipsoid);
      CHECK((read.ellipsoid->radii() - body.radii()).norm() < 1e-15);
      CHECK(read.ellipsoid->scale_m() == doctest::Approx(body.scale_m()));
      REQUIRE(read.node.size() == mesh.vertices.size());
      double worst = 0.0, area = 0.0;
      for (std::size_t i = 0; i < read.node.size(); ++i) {
        worst = std::max(
            worst,
            (read.ellipsoid->point(read.node[i], latitude) - mesh.vertices[i].position()).norm());
      }
      CHECK(worst < 1e-14);
      for (delos::Index tri = 0; tri < mesh.n_triangles(); ++tri) {
        const auto row = read.nodes_on_face.row(tri);
        const auto& corners = mesh.triangle(tri).vertex;
        CHECK(std::equal(row.begin(), row.end(), corners.begin(), corners.end()));
        area += read.face_area_m2[static_cast<std::size_t>(tri)];
      }
      CHECK(area == doctest::Approx(body.area() * body.scale_m() * body.scale_m()).epsilon(1e-12));
    }
  }
}

TEST_CASE("cells are read back with their corners, centres and areas, in either format") {
  const TemporaryFolder folder;
  const Ellipsoid body = Ellipsoid::wgs84();
  const Grid grid = delos::samples::grid_of(body, delos::samples::shaken(body, 3, 0.1, 5));
  const std::string path = folder.file("cells.nc");
  for (const Format format : {Format::cdf5, Format::netcdf4}) {
    delos::write_ugrid_cells(path, grid, delos::samples::provenance(), {format, true});
    const UgridMesh read = delos::read_ugrid(path);
    CHECK(read.topology == "delos_cells");
    CHECK(read.nodes_on_face.offsets == grid.vertices_on_cell.offsets);
    CHECK(read.nodes_on_face.values == grid.vertices_on_cell.values);
    CHECK(std::ranges::equal(read.face_area_m2, grid.cell_area_m2));
    double worst = 0.0;
    for (std::size_t i = 0; i < read.node.size(); ++i) {
      worst = std::max(worst, distance(read.node[i], grid.vertex_lon_lat[i]));
    }
    for (std::size_t i = 0; i < read.face_centre.size(); ++i) {
      worst = std::max(worst, distance(read.face_centre[i], grid.cell_lon_lat[i]));
    }
    CHECK(worst < 1e-14);
  }
}

TEST_CASE("connectivity is padded by the fill value and bounds by the last corner") {
  const TemporaryFolder folder;
  const Ellipsoid body = Ellipsoid::sphere(1000.0);
  const Grid grid = delos::samples::grid_of(body, delos::samples::bisected_icosahedron(body, 1));
  delos::write_ugrid_cells(folder.file("cells.nc"), grid, {});
  const Reader file(folder.file("cells.nc"));
  const auto nodes = file.read_int32("delos_cells_face_nodes");
  const auto lat = file.read_double("delos_cells_face_lat_bounds");
  const auto lon = file.read_double("delos_cells_face_lon_bounds");
  const auto centre = file.read_double("delos_cells_face_lon");
  REQUIRE(nodes.size() == 42 * 6);
  int n_padded = 0;
  for (std::size_t cell = 0; cell < 42; ++cell) {
    for (std::size_t k = 0; k < 6; ++k) {
      CHECK(std::abs(lon[6 * cell + k] - centre[cell]) <= 180.0);
      if (nodes[6 * cell + k] != -1) continue;
      ++n_padded;
      CHECK(k == 5);
      CHECK(lat[6 * cell + k] == lat[6 * cell + k - 1]);
      CHECK(lon[6 * cell + k] == lon[6 * cell + k - 1]);
    }
  }
  CHECK(n_padded == 12);
}

TEST_CASE("the first variable is the area, so that CDO finds the grid") {
  const TemporaryFolder folder;
  const Mesh mesh = delos::samples::tetrahedron(Ellipsoid());
  delos::write_ugrid_triangles(folder.file("a.nc"), mesh, {}, {});
  const Reader file(folder.file("a.nc"));
  CHECK(file.variables().front().name == "area");
  CHECK(file.text_attribute("area", "standard_name") == "cell_area");
  CHECK(file.text_attribute("area", "coordinates") ==
        "delos_triangles_face_lon delos_triangles_face_lat");
  CHECK(file.text_attribute("delos_triangles", "node_coordinates") ==
        "delos_triangles_node_lon delos_triangles_node_lat");
  const auto edges = file.read_int32("delos_triangles_edge_nodes");
  CHECK(edges.size() == 2 * 6);
  CHECK(*std::min_element(edges.begin(), edges.end()) == 1);
}

TEST_CASE("without bounds a file is smaller, and its size is announced") {
  const TemporaryFolder folder;
  const Mesh mesh = delos::samples::bisected_icosahedron(Ellipsoid(), 5);
  const SpacingField field = SpacingField::constant(Ellipsoid(), 0.1);
  for (const bool bounds : {true, false}) {
    const delos::UgridOptions options{Format::cdf5, bounds};
    delos::write_ugrid_triangles(folder.file("a.nc"), mesh,
                                 {Ellipsoid(), LatitudeKind::geodetic, &field}, {}, options);
    const double actual = static_cast<double>(std::filesystem::file_size(folder.file("a.nc")));
    CHECK(static_cast<double>(delos::ugrid_triangles_size_bytes(mesh.n_vertices(), options)) ==
          doctest::Approx(actual).epsilon(0.02));
    CHECK(Reader(folder.file("a.nc")).has_variable("delos_triangles_face_lat_bounds") == bounds);
  }
}

TEST_CASE("the spacing at the edges is read back with the edges' nodes") {
  const TemporaryFolder folder;
  const Ellipsoid body = Ellipsoid::wgs84();
  const Mesh mesh = delos::samples::shaken(body, 3, 0.1, 5);
  delos::LatLonField table{18, 36, delos::Array<double>(19 * 36)};
  for (std::size_t i = 0; i < table.values.size(); ++i) {
    table.values[i] = 1e5 + 1e3 * static_cast<double>(i);
  }
  const SpacingField field = SpacingField::table(body, LatitudeKind::geodetic, table);
  const std::string path = folder.file("a.nc");
  delos::write_ugrid_triangles(path, mesh, {body, LatitudeKind::geodetic, &field}, {});
  const UgridMesh triangles = delos::read_ugrid(path);
  REQUIRE(triangles.edge_spacing_m.size() == 3 * mesh.vertices.size() - 6);
  for (std::size_t i = 0; i < triangles.edge_spacing_m.size(); ++i) {
    const auto [a, b] = triangles.nodes_on_edge[i];
    const Vec3 middle = body.project(0.5 * (mesh.position(a) + mesh.position(b)));
    const double wanted_m = body.scale_m() * field.at(middle.x(), middle.y(), middle.z());
    CHECK(triangles.edge_spacing_m[i] == doctest::Approx(wanted_m).epsilon(1e-12));
  }

  Grid grid = delos::samples::grid_of(body, mesh);
  delos::write_ugrid_cells(path, grid, {});
  CHECK(delos::read_ugrid(path).edge_spacing_m.empty());
  for (std::int64_t edge = 0; edge < grid.n_edges(); ++edge) {
    grid.edge_spacing_m.push_back(1e5 + static_cast<double>(edge));
  }
  delos::write_ugrid_cells(path, grid, {});
  const UgridMesh cells = delos::read_ugrid(path);
  CHECK(std::ranges::equal(cells.edge_spacing_m, grid.edge_spacing_m));
  CHECK(std::ranges::equal(cells.nodes_on_edge, grid.vertices_on_edge));
}

TEST_CASE("foreign files are read: either base, padding, radians, connectivity by columns") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.nc");
  const std::vector<std::int32_t> by_rows = {0, 1, 2, -999, 0, 1, 3, 2};
  const std::vector<std::int32_t> by_columns = {1, 1, 2, 2, 3, 4, -999, 3};
  for (const char* units : {"degrees", "radians"}) {
    for (const bool transposed : {false, true}) {
      write_foreign(path, transposed ? by_columns : by_rows, transposed, transposed ? 1 : 0, units);
      const UgridMesh read = delos::read_ugrid(path);
      CHECK(std::ranges::equal(read.nodes_on_face.offsets.positions(),
                               std::vector<std::int64_t>{0, 3, 7}));
      CHECK(read.nodes_on_face.values == delos::Array<delos::Index>{0, 1, 2, 0, 1, 3, 2});
      CHECK(read.node[2].lon_rad == doctest::Approx(-10.0 * delos::kRadPerDeg));
      CHECK(read.node[2].lat_rad == doctest::Approx(10.0 * delos::kRadPerDeg));
      CHECK_FALSE(read.ellipsoid);
    }
  }
  write_foreign(path, {0, 1, 2, -999, 0, 1, 4, 2}, false, 0, "degrees");
  expect_error(ErrorKind::input, {path, "'fn'", "names node 4", "face 1"},
               [&] { delos::read_ugrid(path); });
}

TEST_CASE("a file without a topology is refused") {
  const TemporaryFolder folder;
  delos::netcdf::Writer file(folder.file("a.nc"), Format::cdf5);
  file.define_dimension("n", 4);
  file.end_definitions();
  file.close();
  expect_error(ErrorKind::input, {"a.nc", "cf_role"},
               [&] { delos::read_ugrid(folder.file("a.nc")); });
}

TEST_CASE("the spacing is written as a CF lat-lon variable in metres") {
  const TemporaryFolder folder;
  delos::LatLonField field{4, 8, delos::Array<double>(40)};
  for (std::size_t i = 0; i < field.values.size(); ++i) field.values[i] = 1000.0 + double(i);
  for (const Format format : {Format::cdf5, Format::netcdf4}) {
    delos::write_spacing(folder.file("h.nc"), field, delos::samples::provenance(), format);
    const Reader file(folder.file("h.nc"));
    CHECK(file.variable("spacing").shape_text() == "spacing(5, 8)");
    CHECK(file.text_attribute("spacing", "units") == "m");
    const std::vector<double> read = file.read_double("spacing");
    CHECK(std::equal(read.begin(), read.end(), field.values.begin(), field.values.end()));
    CHECK(file.read_double("lat") == std::vector<double>{-90, -45, 0, 45, 90});
    CHECK(file.read_double("lon").front() == -180.0);
    CHECK(file.read_double("lon").back() == 135.0);
  }
}

TEST_CASE("a disk that fills up while a UGRID file or the spacing is written leaves nothing") {
  const TemporaryFolder folder;
  const Mesh mesh = delos::samples::bisected_icosahedron(Ellipsoid(), 4);
  const delos::LatLonField field{100, 200, delos::Array<double>(101 * 200, 1000.0)};
  const std::string path = folder.file("a.nc");
  for (const rlim_t n_bytes : {100, 50000}) {
    CAPTURE(n_bytes);
    const delos::testing::FileSizeLimit limit(n_bytes);
    expect_error(ErrorKind::output, {path},
                 [&] { delos::write_ugrid_triangles(path, mesh, {}, {}); });
    expect_error(ErrorKind::output, {path}, [&] { delos::write_spacing(path, field, {}); });
    CHECK(is_empty(folder));
  }
}
