// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/remesh.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "lifecycle/component.hpp"
#include "support/expect_error.hpp"
#include "support/sample_times.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using delos::samples::at;
using delos::testing::expect_error;

namespace {

/// Waves in the northern hemisphere: the south has no eddies.
constexpr char kConfig[] = R"(
sizing: {sources: [{type: constant, spacing: 1200 km}], gradient_limit: 0.3, resolution: 4 deg,
         clamp: {min: 300 km, max: 2000 km}}
refine: {tile_vertices: 500}
remesh:
  interval: P10D
  sources: [{type: eke, quiet: [0.05 m/s, 1200 km], energetic: [0.5 m/s, 500 km]}]
)";

Settings settings_of(const std::string& more = "") {
  return read_settings(parse_config(kConfig + more, "remesh.yaml"), ".");
}

/// A component with its host: imports are values in the cells.
class Model {
 public:
  explicit Model(const std::string& more = "", int threads = 1, const std::string& restart = "") {
    ComponentOptions options;
    options.threads = threads;
    options.on_log = [this](LogLevel, const std::string& line) { log += line + "\n"; };
    component = std::make_unique<Component>(settings_of(more), options);
    component->advertise();
    restart.empty() ? component->realize()
                    : static_cast<void>(component->read_restart(restart, clock(0)));
  }

  /// The host's clock after so many days.
  Clock clock(int days) const {
    Clock out({.start = start, .step = TimeInterval::of_days(1)});
    for (int day = 0; day < days; ++day) out.advance();
    return out;
  }

  /// A day of eastward velocity +-`amplitude`, northward none.
  void run_day(int day, double amplitude) {
    const Array<Vec3>& places = component->product()->grid->cell_position;
    u.assign(places.size(), 0.0);
    v.assign(places.size(), 0.0);
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double sign = day % 2 == 0 ? 1.0 : -1.0;
      u[i] = places[i].z() > 0.0 ? sign * amplitude : 0.0;
    }
    component->imports()->item("surface_eastward_sea_water_velocity")->bind(u);
    component->imports()->item("surface_northward_sea_water_velocity")->bind(v);
    run_without_values(day);
  }

  void run_without_values(int day) {
    component->run(start + TimeInterval::of_days(day), start + TimeInterval::of_days(day + 1));
  }

  double exported(const std::string& name) const {
    return component->exports()->item(name)->data()[0];
  }

  std::unique_ptr<Component> component;
  std::vector<double> u, v;
  Time start = at("2001-01-01");
  std::string log;
};

constexpr double kStrong = 0.6;  // m/s: variances 0.36 and 0, EKE 0.18 m2/s2, speed 0.6 again

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

TEST_CASE("a budget is met as well as what is kept allows") {
  Model model("  cells: 1500\n");
  for (int day = 0; day < 10; ++day) model.run_day(day, kStrong);
  REQUIRE(model.component->generation() == 2);
  CHECK(static_cast<double>(model.component->product()->mesh.n_vertices()) ==
        doctest::Approx(1500.0).epsilon(0.02));
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
