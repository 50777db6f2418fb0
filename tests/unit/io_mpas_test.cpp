// SPDX-License-Identifier: BSD-3-Clause
#include "io/graph_file.hpp"
#include "io/mpas.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "dual/edge_angles.hpp"
#include "dual/validate.hpp"
#include "io/part_file.hpp"
#include "io/ugrid.hpp"
#include "support/expect_error.hpp"
#include "support/file_size_limit.hpp"
#include "support/sample_grids.hpp"
#include "support/temporary_folder.hpp"

using delos::ErrorKind;
using delos::Grid;
using delos::kNone;
using delos::MpasOptions;
using delos::Vec3;
using delos::netcdf::Format;
using delos::netcdf::Reader;
using delos::testing::expect_error;
using delos::testing::TemporaryFolder;

namespace {

const delos::Ellipsoid kEarth = delos::Ellipsoid::sphere(6371220.0);

Grid sample_grid() {
  return delos::samples::grid_of(kEarth, delos::samples::shaken(kEarth, 3, 0.08, 7));
}

std::size_t n_entries(const TemporaryFolder& folder) {
  const std::filesystem::directory_iterator entries(folder.file(""));
  return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

void check_same_tables(const Grid& a, const Grid& b) {
  const auto same = [](const auto& x, const auto& y) {
    CHECK(x.offsets == y.offsets);
    CHECK(x.values == y.values);
  };
  same(a.edges_on_cell, b.edges_on_cell);
  same(a.vertices_on_cell, b.vertices_on_cell);
  same(a.cells_on_cell, b.cells_on_cell);
  same(a.edges_on_edge, b.edges_on_edge);
  CHECK(a.cells_on_edge == b.cells_on_edge);
  CHECK(a.vertices_on_edge == b.vertices_on_edge);
  CHECK(a.cells_on_vertex == b.cells_on_vertex);
  CHECK(a.edges_on_vertex == b.edges_on_vertex);
  same(a.weights_on_edge, b.weights_on_edge);
}

void check_same_places(std::span<const Vec3> a, std::span<const Vec3> b) {
  REQUIRE(a.size() == b.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, (a[i] - b[i]).norm());
  CHECK(worst < 4e-16);
}

/// Changes one number of a netCDF variable in place.
void corrupt(const std::string& path, const std::string& variable, std::int32_t value) {
  const std::string before = path + ".before";
  std::filesystem::rename(path, before);
  const Reader source(before);
  delos::netcdf::Writer copy(path, Format::cdf5);
  std::vector<delos::netcdf::DimensionId> dimensions;
  std::vector<delos::netcdf::VariableId> ids;
  for (const auto& d : source.dimensions()) {
    dimensions.push_back(copy.define_dimension(d.name, d.unlimited ? 0 : d.length));
  }
  for (const auto& v : source.variables()) {
    std::vector<delos::netcdf::DimensionId> shape;
    for (const auto& of : v.dimensions) {
      for (std::size_t d = 0; d < dimensions.size(); ++d) {
        if (source.dimensions()[d].name == of.name) shape.push_back(dimensions[d]);
      }
    }
    ids.push_back(copy.define_variable(v.name, v.type, shape));
  }
  copy.attribute(delos::netcdf::kGlobal, "on_a_sphere", "YES");
  copy.attribute(delos::netcdf::kGlobal, "sphere_radius", 1.0);
  copy.end_definitions();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto& v = source.variables()[i];
    if (v.type == delos::netcdf::Type::int32) {
      auto values = source.read_int32(v.name);
      if (v.name == variable) values[3] = value;
      copy.put(ids[i], std::span<const std::int32_t>(values));
    } else {
      const auto values = source.read_double(v.name);
      copy.put(ids[i], std::span<const double>(values));
    }
  }
  copy.close();
}

}  // namespace

TEST_CASE("an MPAS file is read back with the same tables and numbers, in either format") {
  const TemporaryFolder folder;
  Grid grid = sample_grid();
  for (std::int64_t edge = 0; edge < grid.n_edges(); ++edge) {
    grid.edge_spacing_m.push_back(1e5 + static_cast<double>(edge));
  }
  for (const Format format : {Format::cdf5, Format::netcdf4}) {
    const std::string path = folder.file("grid.nc");
    delos::write_mpas(path, grid, delos::samples::provenance(), {format, false});
    const Grid read = delos::read_mpas(path);
    CHECK(read.surface.is_sphere());
    CHECK(read.surface.scale_m() == 6371220.0);
    check_same_tables(read, grid);
    check_same_places(read.cell_position, grid.cell_position);
    check_same_places(read.edge_position, grid.edge_position);
    check_same_places(read.vertex_position, grid.vertex_position);
    CHECK(read.cell_area_m2 == grid.cell_area_m2);
    CHECK(read.triangle_area_m2 == grid.triangle_area_m2);
    CHECK(read.kite_area_m2 == grid.kite_area_m2);
    CHECK(read.cell_distance_m == grid.cell_distance_m);
    CHECK(read.vertex_distance_m == grid.vertex_distance_m);
    CHECK(read.edge_angle_rad == grid.edge_angle_rad);
    CHECK(read.cell_spacing_m == grid.cell_spacing_m);
    CHECK(read.edge_spacing_m == grid.edge_spacing_m);
    CHECK(read.vertex_lon_lat.back().lon_rad == grid.vertex_lon_lat.back().lon_rad);
    CHECK(n_entries(folder) == 1);
  }
}

TEST_CASE("the file holds every variable and attribute of the MPAS mesh specification") {
  const TemporaryFolder folder;
  const Grid grid = sample_grid();
  delos::write_mpas(folder.file("grid.nc"), grid, delos::samples::provenance());
  const Reader file(folder.file("grid.nc"));
  for (const char* name :
       {"latCell",        "lonCell",         "xCell",           "yCell",
        "zCell",          "indexToCellID",   "latEdge",         "lonEdge",
        "xEdge",          "yEdge",           "zEdge",           "indexToEdgeID",
        "latVertex",      "lonVertex",       "xVertex",         "yVertex",
        "zVertex",        "indexToVertexID", "cellsOnCell",     "edgesOnCell",
        "verticesOnCell", "nEdgesOnCell",    "edgesOnEdge",     "cellsOnEdge",
        "verticesOnEdge", "nEdgesOnEdge",    "cellsOnVertex",   "edgesOnVertex",
        "boundaryVertex", "areaCell",        "angleEdge",       "dcEdge",
        "dvEdge",         "weightsOnEdge",   "areaTriangle",    "kiteAreasOnVertex",
        "cellQuality",    "gridSpacing",     "triangleQuality", "triangleAngleQuality",
        "obtuseTriangle", "meshDensity"}) {
    CAPTURE(name);
    CHECK(file.has_variable(name));
  }
  CHECK(file.dimension("nCells").length == static_cast<std::size_t>(grid.n_cells()));
  CHECK(file.dimension("maxEdges2").length == 2 * file.dimension("maxEdges").length);
  CHECK(file.dimension("TWO").length == 2);
  CHECK(file.dimension("vertexDegree").length == 3);
  CHECK(file.dimension("Time").unlimited);
  CHECK(file.dimension("Time").length == 0);
  CHECK(file.text_attribute("", "on_a_sphere") == "YES");
  CHECK(file.text_attribute("", "is_periodic") == "NO");
  CHECK(file.text_attribute("", "mesh_spec") == "1.0");
  CHECK(file.text_attribute("", "Conventions") == "MPAS");
  CHECK(file.text_attribute("", "file_id") == delos::file_id(std::string(64, 'a')));
  CHECK_FALSE(file.text_attribute("", "parent_id"));
  CHECK(file.text_attribute("", "delos_config") == delos::samples::provenance().config);
  std::size_t most = 0;
  for (std::int64_t cell = 0; cell < grid.n_cells(); ++cell) {
    most = std::max(most, grid.edges_on_cell.row(cell).size());
  }
  CHECK(file.dimension("maxEdges").length == most);  // swe-python breaks on any more
}

TEST_CASE("ids count from 1 and lists are padded with 0") {
  const TemporaryFolder folder;
  const Grid grid = sample_grid();
  delos::write_mpas(folder.file("grid.nc"), grid, {});
  const Reader file(folder.file("grid.nc"));
  const auto count = file.read_int32("nEdgesOnCell");
  const auto cells = file.read_int32("cellsOnCell");
  const std::size_t width = file.dimension("maxEdges").length;
  for (std::size_t cell = 0; cell < count.size(); ++cell) {
    for (std::size_t j = 0; j < width; ++j) {
      const bool padding = j >= static_cast<std::size_t>(count[cell]);
      CHECK((cells[cell * width + j] == 0) == padding);
    }
  }
  CHECK(file.read_int32("indexToEdgeID").front() == 1);
  CHECK(file.read_int32("indexToEdgeID").back() == grid.n_edges());
}

TEST_CASE("a file on the unit sphere holds the same grid in units of the radius") {
  const TemporaryFolder folder;
  const Grid grid = sample_grid();
  delos::write_mpas(folder.file("grid.nc"), grid, {}, {Format::cdf5, true});
  const Grid read = delos::read_mpas(folder.file("grid.nc"));
  CHECK(read.surface.scale_m() == 1.0);
  CHECK(read.cell_position == grid.cell_position);
  double area = 0.0;
  for (const double part : read.cell_area_m2) area += part;
  CHECK(area == doctest::Approx(4.0 * delos::kPi).epsilon(1e-13));
  CHECK(read.cell_distance_m[5] * 6371220.0 == doctest::Approx(grid.cell_distance_m[5]));
  CHECK(read.cell_spacing_m[5] * 6371220.0 == doctest::Approx(grid.cell_spacing_m[5]));
}

TEST_CASE("the mesh density is 1 where the spacing is finest and falls with its fourth power") {
  const TemporaryFolder folder;
  Grid grid = sample_grid();
  for (std::size_t i = 0; i < grid.cell_spacing_m.size(); ++i) {
    grid.cell_spacing_m[i] = i % 2 == 0 ? 1000.0 : 2000.0;
  }
  delos::write_mpas(folder.file("grid.nc"), grid, {});
  const auto density = Reader(folder.file("grid.nc")).read_double("meshDensity");
  CHECK(density[0] == 1.0);
  CHECK(density[1] == 0.0625);
}

TEST_CASE("a derived file names its parents") {
  const TemporaryFolder folder;
  const Grid grid = sample_grid();
  delos::Provenance provenance = delos::samples::provenance();
  delos::write_mpas(folder.file("a.nc"), grid, provenance);
  const std::string first = delos::mpas_parent_id(folder.file("a.nc"));
  CHECK(first == delos::file_id(provenance.digest));
  provenance.parent_id = first;
  provenance.digest = std::string(64, 'd');
  delos::write_mpas(folder.file("b.nc"), grid, provenance);
  CHECK(Reader(folder.file("b.nc")).text_attribute("", "parent_id") == first);
  CHECK(delos::mpas_parent_id(folder.file("b.nc")) ==
        delos::file_id(provenance.digest) + "\n" + first);
}

TEST_CASE("files of several blocks have the same bytes from any number of threads") {
  const TemporaryFolder folder;
  const delos::Mesh mesh = delos::samples::bisected_icosahedron(delos::Ellipsoid(), 6);
  const Grid grid = delos::samples::grid_of(delos::Ellipsoid(), mesh);
  const delos::SpacingField spacing = delos::SpacingField::constant(delos::Ellipsoid(), 100e3);
  const auto written = [&](delos::parallel::Executor* exec) {
    delos::write_mpas(folder.file("a.nc"), grid, {}, {Format::cdf5, false, exec});
    delos::write_ugrid_cells(folder.file("b.nc"), grid, {}, {Format::cdf5, true, exec});
    delos::write_ugrid_triangles(folder.file("c.nc"), mesh, {delos::Ellipsoid(), {}, &spacing}, {},
                                 {Format::cdf5, true, exec});
    std::string digests;
    for (const char* name : {"a.nc", "b.nc", "c.nc"}) {
      digests += delos::describe_input(folder.file(name)).sha256;
    }
    return digests;
  };
  const std::string alone = written(nullptr);
  for (const int threads : {2, 5}) {
    delos::parallel::Executor exec(threads);
    CHECK(written(&exec) == alone);
  }
}

TEST_CASE("the same grid gives the same bytes") {
  const TemporaryFolder folder;
  const Grid grid = sample_grid();
  for (const char* name : {"a.nc", "b.nc"}) {
    delos::write_mpas(folder.file(name), grid, delos::samples::provenance());
  }
  CHECK(delos::describe_input(folder.file("a.nc")).sha256 ==
        delos::describe_input(folder.file("b.nc")).sha256);
}

TEST_CASE("the announced size of an MPAS file is that of the file within 10 %") {
  const TemporaryFolder folder;
  const Grid grid = delos::samples::grid_of(kEarth, delos::samples::shaken(kEarth, 4, 0.2, 3));
  delos::write_mpas(folder.file("grid.nc"), grid, {});
  REQUIRE(Reader(folder.file("grid.nc")).dimension("maxEdges").length == 7);
  const double actual = static_cast<double>(std::filesystem::file_size(folder.file("grid.nc")));
  CHECK(static_cast<double>(delos::mpas_size_bytes(grid.n_cells())) ==
        doctest::Approx(actual).epsilon(0.1));
}

TEST_CASE("the layers of an ocean stand in the file, in metres on a unit sphere too") {
  const TemporaryFolder folder;
  const Grid grid = sample_grid();
  const std::string path = folder.file("grid.nc");
  const std::vector<double> interface_m{0.0, 10.0, 30.0, 60.0};
  std::vector<delos::Index> n_layers;
  std::vector<double> bottom_m;
  for (delos::Index i = 0; i < grid.n_cells(); ++i) {
    n_layers.push_back(i % 4);
    bottom_m.push_back(i % 4 == 0 ? 0.0 : interface_m[static_cast<std::size_t>(i % 4)] - 1.0);
  }
  const delos::MpasOceanLayers layers{interface_m, n_layers, bottom_m,
                                      [](std::int64_t cell, std::int64_t level) {
                                        return static_cast<double>(100 * cell + level);
                                      }};
  for (const Format format : {Format::cdf5, Format::netcdf4}) {
    MpasOptions options{format, true};
    options.ocean = &layers;
    delos::write_mpas(path, grid, {}, options);
    const Reader file(path);
    CHECK(file.dimension("nVertLevels").length == 3);
    CHECK(file.dimension("nVertLevelsP1").length == 4);
    CHECK(file.dimension("Time").length == 1);
    CHECK(file.read_double("refBottomDepth") == std::vector<double>{10.0, 30.0, 60.0});
    CHECK(file.read_double("refZMid") == std::vector<double>{-5.0, -20.0, -45.0});
    CHECK(file.read_double("refInterfaces") == interface_m);
    CHECK(file.read_double("vertCoordMovementWeights") == std::vector<double>(3, 1.0));
    CHECK(file.read_double("bottomDepth") == bottom_m);
    CHECK(file.text_attribute("bottomDepth", "units") == "m");
    CHECK(file.text_attribute("maxLevelCell", "units") == "1");
    CHECK(delos::read_mpas_layers(path) == n_layers);
    const auto n = static_cast<std::size_t>(grid.n_cells());
    CHECK(file.variable("layerThickness").shape_text() ==
          delos::text("layerThickness(1, ", n, ", 3)"));
    for (const char* name : {"restingThickness", "layerThickness"}) {
      const std::vector<double> thickness = file.read_double(name);
      REQUIRE(thickness.size() == 3 * n);
      for (std::size_t k = 0; k < thickness.size(); ++k) {
        CHECK(thickness[k] == static_cast<double>(100 * (k / 3) + k % 3));
      }
    }
    // The mesh beside them is read as before.
    check_same_tables(delos::read_mpas(path), grid);
  }
  CHECK(delos::mpas_size_bytes(1000, 60) - delos::mpas_size_bytes(1000) == 2 * 8 * 60 * 1000);
  delos::write_mpas(path, grid, {});
  CHECK(delos::read_mpas_layers(path).empty());
  CHECK_FALSE(Reader(path).has_dimension("nVertLevels"));
}

TEST_CASE("the interfaces over land stand in the file") {
  const TemporaryFolder folder;
  const Grid grid = sample_grid();
  const std::vector<double> ground_m(static_cast<std::size_t>(grid.n_cells()), 500.0);
  const delos::MpasTerrainLayers layers{2, ground_m, [](std::int64_t cell, std::int64_t k) {
                                          return static_cast<double>(10 * cell + k);
                                        }};
  MpasOptions options;
  options.terrain = &layers;
  delos::write_mpas(folder.file("grid.nc"), grid, {}, options);
  const Reader file(folder.file("grid.nc"));
  CHECK(file.read_double("ter") == ground_m);
  const std::vector<double> height_m = file.read_double("zgrid");
  REQUIRE(height_m.size() == 3 * ground_m.size());
  for (std::size_t k = 0; k < height_m.size(); ++k) {
    CHECK(height_m[k] == static_cast<double>(10 * (k / 3) + k % 3));
  }
  CHECK(file.text_attribute("zgrid", "units") == "m");
}

TEST_CASE("graph.info lists the neighbours of each cell from 1, as METIS reads them") {
  const TemporaryFolder folder;
  const Grid grid = sample_grid();
  delos::write_graph_info(folder.file("graph.info"), grid);
  std::ifstream file(folder.file("graph.info"));
  std::string line;
  std::getline(file, line);
  CHECK(line == delos::text(grid.n_cells(), " ", grid.n_edges()));
  std::int64_t cell = 0;
  for (; std::getline(file, line); ++cell) {
    std::istringstream ids(line);
    std::vector<delos::Index> listed;
    for (delos::Index id = 0; ids >> id;) listed.push_back(id - 1);
    const auto expected = grid.cells_on_cell.row(cell);
    CHECK(std::equal(listed.begin(), listed.end(), expected.begin(), expected.end()));
  }
  CHECK(cell == grid.n_cells());
}

TEST_CASE("a part file has the part of each cell on its line, from 0") {
  const TemporaryFolder folder;
  const std::string path = folder.file(delos::part_file_ending(11));
  CHECK(std::filesystem::path(path).filename() == "graph.info.part.11");
  delos::write_parts(path, std::vector<delos::Index>{3, 10, 0, 10});
  std::ifstream file(path);
  CHECK(std::string(std::istreambuf_iterator<char>(file), {}) == "3\n10\n0\n10\n");
  expect_error(ErrorKind::output, {"there is no folder"},
               [&] { delos::write_parts(folder.file("no/part.2"), std::vector<delos::Index>{0}); });
}

TEST_CASE("a grid on an ellipsoid is refused and nothing is written") {
  const TemporaryFolder folder;
  const delos::Ellipsoid earth = delos::Ellipsoid::wgs84();
  const Grid grid = delos::samples::grid_of(earth, delos::samples::bisected_icosahedron(earth, 1));
  expect_error(ErrorKind::output, {"grid.nc", "spheres only", "Map it to the sphere"},
               [&] { delos::write_mpas(folder.file("grid.nc"), grid, {}); });
  CHECK(n_entries(folder) == 0);
}

TEST_CASE("a disk that fills up on the way leaves nothing behind") {
  const TemporaryFolder folder;
  const Grid grid = sample_grid();
  for (const rlim_t n_bytes : {100, 20000, 300000}) {
    CAPTURE(n_bytes);
    const delos::testing::FileSizeLimit limit(n_bytes);
    expect_error(ErrorKind::output, {folder.file("grid.nc")},
                 [&] { delos::write_mpas(folder.file("grid.nc"), grid, {}); });
    CHECK(n_entries(folder) == 0);
  }
  const delos::testing::FileSizeLimit limit(100);
  expect_error(ErrorKind::output, {folder.file("graph.info"), "Free some space"},
               [&] { delos::write_graph_info(folder.file("graph.info"), grid); });
  CHECK(n_entries(folder) == 0);
}

TEST_CASE("tables that name what is not there are refused with variable and row") {
  const TemporaryFolder folder;
  const Grid grid = sample_grid();
  const std::string path = folder.file("grid.nc");
  for (const char* variable : {"cellsOnEdge", "verticesOnCell", "edgesOnEdge"}) {
    for (const std::int32_t value : {-1, 1000000}) {
      delos::write_mpas(path, grid, {}, {Format::cdf5, true});
      corrupt(path, variable, value);
      expect_error(ErrorKind::input, {path, variable, delos::text(value), "row"},
                   [&] { delos::read_mpas(path); });
    }
  }
  delos::write_mpas(path, grid, {}, {Format::cdf5, true});
  corrupt(path, "nEdgesOnCell", 99);
  expect_error(ErrorKind::input, {"nEdgesOnCell", "99"}, [&] { delos::read_mpas(path); });
}

TEST_CASE("a file that is no MPAS mesh on a sphere is refused") {
  const TemporaryFolder folder;
  delos::netcdf::Writer file(folder.file("a.nc"), Format::cdf5);
  file.attribute(delos::netcdf::kGlobal, "on_a_sphere", "NO");
  file.end_definitions();
  file.close();
  expect_error(ErrorKind::input, {"a.nc", "on_a_sphere is NO"},
               [&] { delos::read_mpas(folder.file("a.nc")); });
}

TEST_CASE("a published mesh is read, and its diagnostics are what this writer makes of it") {
  const char* data = std::getenv("DELOS_TEST_DATA");
  if (data == nullptr) {
    MESSAGE("skipped: DELOS_TEST_DATA names no folder with published meshes");
    return;
  }
  const std::string path = std::string(data) + "/meshes/mpas_QU1920km.nc";
  const Grid grid = delos::read_mpas(path);
  CHECK(grid.n_cells() == 162);
  CHECK(grid.n_edges() == 480);
  CHECK(grid.n_vertices() == 320);
  // Sound but for angles of another definition.
  delos::parallel::Executor exec(1);
  delos::Monitor monitor;
  delos::Context context{exec, monitor};
  const auto broken = delos::check_grid(context, grid, 1e-6);
  REQUIRE(broken.size() == 1);
  CHECK(broken[0].rule == delos::kEdgeAngleRule);
  const auto by_latitude = delos::angles_by_latitude(context, grid, 1e-14);
  REQUIRE(by_latitude);
  CHECK(by_latitude->worst_rad == doctest::Approx(0.0231759).epsilon(1e-5));
  const TemporaryFolder folder;
  delos::write_mpas(folder.file("again.nc"), grid, {});
  check_same_tables(delos::read_mpas(folder.file("again.nc")), grid);
  const Reader published(path), again(folder.file("again.nc"));
  for (const char* name :
       {"cellQuality", "gridSpacing", "triangleQuality", "obtuseTriangle", "boundaryVertex"}) {
    CAPTURE(name);
    const auto a = published.read_double(name), b = again.read_double(name);
    REQUIRE(a.size() == b.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    CHECK(worst < 1e-5);
  }
}
