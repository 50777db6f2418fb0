// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/remesh.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "support/expect_error.hpp"
#include "support/remesh_model.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using delos::samples::kStrong;
using delos::samples::remesh_settings;
using delos::testing::expect_error;
using Model = delos::samples::RemeshModel;

namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("a grid follows the eddies of its model at the alarm") {
  Model model;
  const std::int64_t before = model.component->product()->mesh.n_vertices();
  const auto area = model.component->exports()->item("cell_area");
  CHECK(model.exported("remesh_mismatch") == 0.0);
  for (int day = 0; day < 9; ++day) model.run_day(day, kStrong);
  CHECK(model.component->generation() == 1);
  CHECK_FALSE(model.component->decision());
  model.run_day(9, kStrong);

  REQUIRE(model.component->decision());
  const Decision& decision = *model.component->decision();
  CAPTURE(decision.text);
  CHECK(decision.remesh);
  CHECK(decision.mismatch.too_coarse > 0.4);
  CHECK(model.component->remesh_failure().empty());
  CHECK(model.component->generation() == 2);
  CHECK(model.exported("grid_generation") == 2.0);
  CHECK(model.exported("remesh_mismatch") == decision.mismatch.total());
  CHECK(model.exported("remesh_decision") == 1.0);
  CHECK(model.log.find("remesh at 2001-01-11T00:00:00") != std::string::npos);
  const Product& product = *model.component->product();
  CHECK(product.mesh.n_vertices() > 2 * before);
  CHECK(static_cast<double>(product.mesh.n_vertices()) ==
        doctest::Approx(decision.expected_cells).epsilon(0.05));
  // Old handles find out, imports are to be given again, exports are those of the new grid.
  expect_error(ErrorKind::state, {"generation 1", "generation 2"},
               [&] { area->check_generation(1); });
  CHECK(static_cast<std::int64_t>(area->data().size()) == product.grid->n_cells());
  CHECK_FALSE(model.component->imports()->item("surface_eastward_sea_water_velocity")->has_data());

  // The grid fits now: the next alarm decides against.
  for (int day = 10; day < 20; ++day) model.run_day(day, kStrong);
  CHECK(model.component->generation() == 2);
  CHECK_FALSE(model.component->decision()->remesh);
  CHECK(model.exported("remesh_decision") == 0.0);
}

TEST_CASE("a still model keeps its grid, and so does one that gives no values") {
  Model model;
  for (int day = 0; day < 10; ++day) model.run_day(day, 0.0);
  CHECK(model.component->decision()->reasons == std::vector<Reason>{Reason::below_threshold});
  Model silent;
  for (int day = 0; day < 10; ++day) silent.run_without_values(day);
  CHECK(silent.component->decision()->reasons == std::vector<Reason>{Reason::no_statistics});
  CHECK(silent.component->generation() == 1);
}

TEST_CASE("a remesh that fails leaves the grid and its fields, with the reason") {
  // The uniform grid is met by the clamp, a budget of a million cells is not.
  Model model("  cells: 1000000\n  threshold: 0\n");
  const std::string digest = model.component->product()->report.digest;
  for (int day = 0; day < 10; ++day) model.run_day(day, kStrong);
  CHECK(model.component->generation() == 1);
  CHECK(model.component->product()->report.digest == digest);
  CHECK(model.component->remesh_failure().find("the grid stays") != std::string::npos);
  CHECK(model.component->remesh_failure().find("budget") != std::string::npos);
  CHECK(model.exported("remesh_decision") == -1.0);
  CHECK(model.component->imports()->item("surface_eastward_sea_water_velocity")->has_data());
  model.run_day(10, kStrong);
}

TEST_CASE("a value that is no number stops a run before anything changes") {
  Model model;
  model.run_day(0, kStrong);
  model.u[17] = std::nan("");
  expect_error(ErrorKind::input,
               {"surface_eastward_sea_water_velocity", "nan", "cell 17", "lon", "lat"},
               [&] { model.run_without_values(1); });
  CHECK(model.component->clock()->current() == model.start + TimeInterval::of_days(1));
  model.run_day(1, kStrong);
}

TEST_CASE("a budget is met within 1 % whatever is kept") {
  // The uniform grid of the start has some 410 cells; half of it may stay where the budget lets the
  // still south keep a spacing within tau.
  const std::string fixed =
      "  fixed: [{type: box, west: 0 deg, east: 120 deg, south: -60 deg, north: 60 deg}]\n";
  struct Case {
    int cells;
    std::string more;
  };
  const std::vector<Case> cases = {{900, ""}, {1100, "  tau: 1.1\n"}, {1300, fixed}, {1500, ""}};
  for (const Case& one : cases) {
    CAPTURE(one.cells);
    CAPTURE(one.more);
    Model model(text("  cells: ", one.cells, "\n", one.more));
    for (int day = 0; day < 10; ++day) model.run_day(day, kStrong);
    CAPTURE(model.component->remesh_failure());
    CAPTURE(model.log);
    REQUIRE(model.component->generation() == 2);
    const auto n = static_cast<double>(model.component->product()->mesh.n_vertices());
    CHECK(std::abs(n - one.cells) <= 0.01 * one.cells);
    // The second remesh, of a graded grid that has moved, too.
    for (int day = 10; day < 20; ++day) model.run_day(day, 0.3);
    const auto again = static_cast<double>(model.component->product()->mesh.n_vertices());
    CHECK(std::abs(again - one.cells) <= 0.01 * one.cells);
  }
}

TEST_CASE("a polygon from a file stays, and is missed at the start when it is not there") {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.file("regions.geojson"))
      << R"({"type": "Feature", "properties": {"name": "box"}, "geometry": {"type": "Polygon",
           "coordinates": [[[0, 20], [60, 20], [60, 70], [0, 70], [0, 20]]]}})";
  const auto more = [&](const std::string& name) {
    return text("  fixed: [{type: polygon, file: ", folder.file(name), "}]\n");
  };
  Model model(more("regions.geojson"));
  const Grid before = *model.component->product()->grid;
  std::filesystem::remove(folder.file("regions.geojson"));  // it has been read
  for (int day = 0; day < 10; ++day) model.run_day(day, kStrong);
  REQUIRE(model.component->generation() == 2);
  const Grid& after = *model.component->product()->grid;
  int n_held = 0;
  for (std::size_t i = 0; i < before.cell_position.size(); ++i) {
    const double lon = before.cell_lon_lat[i].lon_rad * kDegPerRad;
    const double lat = before.cell_lon_lat[i].lat_rad * kDegPerRad;
    if (!(lon > 0.0 && lon < 60.0 && lat > 20.0 && lat < 70.0)) continue;
    ++n_held;
    CHECK(std::find(after.cell_position.begin(), after.cell_position.end(),
                    before.cell_position[i]) != after.cell_position.end());
  }
  CHECK(n_held > 10);
  expect_error(ErrorKind::input, {"remesh.fixed.0.file", "nowhere.geojson"},
               [&] { Model missing(more("nowhere.geojson")); });
}

TEST_CASE("whatever fails at a remesh leaves grid, fields and statistics") {
  struct Case {
    std::string more, reason;
  };
  // A certificate that the uniform grid has and the graded one misses; a fixed region that holds
  // about as many cells as the budget.
  Model free;
  const double before = free.component->product()->report.quality.grading_max.value;
  for (int day = 0; day < 10; ++day) free.run_day(day, kStrong);
  const double after = free.component->product()->report.quality.grading_max.value;
  REQUIRE(after > before);
  const std::vector<Case> cases = {
      {text("require: {grading_max: ", 0.5 * (before + after), "}\n"), "grading_max"},
      {"  cells: 215\n  threshold: 0\n"
       "  fixed: [{type: box, west: -180 deg, east: 180 deg, south: -90 deg, north: 0 deg}]\n",
       "fixed regions"}};
  for (const Case& one : cases) {
    CAPTURE(one.reason);
    Model model(one.more);
    const auto product = model.component->product();
    const auto area = model.component->exports()->item("cell_area");
    for (int day = 0; day < 10; ++day) model.run_day(day, kStrong);
    CAPTURE(model.component->remesh_failure());
    CHECK(model.component->remesh_failure().find(one.reason) != std::string::npos);
    CHECK(model.component->product() == product);
    CHECK(model.component->generation() == 1);
    CHECK(area->data().data() == product->grid->cell_area_m2.data());
    CHECK(model.exported("remesh_decision") == -1.0);
    model.run_day(10, kStrong);
  }
}

TEST_CASE("a request to stop leaves the grid, and the next alarm tries again") {
  std::atomic<bool> cancel = false;
  Model model(remesh_settings(), 1, "", &cancel);
  for (int day = 0; day < 9; ++day) model.run_day(day, kStrong);
  cancel = true;
  model.run_day(9, kStrong);
  CHECK(model.component->generation() == 1);
  CHECK_FALSE(model.component->remesh_failure().empty());
  cancel = false;
  for (int day = 10; day < 20; ++day) model.run_day(day, kStrong);
  CHECK(model.component->generation() == 2);
  CHECK(model.component->remesh_failure().empty());
}

TEST_CASE("the remeshed grid has the same bits for any number of threads") {
  std::string expected;
  for (const int threads : {1, 2, 5}) {
    Model model("", threads);
    for (int day = 0; day < 10; ++day) model.run_day(day, kStrong);
    const std::string digest = model.component->product()->report.digest;
    if (threads == 1) expected = digest;
    CHECK(digest == expected);
  }
}

TEST_CASE("a restart before or after a remesh goes on to the same bytes") {
  constexpr int kDays = 22;
  for (const char* const window :
       {"{window: exponential, length: 4 d}", "{window: fixed, length: 3 d}"}) {
    CAPTURE(std::string(window));
    const std::string more = text("  statistics: ", window, "\n");
    const testing::TemporaryFolder folder;
    const std::string end = folder.file("end.nc");
    Model straight(more);
    for (int day = 0; day < kDays; ++day) {
      if (day == 7 || day == 15) {
        straight.component->write_restart(folder.file(text(day, ".nc")), straight.clock(day));
      }
      straight.run_day(day, day < 12 ? kStrong : 0.02);
    }
    CHECK(straight.component->generation() == 3);
    straight.component->write_restart(end, straight.clock(kDays));
    for (const int begin : {7, 15}) {
      Model restarted(more, 2, folder.file(text(begin, ".nc")));
      CHECK(restarted.exported("remesh_decision") == (begin < 10 ? 0.0 : 1.0));
      for (int day = begin; day < kDays; ++day) {
        restarted.run_day(day, day < 12 ? kStrong : 0.02);
      }
      const std::string again = folder.file("again.nc");
      restarted.component->write_restart(again, restarted.clock(kDays));
      CHECK(bytes_of(again) == bytes_of(end));
    }
  }
}

TEST_CASE("fixed regions stay while the rest is made anew") {
  Model model("  fixed: [{type: disc, centre: [20 deg, 50 deg], radius: 20 deg}]\n");
  const Grid before = *model.component->product()->grid;
  for (int day = 0; day < 10; ++day) model.run_day(day, kStrong);
  REQUIRE(model.component->generation() == 2);
  const Grid& after = *model.component->product()->grid;
  parallel::Executor exec(1);
  const std::vector<FixedRegion> region{FixedDisc{20.0, 50.0, 20.0 * kRadPerDeg}};
  const auto held = in_fixed_regions(exec, region, before.cell_lon_lat);
  int n_held = 0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i] == 0) continue;
    ++n_held;
    const bool is_there = std::any_of(after.cell_position.begin(), after.cell_position.end(),
                                      [&](const Vec3& p) { return p == before.cell_position[i]; });
    CHECK(is_there);
  }
  CHECK(n_held > 3);
}
