// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/generate.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "lifecycle/edge_spacing.hpp"
#include "lifecycle/estimate.hpp"
#include "lifecycle/grid_file.hpp"
#include "lifecycle/settings_tree.hpp"
#include "metrics/certificate.hpp"
#include "support/expect_error.hpp"
#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;

namespace {

namespace fs = std::filesystem;

struct Run {
  explicit Run(int threads = 2) : exec(threads) {}
  parallel::Executor exec;
  Monitor monitor;
  Context context{exec, monitor};
};

Settings settings_of(const std::string& yaml) {
  return read_settings(parse_config(yaml, "test.yaml"), ".");
}

std::string yaml_of(const std::string& surface, const std::string& more = "") {
  return "surface: " + surface +
         "\nsizing: {sources: [{type: constant, spacing: 600 km}]}\n"
         "refine: {tile_vertices: 500}\n" +
         more;
}

constexpr char kTriaxial[] = "{shape: ellipsoid, radii: [7645.464 km, 6371.22 km, 5096.976 km]}";

void check_same(const Extreme& a, const Extreme& b) {
  CHECK(a.value == b.value);
  CHECK(a.id == b.id);
  CHECK(a.other == b.other);
  CHECK(a.element == b.element);
  CHECK(a.where.lon_rad == doctest::Approx(b.where.lon_rad).epsilon(1e-14));
  CHECK(a.where.lat_rad == doctest::Approx(b.where.lat_rad).epsilon(1e-14));
}

void check_same(const Certificate& a, const Certificate& b) {
  CHECK(a.well_centred == b.well_centred);
  CHECK(a.n_obtuse == b.n_obtuse);
  check_same(a.angle_max_deg, b.angle_max_deg);
  check_same(a.dual_ratio_min, b.dual_ratio_min);
  check_same(a.stagger_max, b.stagger_max);
  REQUIRE(a.relative_edge_min);
  check_same(*a.relative_edge_min, *b.relative_edge_min);
}

ErrorKind kind_of_error(const std::string& yaml, const std::string& directory = "") {
  Run run;
  try {
    static_cast<void>(generate(run.context, settings_of(yaml), {true, directory}));
  } catch (const Error& error) {
    MESSAGE(std::string(error.what()));
    return error.kind();
  }
  FAIL("no error");
  return ErrorKind::internal;
}

}  // namespace

TEST_CASE("the same configuration gives the same bits for 1, 2, 5 and 8 threads") {
  for (const std::string surface : {"{shape: sphere}", "{shape: wgs84}", kTriaxial}) {
    CAPTURE(surface);
    const Settings settings = settings_of(yaml_of(surface));
    Run one(1);
    const Product straight = generate(one.context, settings, {});
    for (const int threads : {2, 5, 8}) {
      Run run(threads);
      const Product product = generate(run.context, settings, {});
      CHECK(product.report.digest == straight.report.digest);
      CHECK(product.report.sections.back().values == straight.report.sections.back().values);
    }
  }
}

TEST_CASE("all files of a run are read back with the digest and certificate of the grid") {
  for (const std::string surface : {"{shape: sphere}", "{shape: wgs84}", kTriaxial}) {
    CAPTURE(surface);
    const testing::TemporaryFolder folder;
    Run run;
    const Settings settings = settings_of(yaml_of(surface, "output: {spacing: true}\n"));
    const Product product = generate(run.context, settings, {});
    const std::string directory = folder.file("new/deep");
    const auto paths = write_outputs(run.context, output_content(product, "test"), directory);
    CHECK(paths.size() == 7);
    for (const std::string& path : paths) CHECK(fs::file_size(path) > 0);
    CHECK(std::distance(fs::directory_iterator(directory), {}) == 7);

    const auto grids = grid_files(directory);
    REQUIRE(grids.size() == 3);
    for (const std::string& path : grids) {
      CAPTURE(path);
      const GridFile file = read_grid_file(run.context, path);
      CHECK(file.origin.digest == product.report.digest);
      CHECK(file.origin.config == settings.text);
      REQUIRE(file.mesh.has_value());
      REQUIRE(file.origin.certificate);
      const bool is_carried = file.origin.format == "MPAS" && !settings.surface.is_sphere();
      if (!is_carried) check_same(*file.origin.certificate, certificate(product.report.quality));
      const Quality measured =
          measure_quality(run.context, file.surface, file.spacing, *file.mesh, file.latitude);
      const auto defects =
          certificate_defects(run.context, {file.surface, file.spacing, *file.mesh, file.latitude},
                              measured, *file.origin.certificate);
      CHECK_MESSAGE(defects.empty(), (defects.empty() ? std::string() : defects.front()));
      CHECK(file.mesh->n_vertices() == product.mesh.n_vertices());
      CHECK(file.mesh->n_triangles() == product.mesh.n_triangles());
    }
  }
}

TEST_CASE("a run that fails while it writes leaves no folder behind") {
  const testing::TemporaryFolder folder;
  Run run;
  const Product product = generate(
      run.context, settings_of(yaml_of("{shape: sphere}", "output: {pictures: [globe]}\n")), {});
  OutputContent content = output_content(product, "test");
  content.draw = [](const std::string&, const std::string&) {
    throw Error(ErrorKind::output, "the disk is full");
  };
  CHECK_THROWS_AS(write_outputs(run.context, content, folder.file("a/b")), Error);
  CHECK(fs::is_empty(folder.file("")));
}

TEST_CASE("a grid too large is refused with its size before anything is allocated") {
  const std::string globe = "sizing: {sources: [{type: constant, spacing: 1 m}]}\n";
  CHECK(kind_of_error(globe) == ErrorKind::resource);
  const Estimate estimate = estimate_cost(settings_of(globe), 1e6, true);
  CHECK_THROWS_WITH_AS(check_estimate(estimate, 1e8), doctest::Contains("memory are available"),
                       Error);
  CHECK_NOTHROW(check_estimate(estimate, 1e11));
}

TEST_CASE("a table of spacings that passes the memory is refused before it is made") {
  CHECK_NOTHROW(check_table(0.05 * kRadPerDeg, 1e9));
  CHECK_THROWS_WITH_AS(
      check_table(0.05 * kRadPerDeg, 4e8),
      doctest::Contains("sizing.resolution: a table of spacings every 0.05 degrees"), Error);
}

TEST_CASE("an output folder that can't be is refused before the computation") {
  const testing::TemporaryFolder folder;
  folder.write("file", "no folder");
  CHECK(kind_of_error(yaml_of("{shape: sphere}"), folder.file("file/out")) == ErrorKind::output);
  CHECK_THROWS_AS(check_output_folder(folder.file(""), 1e18), Error);
  CHECK_NOTHROW(check_output_folder(folder.file("new/deep"), 1e3));
  CHECK(std::distance(fs::directory_iterator(folder.file("")), {}) == 1);
}

TEST_CASE("requirements that are missed are an error that names the worst element") {
  const std::string cubed = "generator: cubed_sphere\nsubdivisions: 83\n";
  CHECK(kind_of_error(cubed + "require: {well_centred: true}\n") == ErrorKind::quality);
  CHECK(kind_of_error(cubed + "require: {angle_max: 61 deg}\n") == ErrorKind::quality);
  CHECK(kind_of_error(cubed + "require: {relative_edge_min: 1}\n") == ErrorKind::quality);
  CHECK(kind_of_error(cubed + "require: {dual_ratio_min: 0.57}\n") == ErrorKind::quality);
  CHECK(kind_of_error(cubed + "require: {degree_6_min: 0.9999}\n") == ErrorKind::quality);
  Run run;
  CHECK_NOTHROW(static_cast<void>(generate(
      run.context, settings_of(cubed + "require: {well_centred: true, keep: true}\n"), {})));
}

TEST_CASE("a grid that misses a requirement leaves its report, which a good grid removes") {
  const testing::TemporaryFolder folder;
  const std::string directory = folder.file("new/deep");
  const std::string relaxed = yaml_of("{shape: sphere}", "require: {well_centred: true}\n");
  const std::string bad = relaxed + "relax: {spring_rounds: 0, polish_rounds: 0}\n";
  const auto n_files = [&] { return std::distance(fs::directory_iterator(directory), {}); };
  CHECK(kind_of_error(bad) == ErrorKind::quality);  // without a folder no report either
  CHECK(kind_of_error(bad + "output: {report: false}\n", directory) == ErrorKind::quality);
  CHECK_FALSE(fs::exists(folder.file("new")));

  CHECK(kind_of_error(bad, directory) == ErrorKind::quality);
  CHECK(n_files() == 2);
  CHECK(fs::file_size(directory + "/grid.rejected.report.txt") > 500);
  CHECK(fs::file_size(directory + "/grid.rejected.report.json") > 5000);

  Run run;
  const Product product = generate(run.context, settings_of(relaxed), {true, directory});
  CHECK(n_files() == 2);
  CHECK(write_outputs(run.context, output_content(product, "test"), directory).size() == 6);
  CHECK(n_files() == 6);
}

TEST_CASE("what is carried to a sphere for MPAS must meet the requirements as well") {
  const std::string yaml = yaml_of("{shape: wgs84}", "output: {formats: [mpas]}\n");
  const testing::TemporaryFolder folder;
  const std::string path = folder.file("a.nc");
  Run run;
  const Product free = generate(run.context, settings_of(yaml), {});
  write_grid_file(run.context, output_content(free, "test"), FileKind::mpas, path);
  const auto carried = read_grid_file(run.context, path).origin.certificate;
  REQUIRE(carried);
  fs::remove(path);

  // A bound that the grid meets and its image does not.
  const Certificate own = certificate(free.report.quality);
  std::string key, bound;
  const auto consider = [&](const char* name, double body, double sphere, bool is_least) {
    if (is_least ? sphere >= body : sphere <= body) return;
    key = text(name, ": ");
    bound = text("require: {", name, ": ", 0.5 * (body + sphere), "}\n");
  };
  consider("stagger_max", own.stagger_max.value, carried->stagger_max.value, false);
  consider("dual_ratio_min", own.dual_ratio_min.value, carried->dual_ratio_min.value, true);
  consider("relative_edge_min", own.relative_edge_min->value, carried->relative_edge_min->value,
           true);
  REQUIRE_FALSE(key.empty());
  const Product product = generate(run.context, settings_of(yaml + bound), {});
  testing::expect_error(
      ErrorKind::quality, {"sphere of equal area", key, "Nothing was written"},
      [&] { write_grid_file(run.context, output_content(product, "test"), FileKind::mpas, path); });
  CHECK(fs::is_empty(folder.file("")));
}

TEST_CASE("a spacing by edge goes to the sides of the triangles, in any order of the edges") {
  Mesh mesh = samples::bisected_icosahedron(Ellipsoid(), 2);
  std::vector<std::array<Index, 2>> cells, triangles;
  std::vector<double> spacing_m;
  for (Index tri = mesh.n_triangles() - 1; tri >= 0; --tri) {
    for (int k = 0; k < 3; ++k) {
      const Triangle& triangle = mesh.triangle(tri);
      const Index other = triangle.neighbour[static_cast<std::size_t>(k)];
      if (other < tri) continue;
      cells.push_back({triangle.vertex[static_cast<std::size_t>(next_corner(k))],
                       triangle.vertex[static_cast<std::size_t>(previous_corner(k))]});
      triangles.push_back({other, tri});
      spacing_m.push_back(2.0 * (3 * tri + k + 1));
    }
  }
  const SideSpacing by_cells = spacing_by_side(mesh, {cells, EdgeEnds::vertices, spacing_m}, 2.0);
  const SideSpacing by_triangles =
      spacing_by_side(mesh, {triangles, EdgeEnds::triangles, spacing_m}, 2.0);
  for (Index tri = 0; tri < mesh.n_triangles(); ++tri) {
    for (int k = 0; k < 3; ++k) {
      const Index other = mesh.triangle(tri).neighbour[static_cast<std::size_t>(k)];
      const double wanted =
          other > tri ? 3 * tri + k + 1 : 3 * other + side_towards(mesh.triangle(other), tri) + 1;
      CHECK(by_cells(tri, k) == wanted);
      CHECK(by_triangles(tri, k) == wanted);
    }
  }
  std::vector<double> bad = spacing_m;
  bad[5] = 0.0;
  testing::expect_error(ErrorKind::input, {"delos_edge_spacing is 0 at edge 6 (from 1)"}, [&] {
    spacing_by_side(mesh, {cells, EdgeEnds::vertices, bad}, 2.0);
  });
  cells[7] = cells[8];
  testing::expect_error(ErrorKind::input, {"is not in the list of edges"}, [&] {
    spacing_by_side(mesh, {cells, EdgeEnds::vertices, spacing_m}, 2.0);
  });
}

TEST_CASE("baselines have the number of cells that their names promise") {
  Run run;
  const auto cells = [&](const std::string& yaml) {
    return generate(run.context, settings_of(yaml), {}).grid->n_cells();
  };
  CHECK(cells("generator: icosahedral\nsubdivisions: 12\n") == 1442);
  CHECK(cells("generator: cubed_sphere\nsubdivisions: 9\n") == 488);
}

TEST_CASE("an optional source without its file is left out, others are missed by name") {
  const auto yaml = [](const char* optional) {
    return std::string(
               "sizing:\n  sources:\n    - {type: constant, spacing: 600 km}\n"
               "    - {type: raster, file: nowhere.nc, optional: ") +
           optional + "}\n";
  };
  Run run;
  const Product product = generate(run.context, settings_of(yaml("true")), {});
  CHECK(product.grid->n_cells() > 1000);
  CHECK_THROWS_WITH_AS(static_cast<void>(generate(run.context, settings_of(yaml("false")), {})),
                       doctest::Contains("test.yaml:4 sizing.sources.1.file"), Error);
}

TEST_CASE("lines of a file and of the configuration are kept and told in the report") {
  const testing::TemporaryFolder folder;
  const std::string file =
      folder.write("l.geojson", R"({"type":"LineString","coordinates":[[170,-20],[-170,20]]})");
  const Settings settings = settings_of(yaml_of(
      "{shape: sphere}", "constraints: {files: " + file +
                             ", shapes: [{type: points, points: [180 deg, 60 deg, 0 deg, 90 deg]}, "
                             "{type: line, points: [170 deg, -20 deg, 150 deg, -60 deg]}]}\n"));
  Run run;
  const Product product = generate(run.context, settings, {});
  const Mesh& mesh = product.mesh;
  const std::vector<std::array<double, 2>> given = {
      {170, -20}, {-170, 20}, {180, 60}, {0, 90}, {150, -60}};
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto [lon, lat] = given[i];
    CHECK(mesh.position(static_cast<Index>(i)) ==
          settings.surface.point({lon * kRadPerDeg, lat * kRadPerDeg}, settings.latitude));
  }
  const auto section =
      std::find_if(product.report.sections.begin(), product.report.sections.end(),
                   [](const ReportSection& entry) { return entry.name == "constraints"; });
  REQUIRE(section != product.report.sections.end());
  CHECK(section->values[0] == std::pair<std::string, ReportValue>("n_points", std::int64_t{5}));
  CHECK(section->values[3].first == "n_edges");
  CHECK(std::get<std::int64_t>(section->values[3].second) == mesh.fixed.n_edges());
  CHECK(mesh.fixed.n_edges() >= 15);  // 9800 km in steps of 600
}
