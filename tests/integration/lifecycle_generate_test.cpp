// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/generate.hpp"

#include <doctest/doctest.h>

#include <filesystem>

#include "core/error.hpp"
#include "lifecycle/estimate.hpp"
#include "lifecycle/grid_file.hpp"
#include "lifecycle/settings_tree.hpp"
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
      CHECK(file.origin.has_certificate);
      REQUIRE(file.mesh.has_value());
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
  CHECK(kind_of_error(cubed + "require: {max_angle: 61 deg}\n") == ErrorKind::quality);
  CHECK(kind_of_error(cubed + "require: {min_relative_edge: 1}\n") == ErrorKind::quality);
  CHECK(kind_of_error(cubed + "require: {min_dual_ratio: 0.9}\n") == ErrorKind::quality);
  Run run;
  CHECK_NOTHROW(static_cast<void>(generate(
      run.context, settings_of(cubed + "require: {well_centred: true, keep: true}\n"), {})));
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
