// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/convert.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "domain/cull.hpp"
#include "dual/validate.hpp"
#include "io/fesom.hpp"
#include "io/mpas.hpp"
#include "io/mpas_layers.hpp"
#include "io/vtu.hpp"
#include "lifecycle/generate.hpp"
#include "lifecycle/grid_file.hpp"
#include "lifecycle/outputs.hpp"
#include "lifecycle/settings_tree.hpp"
#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using delos::testing::expect_error;
using delos::testing::TemporaryFolder;

namespace {

struct Host {
  parallel::Executor exec{2};
  Monitor monitor;
  Context context{exec, monitor};

  void write(const std::string& layers, const std::string& folder) {
    const std::string yaml =
        "sizing: {sources: [{type: constant, spacing: 2500 km}]}\n"
        "refine: {tile_vertices: 500}\n"
        "output: {name: a, formats: [mpas, fesom]}\n" +
        layers;
    const Product product =
        generate(context, read_settings(parse_config(yaml, "test.yaml"), "."), {});
    write_outputs(context, output_content(product, "test"), folder);
  }
  std::vector<std::string> convert(const std::string& from, const std::string& to,
                                   const std::string& kind = "") {
    return convert_grid_file(context, {from, to, file_kind_of(to, kind), "test"});
  }
  GridFile read(const std::string& path) { return read_grid_file(context, path); }
};

void check_same(const MpasVertical& one, const MpasVertical& other) {
  CHECK(one.interface_m == other.interface_m);
  CHECK(one.n_layers == other.n_layers);
  CHECK(one.bottom_depth_m == other.bottom_depth_m);
  CHECK(one.thickness_m == other.thickness_m);
  CHECK(one.ground_m == other.ground_m);
  CHECK(one.height_m == other.height_m);
}

/// A region with an island, rings and a spacing, and one cell that hangs on by an edge.
Grid region_of(const Ellipsoid& surface) {
  const Grid whole = samples::grid_of(surface, samples::shaken(surface, 3, 0.05, 5));
  std::vector<Index> cells;
  for (Index cell = 0; cell < whole.n_cells(); ++cell) {
    const Vec3 p = whole.cell_position[at(cell)].normalized();
    if (p.x() > -0.2 && (p - Vec3(0.8, 0.6, 0.0)).norm() > 0.25) cells.push_back(cell);
  }
  parallel::Executor exec(1);
  Grid grid = domain::cull(exec, whole, cells).grid;
  for (std::size_t cell = 0; cell < grid.cell_position.size(); ++cell) {
    grid.cell_ring.push_back(
        std::max(0, static_cast<int>(4.0 - 10.0 * grid.cell_position[cell].x())));
    grid.cell_spacing_m[cell] = 1000.0 + static_cast<double>(cell);
  }
  for (std::size_t edge = 0; edge < grid.cells_on_edge.size(); ++edge) {
    grid.edge_spacing_m.push_back(2000.0 + static_cast<double>(edge));
  }
  return grid;
}

double worst_distance(const Array<Vec3>& one, const Array<Vec3>& other) {
  REQUIRE(one.size() == other.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) worst = std::max(worst, (one[i] - other[i]).norm());
  return worst;
}

void check_same_cells(const Grid& made, const Grid& grid) {
  CHECK(made.cells_on_edge == grid.cells_on_edge);
  CHECK(made.vertices_on_edge == grid.vertices_on_edge);
  CHECK(made.vertices_on_cell.values == grid.vertices_on_cell.values);
  CHECK(made.cells_on_cell.values == grid.cells_on_cell.values);
  CHECK(made.edges_on_edge.values == grid.edges_on_edge.values);
  CHECK(worst_distance(made.cell_position, grid.cell_position) < 4e-15);
  CHECK(worst_distance(made.vertex_position, grid.vertex_position) < 4e-15);
  CHECK(worst_distance(made.edge_position, grid.edge_position) < 1e-11);
  CHECK(made.cell_ring == grid.cell_ring);
}

}  // namespace

TEST_CASE(
    "a region goes from MPAS to each kind of cells and back with its cells, places and rings") {
  const TemporaryFolder folder;
  Host host;
  const Grid grid = region_of(Ellipsoid::sphere(6371220.0));
  const std::string mpas = folder.file("a.mpas.nc"), back = folder.file("b.mpas.nc");
  write_mpas(mpas, grid, samples::provenance(), {});
  for (const char* const name :
       {"b2.mpas.nc", "b.ugrid_cells.nc", "b.scrip.nc", "b.esmf.nc", "b.vtu"}) {
    CAPTURE(name);
    const std::string path = folder.file(name);
    CHECK(host.convert(mpas, path).empty());
    const GridFile file = host.read(path);
    REQUIRE(file.grid);
    check_same_cells(*file.grid, grid);
    CHECK(file.n_turned == 0);
    for (const BrokenRule& rule : check_grid(host.context, *file.grid)) FAIL_CHECK(to_string(rule));
    host.convert(path, back);
    const Grid again = read_mpas(back);
    check_same_cells(again, grid);
    const bool is_mpas = file.origin.format == "MPAS";
    if (is_mpas || file.origin.format == "UGRID")
      CHECK(again.edge_spacing_m == grid.edge_spacing_m);
    if (is_mpas || file.origin.format == "VTU") CHECK(again.cell_spacing_m == grid.cell_spacing_m);
  }
}

TEST_CASE("a region on an ellipsoid keeps its cells between the kinds that have a place for it") {
  const TemporaryFolder folder;
  Host host;
  const Grid grid = region_of(Ellipsoid::wgs84());
  const std::string vtu = folder.file("a.vtu");
  write_vtu_cells(vtu, grid);
  for (const char* const name : {"b.ugrid_cells.nc", "b.scrip.nc", "b.esmf.nc"}) {
    CAPTURE(name);
    host.convert(vtu, folder.file(name));
    host.convert(folder.file(name), folder.file("c.vtu"));
    const GridFile file = host.read(folder.file("c.vtu"));
    REQUIRE(file.grid);
    check_same_cells(*file.grid, grid);
  }
  expect_error(ErrorKind::output, {"sphere"}, [&] { host.convert(vtu, folder.file("c.mpas.nc")); });
}

TEST_CASE("triangles of a region go between all kinds of triangles, and to no cells") {
  const TemporaryFolder folder;
  Host host;
  const Grid grid = region_of(Ellipsoid::sphere(6371220.0));
  const std::string mpas = folder.file("a.mpas.nc"), first = folder.file("a.gmsh.msh");
  write_mpas(mpas, grid, samples::provenance(), {});
  const std::vector<std::string> left_out = host.convert(mpas, first);
  REQUIRE(left_out.size() >= 2);
  CHECK(left_out[0] == "rings");
  CHECK(left_out[1].find("the outlines of the cells along the border") == 0);
  const GridFile made = host.read(first);
  REQUIRE(made.triangles);
  for (const char* const name : {"b.ugrid_triangles.nc", "b.jigsaw.msh", "b.fesom", "b.vtu"}) {
    CAPTURE(name);
    const std::string path = folder.file(name), back = folder.file("c.gmsh.msh");
    host.convert(mpas, folder.file(std::string("direct.") + name));
    CHECK(host.convert(first, path).empty());
    CHECK(host.convert(path, back).empty());
    for (const std::string& file : {path, back, folder.file(std::string("direct.") + name)}) {
      if (file.find("direct.b.vtu") != std::string::npos) continue;  // of cells
      const GridFile again = host.read(file);
      REQUIRE(again.triangles);
      auto corners = again.triangles->corners;
      if (again.n_turned == 0) CHECK(corners == made.triangles->corners);
      CHECK(corners.size() == made.triangles->corners.size());
      CHECK(worst_distance(again.triangles->position, made.triangles->position) < 1e-12);
    }
  }
  for (const char* const kind : {"mpas", "ugrid_cells", "scrip", "esmf"}) {
    expect_error(ErrorKind::input, {"a.gmsh.msh", kind, "which holds cells"},
                 [&] { host.convert(first, folder.file("x"), kind); });
  }
}

TEST_CASE("an ocean's layers go along to FESOM2 with the cells in triangles") {
  const TemporaryFolder folder;
  Host host;
  host.write("data_path: []\ndomain: {}\nlayers: {kind: z_level}\n", folder.file("made"));
  const std::string mpas = folder.file("made/a.mpas.nc");
  host.convert(mpas, folder.file("b.fesom"));
  const TriangleSet made = read_fesom(folder.file("made/a.fesom"));
  const TriangleSet converted = read_fesom(folder.file("b.fesom"));
  CHECK(converted.depth_m == made.depth_m);
  CHECK(converted.level_m == made.level_m);
  CHECK(converted.corners == made.corners);
  const auto has_layers = [](const std::vector<std::string>& left_out) {
    return std::find(left_out.begin(), left_out.end(), "layers") == left_out.end();
  };
  CHECK(has_layers(host.convert(mpas, folder.file("b.mpas.nc"))));
  CHECK_FALSE(has_layers(host.convert(mpas, folder.file("b.scrip.nc"))));
  CHECK_FALSE(has_layers(host.convert(folder.file("b.fesom"), folder.file("b.jigsaw.msh"))));
  check_same(read_mpas_vertical(folder.file("b.mpas.nc")), read_mpas_vertical(mpas));
}

TEST_CASE("the layers of an ocean go along between MPAS and FESOM2") {
  const TemporaryFolder folder;
  Host host;
  host.write("layers: {kind: z_level}\n", folder.file("made"));
  const std::string mpas = folder.file("made/a.mpas.nc");
  const MpasVertical made = read_mpas_vertical(mpas);
  REQUIRE(made.ocean());
  CHECK(*std::max_element(made.n_layers.begin(), made.n_layers.end()) > 10);
  host.convert(mpas, folder.file("b.mpas.nc"));
  check_same(read_mpas_vertical(folder.file("b.mpas.nc")), made);
  host.convert(mpas, folder.file("b.fesom"));
  host.convert(folder.file("b.fesom"), folder.file("c.mpas.nc"));
  for (const char* const path : {"made/a.fesom", "b.fesom"}) {
    CAPTURE(path);
    const TriangleSet set = read_fesom(folder.file(path));
    CHECK(set.depth_m == made.bottom_depth_m);
    CHECK(set.level_m == made.interface_m);
  }
  check_same(read_mpas_vertical(folder.file("c.mpas.nc")), made);
}

TEST_CASE("the layers of an atmosphere go along from MPAS to MPAS, and none come from nowhere") {
  const TemporaryFolder folder;
  Host host;
  host.write("layers: {kind: terrain_following}\n", folder.file("made"));
  const MpasVertical made = read_mpas_vertical(folder.file("made/a.mpas.nc"));
  REQUIRE(made.terrain());
  host.convert(folder.file("made/a.mpas.nc"), folder.file("b.mpas.nc"));
  check_same(read_mpas_vertical(folder.file("b.mpas.nc")), made);
  host.convert(folder.file("b.mpas.nc"), folder.file("b.fesom"));
  CHECK(read_fesom(folder.file("b.fesom")).depth_m.empty());
  host.write("", folder.file("flat"));
  const MpasVertical none = read_mpas_vertical(folder.file("flat/a.mpas.nc"));
  CHECK_FALSE(none.ocean());
  CHECK_FALSE(none.terrain());
}
