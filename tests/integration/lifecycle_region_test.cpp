// SPDX-License-Identifier: BSD-3-Clause
// Regional grids from configurations.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "dual/validate.hpp"
#include "io/mpas.hpp"
#include "io/netcdf.hpp"
#include "lifecycle/config_file.hpp"
#include "lifecycle/restart.hpp"
#include "support/expect_error.hpp"
#include "support/products.hpp"
#include "support/sample_times.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using delos::testing::checked;
using delos::testing::expect_error;
using delos::testing::made;
using delos::testing::TemporaryFolder;

namespace {

std::string regional(const std::string& spacing, const std::string& region,
                     const std::string& more = "") {
  return "sizing: {sources: [{type: constant, spacing: " + spacing + "}]}\nregion: {" + region +
         "}\n" + more;
}

const std::string kDisc = "disc: {centre: [10 deg, 50 deg], radius: 2500 km}";

void expect_sound(const Grid& grid) {
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  for (const BrokenRule& rule : check_grid(context, grid, 1e-9)) FAIL_CHECK(to_string(rule));
}

std::int64_t told(const Product& product, const std::string& key) {
  for (const ReportSection& section : product.report.sections) {
    if (section.name != "region") continue;
    for (const auto& [name, value] : section.values) {
      if (name == key) return std::get<std::int64_t>(value);
    }
  }
  FAIL("the report has no region." << key);
  return 0;
}

std::int64_t n_in_ring(const Grid& grid, std::int32_t ring) {
  return std::count(grid.cell_ring.begin(), grid.cell_ring.end(), ring);
}

void write(const Product& product, const std::string& folder) {
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  write_outputs(context, output_content(product, "test"), folder);
}

}  // namespace

TEST_CASE("a regional grid has the same bits for any number of threads, and is sound") {
  const Product product = checked(regional("300 km", kDisc, "require: {well_centred: true}\n"));
  const Grid& grid = *product.grid;
  expect_sound(grid);
  // The disc's area over that of a cell, and half of its 51 cells on the outline; seven rings; the
  // coarse cells outside are few.
  CHECK(static_cast<double>(n_in_ring(grid, 0)) == doctest::Approx(249.0 + 25.0).epsilon(0.04));
  for (std::int32_t ring = 1; ring <= 7; ++ring) CHECK(n_in_ring(grid, ring) > 47);
  CHECK(n_in_ring(grid, 8) == 0);
  CHECK(told(product, "n_cells") == grid.n_cells());
  CHECK(told(product, "n_inside") == n_in_ring(grid, 0));
  CHECK(told(product, "n_specified") == n_in_ring(grid, 6) + n_in_ring(grid, 7));
  CHECK(product.mesh.n_vertices() < grid.n_cells() + 15 * n_in_ring(grid, 7) + 300);
  // The border is all of the outermost ring.
  for (const auto& cells : grid.cells_on_edge) {
    if (cells[1] == kNone) CHECK(grid.cell_ring[static_cast<std::size_t>(cells[0])] == 7);
  }
}

TEST_CASE("the last cells inside a region stand on its outline when it is aligned") {
  const auto n_off = [](const Product& product) {
    const Grid& grid = *product.grid;
    const Vec3 centre = Ellipsoid::sphere(1.0).point({10.0 * kRadPerDeg, 50.0 * kRadPerDeg},
                                                     LatitudeKind::geocentric);
    const double scale_m = grid.surface.scale_m();
    std::int64_t n = 0;
    for (Index cell = 0; cell < grid.n_cells(); ++cell) {
      const auto around = grid.cells_on_cell.row(cell);
      const bool is_last = grid.cell_ring[at(cell)] == 0 &&
                           std::any_of(around.begin(), around.end(),
                                       [&](Index c) { return grid.cell_ring[at(c)] == 1; });
      const double angle = std::acos(grid.cell_position[at(cell)].dot(centre));
      if (is_last && std::abs(angle * scale_m - 2500e3) > 0.1 * 250e3) ++n;
    }
    return n;
  };
  CHECK(n_off(made(regional("250 km", kDisc), 2)) == 0);
  CHECK(n_off(made(regional("250 km", kDisc + ", align: false"), 2)) > 20);
  // What comes near to itself is not followed, and made all the same.
  const std::string slotted =
      "points: [0 deg, 0 deg, 30 deg, 0 deg, 30 deg, 30 deg, 0 deg, 30 deg, 0 deg, 16 deg, "
      "20 deg, 16 deg, 20 deg, 15 deg, 0 deg, 15 deg]";
  const Product narrow = made(regional("300 km", slotted), 2);
  CHECK(n_in_ring(*narrow.grid, 0) > 1);
  CHECK(narrow.settings.refine.lines.empty());
}

TEST_CASE("MPAS files hold the rings of cells, edges and vertices and read back") {
  const TemporaryFolder folder;
  const std::string output = "output: {name: r, formats: [mpas]}\n";
  for (const std::string surface : {"", "surface: {shape: wgs84}\n"}) {
    const Product product =
        made(regional("250 km",
                      "disc: {centre: [0 deg, 85 deg], radius: 15 deg}, relaxation_rings: 2, "
                      "specified_rings: 1",
                      output + surface),
             2);
    const Grid& grid = *product.grid;
    write(product, folder.file("out"));
    const std::string path = folder.file("out/r.mpas.nc");
    const Grid back = read_mpas(path);
    CHECK(back.cell_ring == grid.cell_ring);
    CHECK(*std::max_element(back.cell_ring.begin(), back.cell_ring.end()) == 3);
    const netcdf::Reader file(path);
    const auto of_edges = file.read_int32("bdyMaskEdge");
    const auto of_vertices = file.read_int32("bdyMaskVertex");
    REQUIRE(static_cast<std::int64_t>(of_edges.size()) == grid.n_edges());
    REQUIRE(static_cast<std::int64_t>(of_vertices.size()) == grid.n_vertices());
    for (std::size_t edge = 0; edge < of_edges.size(); ++edge) {
      REQUIRE(of_edges[edge] == ring_of(back, back.cells_on_edge[edge]));
    }
    for (std::size_t vertex = 0; vertex < of_vertices.size(); ++vertex) {
      REQUIRE(of_vertices[vertex] == ring_of(back, back.cells_on_vertex[vertex]));
    }
  }
}

TEST_CASE("a regional grid comes back from a restart file with its rings and its report") {
  const TemporaryFolder folder;
  const Settings settings = read_settings(parse_config(regional("300 km", kDisc), "t.yaml"), ".");
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  const auto product = std::make_shared<const Product>(generate(context, settings, {}));
  const Clock clock({.start = samples::at("2000-01-01", Calendar::noleap),
                     .stop = samples::at("2000-02-01", Calendar::noleap),
                     .step = samples::lasting("P1D")});
  write_restart(folder.file("r.nc"), {product, 1, clock, std::nullopt, std::nullopt}, nullptr);
  const Restart back = read_restart(context, settings, folder.file("r.nc"));
  CHECK(digest(exec, *back.product->grid) == digest(exec, *product->grid));
  CHECK(back.product->grid->cell_ring == product->grid->cell_ring);
  CHECK(told(*back.product, "n_inside") == told(*product, "n_inside"));
}

TEST_CASE("polygons of a file or of the configuration make a region, on baselines too") {
  const TemporaryFolder folder;
  folder.write("region.geojson",
               R"({"type": "FeatureCollection", "features": [
                   {"type": "Feature", "properties": {"name": "other"}, "geometry":
                     {"type": "Polygon", "coordinates": [[[0,0],[9,0],[9,9],[0,0]]]}},
                   {"type": "Feature", "properties": {"name": "mine"}, "geometry":
                     {"type": "Polygon", "coordinates":
                       [[[150,-30],[-150,-30],[-150,30],[150,30],[150,-30]]]}}]})");
  const std::string of_file = "polygons: {file: " + folder.file("region.geojson") +
                              ", feature: mine}, relaxation_rings: 1, specified_rings: 1";
  const std::string of_points =
      "points: [150 deg, -30 deg, 210 deg, -30 deg, 210 deg, 30 deg, 150 deg, 30 deg], "
      "relaxation_rings: 1, specified_rings: 1";
  const Product product = made(regional("400 km", of_file), 2);
  CHECK(product.grid->cell_ring == made(regional("400 km", of_points), 2).grid->cell_ring);
  // Of the sphere, 60 / 360 * sin 30 degrees are in it, and half of 62 cells on its outline.
  const auto n = static_cast<double>(n_in_ring(*product.grid, 0));
  CHECK(n == doctest::Approx(3681.0 / 12.0 + 31.0).epsilon(0.05));
  const Product baseline =
      made("generator: icosahedral\nsubdivisions: 16\nregion: {" + of_file + "}\n", 2);
  CHECK(static_cast<double>(n_in_ring(*baseline.grid, 0)) ==
        doctest::Approx(2562.0 / 12.0).epsilon(0.08));
  expect_sound(*baseline.grid);
}

TEST_CASE("a domain and a region together keep the sea of the region") {
  // The Mediterranean and what is near it; the world's ocean is not its largest body.
  const Product product =
      made(regional("150 km", "disc: {centre: [18 deg, 36 deg], radius: 1000 km}",
                    "data_path: []\ndomain: {bodies: largest}\n"),
           2);
  const Grid& grid = *product.grid;
  expect_sound(grid);
  CHECK(grid.n_cells() > 60);
  CHECK(grid.n_cells() < 300);
  CHECK(static_cast<std::int64_t>(grid.cell_ring.size()) == grid.n_cells());
  CHECK(std::count(grid.cell_ring.begin(), grid.cell_ring.end(), kNone) == 0);
  CHECK(n_in_ring(grid, 0) > 30);
}

TEST_CASE("a budget is that of the region and its rings") {
  const Product product = made(
      "sizing: {sources: [{type: constant, spacing: 100 km}], cells: 3000}\n"
      "region: {" +
          kDisc + "}\n",
      2);
  CHECK(static_cast<double>(product.grid->n_cells()) == doctest::Approx(3000.0).epsilon(0.05));
}

TEST_CASE("regions that can't be had are refused with their key") {
  const auto refused = [](const std::string& yaml, std::initializer_list<std::string> words) {
    CAPTURE(yaml);
    expect_error(ErrorKind::config, words, [&] { made(yaml, 1); });
  };
  refused(regional("300 km", "relaxation_rings: 5"), {"region", "one of disc", "polygons"});
  refused(regional("300 km", kDisc + ", points: [0 deg, 0 deg, 9 deg, 0 deg, 9 deg, 9 deg]"),
          {"region", "one of disc"});
  refused(regional("300 km", "disc: {centre: [0 deg, 95 deg], radius: 9 deg}"),
          {"region.disc.centre", "95"});
  refused(regional("300 km", "disc: {centre: [0 deg, 9 deg], radius: 180 deg}"),
          {"region.disc.radius", "below 180 deg"});
  refused(regional("300 km", "points: [0 deg, 0 deg, 9 deg, 0 deg, 9 deg, 9 deg, 4 deg]"),
          {"region.points", "7 numbers"});
  refused(regional("300 km", kDisc,
                   "remesh: {interval: P1M, sources: [{type: indicator, quiet: [0, 60 km], "
                   "energetic: [1, 10 km]}]}\n"),
          {"region", "remesh"});
  const auto impossible = [](const std::string& yaml, std::initializer_list<std::string> words) {
    CAPTURE(yaml);
    expect_error(ErrorKind::input, words, [&] { made(yaml, 1); });
  };
  impossible(
      regional("300 km", "points: [0 deg, 0 deg, 30 deg, 0 deg, 0 deg, 30 deg, 30 deg, 30 deg]"),
      {"region.points", "crosses itself"});
  impossible(regional("300 km", "disc: {centre: [0 deg, 9 deg], radius: 30 km}"), {"few cells"});
  impossible(regional("500 km", "disc: {centre: [0 deg, 9 deg], radius: 170 deg}"),
             {"no room for ring"});
}
