// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/remesh.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "lifecycle/component.hpp"
#include "support/expect_error.hpp"
#include "support/sample_times.hpp"

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
  explicit Model(const std::string& more = "", int threads = 1) {
    ComponentOptions options;
    options.threads = threads;
    options.on_log = [this](LogLevel, const std::string& line) { log += line + "\n"; };
    component = std::make_unique<Component>(settings_of(more), options);
    component->advertise();
    component->realize();
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

constexpr double kStrong = 0.6;  // m/s: EKE 0.09 m2/s2 from variance 0.36 and 0, speed 0.6

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

TEST_CASE("a budget is met within a percent") {
  Model model("  cells: 1500\n");
  for (int day = 0; day < 10; ++day) model.run_day(day, kStrong);
  REQUIRE(model.component->generation() == 2);
  CHECK(static_cast<double>(model.component->product()->mesh.n_vertices()) ==
        doctest::Approx(1500.0).epsilon(0.01));
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
