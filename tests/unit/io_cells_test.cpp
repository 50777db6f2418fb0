// SPDX-License-Identifier: BSD-3-Clause
// SCRIP, ESMF mesh and VTU: what is written is read back.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/esmf_mesh.hpp"
#include "io/file_text.hpp"
#include "io/scrip.hpp"
#include "io/vtu.hpp"
#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"
#include "support/temporary_folder.hpp"

using delos::Ellipsoid;
using delos::ErrorKind;
using delos::FaceMesh;
using delos::Grid;
using delos::Index;
using delos::LonLat;
using delos::Vec3;
using delos::netcdf::Format;
using delos::testing::expect_error;
using delos::testing::TemporaryFolder;

namespace {

constexpr double kRounding = 1e-14;

std::array<Ellipsoid, 3> bodies() {
  return {Ellipsoid::sphere(6371220.0), Ellipsoid::wgs84(),
          Ellipsoid(Vec3(1.2e6, 1.0e6, 0.8e6), Vec3(0, 0, 0))};
}

Grid sample(const Ellipsoid& body) {
  return delos::samples::grid_of(body, delos::samples::shaken(body, 3, 0.1, 5));
}

/// Largest distance between the corners of the cells, between their centres, and of areas.
double difference(const Grid& grid, const FaceMesh& read) {
  REQUIRE(read.ellipsoid);
  REQUIRE(read.latitude == grid.latitude);
  REQUIRE(read.nodes_on_face.offsets == grid.vertices_on_cell.offsets);
  REQUIRE(read.face_centre.size() == grid.cell_position.size());
  const auto off = [&](const LonLat& place, const Vec3& p) {
    return (read.ellipsoid->point(place, read.latitude) - p).norm();
  };
  double worst = 0.0;
  for (std::int64_t cell = 0; cell < grid.n_cells(); ++cell) {
    const auto i = static_cast<std::size_t>(cell);
    worst = std::max(worst, off(read.face_centre[i], grid.cell_position[i]));
    worst = std::max(worst, std::abs(read.face_area_m2[i] / grid.cell_area_m2[i] - 1.0));
    const auto own = grid.vertices_on_cell.row(cell), other = read.nodes_on_face.row(cell);
    for (std::size_t k = 0; k < own.size(); ++k) {
      worst = std::max(worst, off(read.node[static_cast<std::size_t>(other[k])],
                                  grid.vertex_position[static_cast<std::size_t>(own[k])]));
    }
  }
  return worst;
}

void write_text(const std::string& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

}  // namespace

TEST_CASE("SCRIP cells are read back, and corners that cells share are one node") {
  const TemporaryFolder folder;
  const std::string path = folder.file("scrip.nc");
  for (const Ellipsoid& body : bodies()) {
    const Grid grid = sample(body);
    for (const Format format : {Format::cdf5, Format::netcdf4}) {
      delos::write_scrip(path, grid, delos::samples::provenance(), {format});
      const FaceMesh read = delos::read_scrip(path);
      CHECK(read.node.size() == grid.vertex_position.size());
      CHECK(difference(grid, read) < kRounding);
    }
  }
}

TEST_CASE("ESMF elements are read back, ids and all") {
  const TemporaryFolder folder;
  const std::string path = folder.file("esmf.nc");
  for (const Ellipsoid& body : bodies()) {
    const Grid grid = sample(body);
    delos::write_esmf_mesh(path, grid, delos::samples::provenance());
    const FaceMesh read = delos::read_esmf_mesh(path);
    CHECK(read.nodes_on_face.values == grid.vertices_on_cell.values);
    CHECK(difference(grid, read) < kRounding);
  }
}

TEST_CASE("VTU polygons are read back, ids and all") {
  const TemporaryFolder folder;
  const std::string path = folder.file("cells.vtu");
  for (const Ellipsoid& body : bodies()) {
    const Grid grid = sample(body);
    delos::write_vtu_cells(path, grid);
    const delos::VtuMesh read = delos::read_vtu(path);
    CHECK(read.nodes_on_face.values == grid.vertices_on_cell.values);
    CHECK(read.nodes_on_face.offsets == grid.vertices_on_cell.offsets);
    CHECK(read.cell_spacing_m.size() == grid.cell_spacing_m.size());
    REQUIRE(read.centre.size() == grid.cell_position.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < read.centre.size(); ++i) {
      worst = std::max(worst, (read.centre[i] - grid.cell_position[i]).norm());
    }
    for (std::size_t i = 0; i < read.points.position.size(); ++i) {
      worst = std::max(worst, (read.points.position[i] - grid.vertex_position[i]).norm());
    }
    CHECK(worst < kRounding);
  }
}

TEST_CASE("VTU triangles with a border are read back with their data") {
  const TemporaryFolder folder;
  const std::string path = folder.file("triangles.vtu");
  const Ellipsoid body = Ellipsoid::wgs84();
  delos::TriangleSet set = delos::triangle_set(body, delos::LatitudeKind::geodetic,
                                               delos::samples::shaken(body, 2, 0.1, 5));
  CHECK(delos::is_closed(set));
  set.corners.resize(set.corners.size() / 2);
  CHECK(!delos::is_closed(set));
  set.depth_m.assign(set.position.size(), 4000.125);
  delos::write_vtu_triangles(path, set);
  const delos::VtuMesh read = delos::read_vtu(path);
  CHECK(read.points.corners == set.corners);
  CHECK(read.points.depth_m == set.depth_m);
  for (std::size_t i = 0; i < set.position.size(); ++i) {
    CHECK((read.points.position[i] - set.position[i]).norm() < kRounding);
  }
}

TEST_CASE("VTU in ASCII is read; what can't be read is refused with its reason") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.vtu");
  const std::string head =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\">\n"
      "<UnstructuredGrid><Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">\n";
  const std::string points =
      "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n"
      "2 0 0 0 2 0\n0 0 2</DataArray></Points>\n";
  const auto cells = [](const std::string& nodes) {
    return "<Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">" + nodes +
           "</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" "
           "format=\"ascii\">3</DataArray>\n"
           "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5</DataArray></Cells>\n";
  };
  const std::string tail = "</Piece></UnstructuredGrid></VTKFile>\n";
  write_text(path, head + points + cells("0 1 2") + tail);
  const delos::VtuMesh read = delos::read_vtu(path);
  REQUIRE(read.points.surface);
  CHECK(read.points.surface->scale_m() == 2.0);
  CHECK(read.points.corners.size() == 1);

  const auto refused = [&](const std::string& content, const char* reason) {
    write_text(path, content);
    expect_error(ErrorKind::input, {path, reason}, [&] { delos::read_vtu(path); });
  };
  refused(head + points + cells("0 1 x") + tail, "no number");
  refused(head + points + cells("0 1 3") + tail, "names point 3");
  refused(head + points, "cut off");
  refused(head + cells("0 1 2") + tail, "no array Points");
  refused("<VTKFile type=\"PolyData\"></VTKFile>", "UnstructuredGrid");
  refused("<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkZLibDataCompressor\"></VTKFile>",
          "compressor");
  refused("no XML at all", "cut off");
}

TEST_CASE("a VTU file cut off anywhere is refused") {
  const TemporaryFolder folder;
  const std::string path = folder.file("cells.vtu"), part = folder.file("part.vtu");
  const Ellipsoid body = Ellipsoid::sphere(1.0);
  delos::write_vtu_cells(
      path, delos::samples::grid_of(body, delos::samples::bisected_icosahedron(body, 0)));
  const std::string whole = delos::read_file_bytes(path);
  const std::size_t data_end = whole.rfind("\n</AppendedData>");
  for (std::size_t n = 0; n < data_end; n += 7) {
    write_text(part, whole.substr(0, n));
    CHECK_THROWS_AS(delos::read_vtu(part), delos::Error);
  }
}

TEST_CASE("SCRIP and ESMF files with what can't be are refused by name") {
  const TemporaryFolder folder;
  const std::string path = folder.file("bad.nc");
  {
    delos::netcdf::Writer file(path, Format::cdf5);
    const auto n = file.define_dimension("grid_size", 1), m = file.define_dimension("c", 3);
    const auto place = [&](const char* name, auto shape) {
      const auto id = file.define_variable(name, delos::netcdf::Type::float64, shape);
      file.attribute(id, "units", "degrees");
      return id;
    };
    using Shape = std::initializer_list<delos::netcdf::DimensionId>;
    const auto lat = place("grid_center_lat", Shape{n}), lon = place("grid_center_lon", Shape{n});
    const auto lats = place("grid_corner_lat", Shape{n, m});
    const auto lons = place("grid_corner_lon", Shape{n, m});
    file.end_definitions();
    const std::vector<double> one = {1.0}, three = {1.0, 2.0, 2.0};
    file.put(lat, std::span<const double>(one));
    file.put(lon, std::span<const double>(one));
    file.put(lats, std::span<const double>(three));
    file.put(lons, std::span<const double>(three));
    file.close();
  }
  expect_error(ErrorKind::input, {path, "cell 1", "2 different corners"},
               [&] { delos::read_scrip(path); });
  expect_error(ErrorKind::input, {path, "nodeCoords"}, [&] { delos::read_esmf_mesh(path); });
}
