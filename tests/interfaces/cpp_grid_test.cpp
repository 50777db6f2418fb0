// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <delos/delos.hpp>
#include <filesystem>
#include <numbers>
#include <numeric>
#include <set>

namespace {

constexpr char kSmall[] =
    "sizing: {sources: [{type: constant, spacing: 600 km}]}\n"
    "refine: {tile_vertices: 500}\n";

delos::Grid small_grid() { return delos::generate(delos::Config::from_text(kSmall)); }

struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() /
      ("delos_interfaces_" + std::to_string(reinterpret_cast<std::uintptr_t>(this)));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
};

}  // namespace

TEST_CASE("a grid from text has the counts of a closed surface and the area of the Earth") {
  const delos::Grid grid = small_grid();
  CHECK(grid.n_cells() > 1000);
  CHECK(grid.n_cells() - grid.n_edges() + grid.n_vertices() == 2);
  CHECK(grid.generation() == 1);
  CHECK(grid.digest().size() == 64);
  CHECK(grid.max_edges() >= 6);
  const auto areas_m2 = grid.cell_area_m2();
  const double total_m2 = std::accumulate(areas_m2.begin(), areas_m2.end(), 0.0);
  const double earth_m2 = 4.0 * std::numbers::pi * 6371220.0 * 6371220.0;
  CHECK(std::abs(total_m2 / earth_m2 - 1.0) < 1e-12);
}

TEST_CASE("every span has the documented length and ids in range") {
  const delos::Grid grid = small_grid();
  const auto n_cells = static_cast<std::size_t>(grid.n_cells());
  const auto n_edges = static_cast<std::size_t>(grid.n_edges());
  const auto n_vertices = static_cast<std::size_t>(grid.n_vertices());
  CHECK(grid.cell_position().size() == 3 * n_cells);
  CHECK(grid.edge_position().size() == 3 * n_edges);
  CHECK(grid.vertex_position().size() == 3 * n_vertices);
  CHECK(grid.cell_lon_lat().size() == 2 * n_cells);
  CHECK(grid.edge_lon_lat().size() == 2 * n_edges);
  CHECK(grid.vertex_lon_lat().size() == 2 * n_vertices);
  CHECK(grid.cell_offsets().size() == n_cells + 1);
  CHECK(grid.edges_on_cell().size() == 2 * n_edges);
  CHECK(grid.vertices_on_cell().size() == 2 * n_edges);
  CHECK(grid.cells_on_cell().size() == 2 * n_edges);
  CHECK(grid.cells_on_edge().size() == 2 * n_edges);
  CHECK(grid.vertices_on_edge().size() == 2 * n_edges);
  CHECK(grid.cells_on_vertex().size() == 3 * n_vertices);
  CHECK(grid.edges_on_vertex().size() == 3 * n_vertices);
  CHECK(grid.edges_on_edge().size() == static_cast<std::size_t>(grid.edge_offsets().back()));
  CHECK(grid.weights_on_edge().size() == grid.edges_on_edge().size());
  CHECK(grid.cell_spacing_m().size() == n_cells);
  CHECK(grid.kite_area_m2().size() == 3 * n_vertices);
  CHECK(grid.cell_distance_m().size() == n_edges);
  for (const std::int32_t cell : grid.cells_on_edge()) {
    REQUIRE(cell >= 0);
    REQUIRE(cell < grid.n_cells());
  }
  for (std::size_t i = 0; i < n_cells; ++i) {
    const double* const p = grid.cell_position().data() + 3 * i;
    REQUIRE(std::abs(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - 1.0) < 1e-12);
  }
}

TEST_CASE("a culled grid has -1 where its neighbours are gone, and names no element it lacks") {
  const delos::Grid grid = delos::generate(
      delos::Config::from_text(std::string(kSmall) + "data_path: []\ndomain: {}\n"));
  const delos::Grid whole = small_grid();
  CHECK(grid.n_cells() < whole.n_cells());
  const auto cells = grid.cells_on_edge();
  std::int64_t n_border = 0;
  for (std::size_t edge = 0; 2 * edge < cells.size(); ++edge) {
    CHECK(cells[2 * edge] >= 0);
    n_border += cells[2 * edge + 1] == -1;
  }
  CHECK(n_border > 50);
  CHECK(grid.cell_offsets().back() == 2 * grid.n_edges() - n_border);
  CHECK(std::count(grid.cells_on_cell().begin(), grid.cells_on_cell().end(), -1) == n_border);
  const auto& certificate = grid.certificate();
  for (const auto& worst : {certificate.dual_ratio_min, certificate.stagger_max}) {
    CHECK(worst.id >= -1);
    CHECK(worst.id < grid.n_edges());
  }
  CHECK(certificate.angle_max_deg.id < grid.n_vertices());
}

TEST_CASE("a regional grid hands out its rings, other grids none") {
  CHECK(small_grid().cell_ring().empty());
  const delos::Grid grid = delos::generate(delos::Config::from_text(
      std::string(kSmall) + "region: {disc: {centre: [0 deg, 40 deg], radius: 40 deg}}\n"));
  const auto rings = grid.cell_ring();
  REQUIRE(static_cast<std::int64_t>(rings.size()) == grid.n_cells());
  CHECK(*std::min_element(rings.begin(), rings.end()) == 0);
  CHECK(*std::max_element(rings.begin(), rings.end()) == 7);
}

TEST_CASE("the certificate names elements of the grid's own arrays") {
  const delos::Grid grid = small_grid();
  const delos::Certificate& certificate = grid.certificate();
  CHECK(certificate.well_centred);
  CHECK(certificate.well_centred_fraction == 1.0);
  CHECK(certificate.n_obtuse == 0);
  CHECK(certificate.spacing_kept);
  CHECK(certificate.relative_edge_min.value >= certificate.relative_edge_bound);
  const auto at = [](std::int64_t i) { return static_cast<std::size_t>(i); };

  // The dual edge over its edge, as arcs: near the chords of the measure.
  const delos::Worst& dual = certificate.dual_ratio_min;
  REQUIRE(dual.id >= 0);
  REQUIRE(dual.id < grid.n_edges());
  CHECK(grid.cells_on_edge()[2 * at(dual.id)] == dual.cells[0]);
  CHECK(grid.cells_on_edge()[2 * at(dual.id) + 1] == dual.cells[1]);
  double least = 1e9;
  for (std::size_t i = 0; i < at(grid.n_edges()); ++i) {
    least = std::min(least, grid.vertex_distance_m()[i] / grid.cell_distance_m()[i]);
  }
  CHECK(dual.value == doctest::Approx(least).epsilon(1e-2));
  CHECK(grid.vertex_distance_m()[at(dual.id)] / grid.cell_distance_m()[at(dual.id)] ==
        doctest::Approx(least).epsilon(1e-3));

  const delos::Worst& edge = certificate.relative_edge_min;
  CHECK(grid.edge_spacing_m().size() == at(grid.n_edges()));
  CHECK(grid.edge_spacing_m()[at(edge.id)] == doctest::Approx(600e3));
  CHECK(grid.cell_distance_m()[at(edge.id)] / 600e3 == doctest::Approx(edge.value).epsilon(1e-2));
  CHECK(grid.edge_lon_lat()[2 * at(edge.id)] == doctest::Approx(edge.lon_rad));
  CHECK(grid.edge_lon_lat()[2 * at(edge.id) + 1] == doctest::Approx(edge.lat_rad));

  const delos::Worst& angle = certificate.angle_max_deg;
  CHECK(angle.id < grid.n_vertices());
  CHECK(angle.cells[0] == -1);
  CHECK(angle.value > 60.0);
  CHECK(angle.value < 90.0);
}

TEST_CASE("a requirement that is missed is an error of its own kind, and nothing is written") {
  auto config = delos::Config::from_text(kSmall);
  config.set("require.angle_max", "60.5 deg");
  try {
    static_cast<void>(delos::generate(config));
    FAIL("the requirement was passed over");
  } catch (const delos::Error& error) {
    CHECK(error.kind() == delos::ErrorKind::quality);
    const std::string message = error.what();
    for (const char* const part : {"angle_max: ", "at most 60.5 deg", "triangle ", "lon "}) {
      CAPTURE(part);
      CHECK(message.find(part) != std::string::npos);
    }
  }
  config.set("require.keep", "true");
  CHECK(delos::generate(config).n_cells() > 1000);
}

TEST_CASE("the grid does not depend on the number of threads") {
  const auto config = delos::Config::from_text(kSmall);
  const std::string one = delos::generate(config, {.threads = 1}).digest();
  for (const int threads : {2, 5})
    CHECK(delos::generate(config, {.threads = threads}).digest() == one);
}

TEST_CASE("set changes one key and text reads back") {
  auto config = delos::Config::from_text(kSmall);
  const auto copy = config;
  config.set("sizing.sources.0.spacing", "500 km");
  CHECK(config.text().find("500 km") != std::string::npos);
  CHECK(copy.text().find("600 km") != std::string::npos);
  CHECK(delos::Config::from_text(config.text()).text() == config.text());
}

TEST_CASE("errors carry their kind and place") {
  CHECK_THROWS_AS(delos::Config::from_file("no such file.yaml"), delos::Error);
  try {
    delos::Config::from_text("sizing:\n  sorces: []\n", "mine.yaml").check();
    FAIL("an unknown key was accepted");
  } catch (const delos::Error& error) {
    CHECK(error.kind() == delos::ErrorKind::config);
    CHECK(std::string(error.what()).find("mine.yaml:2 sizing.sorces") == 0);
    CHECK(std::string(delos::to_string(error.kind())) == "config");
  }
}

TEST_CASE("progress names the phases, and the log is heard") {
  std::set<std::string> phases;
  delos::GenerateOptions options;
  options.progress = [&](const delos::Progress& progress) { phases.insert(progress.phase); };
  int n_messages = 0;
  options.log = [&](delos::LogLevel, const std::string&) { ++n_messages; };
  static_cast<void>(delos::generate(delos::Config::from_text(kSmall), options));
  for (const char* const phase : {"read", "spacing", "refine", "quality", "dual"}) {
    CAPTURE(phase);
    CHECK(phases.count(phase) == 1);
  }
  CHECK(n_messages > 0);
}

TEST_CASE("a cancelled generate throws and nothing else") {
  const std::atomic<bool> cancel{true};
  delos::GenerateOptions options;
  options.cancel = &cancel;
  try {
    static_cast<void>(delos::generate(delos::Config::from_text(kSmall), options));
    FAIL("the flag was not seen");
  } catch (const delos::Error& error) {
    CHECK(error.kind() == delos::ErrorKind::cancelled);
  }
}

TEST_CASE("two grids live side by side and copies share their arrays") {
  const delos::Grid first = small_grid();
  const delos::Grid copy = first;
  const delos::Grid second = small_grid();
  CHECK(copy.cell_area_m2().data() == first.cell_area_m2().data());
  CHECK(second.cell_area_m2().data() != first.cell_area_m2().data());
  CHECK(second.digest() == first.digest());
}

TEST_CASE("files are written on request, and only then") {
  const Folder folder;
  const delos::Grid grid = small_grid();
  CHECK(std::filesystem::is_empty(folder.path));
  const auto file = [&](const char* name) { return (folder.path / name).string(); };
  grid.write_mpas(file("a.nc"));
  grid.write_ugrid_cells(file("b.nc"));
  grid.write_ugrid_triangles(file("c.nc"));
  grid.write_report(file("d.json"));
  for (const char* const name : {"a.nc", "b.nc", "c.nc", "d.json"}) {
    CHECK(std::filesystem::file_size(file(name)) > 1000);
  }
  CHECK_THROWS_AS(grid.write_mpas(file("nowhere/a.nc")), delos::Error);
  const auto paths = grid.write_outputs(file("all"));
  CHECK(paths.size() == 6);
  for (const std::string& path : paths) CHECK(std::filesystem::exists(path));
}

TEST_CASE("the version is three numbers") {
  const std::string version = delos::version();
  CHECK(std::count(version.begin(), version.end(), '.') == 2);
}
