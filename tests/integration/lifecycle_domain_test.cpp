// SPDX-License-Identifier: BSD-3-Clause
// Oceans from configurations, with the bathymetry that delos carries.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include "dual/validate.hpp"
#include "io/mpas.hpp"
#include "lifecycle/config_file.hpp"
#include "lifecycle/grid_file.hpp"
#include "lifecycle/restart.hpp"
#include "metrics/open_mesh.hpp"
#include "support/expect_error.hpp"
#include "support/products.hpp"
#include "support/sample_times.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using delos::testing::checked;
using delos::testing::expect_error;
using delos::testing::made;
using delos::testing::TemporaryFolder;
using delos::testing::value_of;

namespace {

namespace fs = std::filesystem;

std::string uniform(const std::string& spacing, const std::string& domain) {
  return "sizing: {sources: [{type: constant, spacing: " + spacing + "}]}\n" + domain;
}

// Nothing is searched for, so that the embedded bathymetry serves on every machine.
const std::string kEmbedded = "data_path: []\n";

void expect_sound(const Grid& grid, double tolerance = 1e-9) {
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  for (const BrokenRule& rule : check_grid(context, grid, tolerance)) FAIL_CHECK(to_string(rule));
}

GridFile read_back(const std::string& path) {
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  return read_grid_file(context, path);
}

}  // namespace

TEST_CASE("a culled product has the same bits for any number of threads, and is sound") {
  const Product product = checked(uniform("500 km", kEmbedded + "domain: {remove: [bays]}\n"));
  REQUIRE(product.domain);
  const Grid& grid = *product.grid;
  CHECK(grid.n_cells() < 0.8 * static_cast<double>(product.mesh.n_vertices()));
  CHECK(grid.n_cells() > 0.6 * static_cast<double>(product.mesh.n_vertices()));
  CHECK(value_of<std::int64_t>(product.report, "domain", "n_cells") == grid.n_cells());
  expect_sound(grid);
}

TEST_CASE("a fitted coast lies nearer to that of the data, in a grid that is still well centred") {
  const auto product_of = [](const char* fit) {
    return checked(uniform(
        "600 km", kEmbedded + "domain: {fit_coast: " + fit + "}\nrequire: {well_centred: true}\n"));
  };
  const Product plain = product_of("false"), fitted = product_of("true");
  const auto coast = [](const Product& product, const char* key) {
    return value_of<double>(product.report, "coast", key);
  };
  CHECK(coast(fitted, "offset_m") < 0.8 * coast(plain, "offset_m"));
  CHECK(coast(fitted, "step_m") < 0.9 * coast(plain, "step_m"));
  CHECK(coast(fitted, "length_over_line") < 0.95 * coast(plain, "length_over_line"));
  CHECK(value_of<std::int64_t>(fitted.report, "fit_coast", "n_moved") > 100);
  CHECK(fitted.report.quality.relative_edge_min.value > 0.65);
  expect_sound(*fitted.grid);
}

TEST_CASE("land polygons make an ocean, on baselines and ellipsoids too") {
  const TemporaryFolder folder;
  folder.write(
      "land.geojson",
      R"({"type": "Polygon", "coordinates": [[[-60,-90],[60,-90],[60,90],[-60,90],[-60,-90]]]})");
  for (const char* const head : {"generator: icosahedral\nsubdivisions: 12\n",
                                 "surface: {shape: wgs84}\nsizing: {sources: [{type: constant, "
                                 "spacing: 600 km}]}\n"}) {
    const Product product = made(std::string(head) + "domain: {land: {file: land.geojson}}\n", 2,
                                 fs::path(folder.file("x")).parent_path().string());
    const double share = static_cast<double>(product.grid->n_cells()) /
                         static_cast<double>(product.mesh.n_vertices());
    CHECK(share == doctest::Approx(2.0 / 3.0).epsilon(0.05));
    expect_sound(*product.grid);
  }
}

TEST_CASE("every kind of file holds the ocean alone and reads back") {
  const TemporaryFolder folder;
  const Product product =
      made(uniform("500 km", kEmbedded +
                                 "domain: {}\noutput: {name: o, formats: [mpas, ugrid_triangles, "
                                 "ugrid_cells, scrip, esmf, vtu, gmsh, jigsaw, fesom]}\n"),
           2);
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  write_outputs(context, output_content(product, "test"), folder.file("out"));
  const Grid& grid = *product.grid;
  const auto n_triangles = std::count_if(
      grid.cells_on_vertex.begin(), grid.cells_on_vertex.end(),
      [](const auto& cells) { return *std::min_element(cells.begin(), cells.end()) != kNone; });
  int n_grids = 0;
  for (const std::string& path : grid_files(folder.file("out"))) {
    CAPTURE(path);
    const GridFile file = read_back(path);
    ++n_grids;
    CHECK_FALSE(file.mesh);
    if (file.grid) {
      expect_sound(*file.grid);
      CHECK(file.grid->cells_on_edge == grid.cells_on_edge);
      CHECK(file.grid->vertices_on_edge == grid.vertices_on_edge);
      CHECK(file.grid->edges_on_edge.values == grid.edges_on_edge.values);
      continue;
    }
    REQUIRE(file.triangles);
    CHECK(static_cast<std::int64_t>(file.triangles->corners.size()) == n_triangles);
    CHECK(measure_open_mesh(file.surface, file.triangles->position, file.triangles->corners)
              .defects.empty());
  }
  CHECK(n_grids == 8);  // FESOM2 is a folder of its own
  CHECK(read_back(folder.file("out/o.fesom/nod2d.out")).triangles);
}

TEST_CASE("a culled grid comes back from a restart file with the same bits") {
  const TemporaryFolder folder;
  const Settings settings =
      read_settings(parse_config(uniform("700 km", kEmbedded + "domain: {}\n"), "t.yaml"), ".");
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  const auto product = std::make_shared<const Product>(generate(context, settings, {}));
  const Clock clock({.start = samples::at("2000-01-01", Calendar::noleap),
                     .stop = samples::at("2000-02-01", Calendar::noleap),
                     .step = samples::lasting("P1D")});
  write_restart(folder.file("r.nc"), {product, 1, clock, std::nullopt, std::nullopt}, nullptr);
  const Restart back = read_restart(context, settings, folder.file("r.nc"));
  CHECK(digest(*back.product->grid) == digest(*product->grid));
  CHECK(report_notes(back.product->report) == report_notes(product->report));
  CHECK(back.product->domain->vertices == product->domain->vertices);
}

TEST_CASE("what a domain can't be is said with its key") {
  const auto refused = [](const std::string& domain, std::initializer_list<std::string> parts) {
    expect_error(ErrorKind::config, parts,
                 [&] { made(uniform("900 km", kEmbedded + "domain: " + domain + "\n"), 1); });
  };
  refused("{wet_fraction: 0}", {"domain.wet_fraction", "between"});
  refused("{wet_fration: 0.5}", {"wet_fration", "Did you mean 'wet_fraction'"});
  refused("{bodies: largst}", {"domain.bodies", "Did you mean 'largest'"});
  refused("{bodies: named}", {"domain.at", "lon: 35 deg"});
  refused("{at: [{lon: 0 deg, lat: 0 deg}]}", {"domain.at", "bodies: named"});
  refused("{order: metis}", {"domain.parts", "64"});
  refused("{parts: 8}", {"domain.parts", "order: metis"});
  refused("{land: {file: x.geojson}, sea_level: 3 m}", {"domain.sea_level", "land"});
  refused("{remove: [bay]}", {"domain.remove", "bays"});
  refused(
      "{fit_coast: true}\nremesh: {interval: P1M, sources: [{type: indicator, quiet: [0, 60 km], "
      "energetic: "
      "[1, 10 km]}]}",
      {"domain", "fit_coast", "remesh"});
  expect_error(ErrorKind::input, {"domain.passages.file", "nowhere.geojson"}, [&] {
    made(uniform("900 km", kEmbedded + "domain: {passages: {file: nowhere.geojson}}\n"), 1);
  });
}
