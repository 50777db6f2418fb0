// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/component.hpp"

#include <functional>
#include <numeric>

#include "lifecycle/settings_tree.hpp"
#include "support/expect_error.hpp"
#include "support/sample_times.hpp"

using namespace delos;
using delos::samples::at;
using delos::samples::lasting;
using delos::testing::expect_error;

namespace {

Settings small() {
  return read_settings(parse_config("sizing: {sources: [{type: constant, spacing: 1500 km}]}\n"
                                    "refine: {tile_vertices: 500}\n",
                                    "small.yaml"),
                       ".");
}

/// A component in any stage, by its calls.
std::unique_ptr<Component> in_stage(Stage stage) {
  auto component = std::make_unique<Component>(small(), ComponentOptions{});
  if (stage == Stage::created) return component;
  component->advertise();
  if (stage == Stage::advertised) return component;
  component->realize();
  if (stage == Stage::running) component->run(at("2000-01-01"), at("2000-01-02"));
  if (stage == Stage::finalized) component->finalize();
  return component;
}

using Call = std::function<void(Component&)>;

const Call kAdvertise = [](Component& component) { component.advertise(); };
const Call kRealize = [](Component& component) { component.realize(); };
const Call kRun = [](Component& component) { component.run(at("2000-01-02"), at("2000-01-03")); };
const Call kFinalize = [](Component& component) { component.finalize(); };
const Call kProduct = [](Component& component) { static_cast<void>(component.product()); };

}  // namespace

TEST_CASE("every call in a wrong order says which one is expected, and changes nothing") {
  struct Wrong {
    Stage stage;
    const Call& call;
    const char* name;
    const char* expected;
  };
  const std::vector<Wrong> all = {
      {Stage::created, kRealize, "initialize(realize)", "initialize(advertise)"},
      {Stage::created, kRun, "run", "initialize(advertise)"},
      {Stage::created, kFinalize, "finalize", "initialize(advertise)"},
      {Stage::created, kProduct, "grid", "initialize(advertise)"},
      {Stage::advertised, kRun, "run", "initialize(realize)"},
      {Stage::advertised, kProduct, "grid", "initialize(realize)"},
      {Stage::realized, kAdvertise, "initialize(advertise)", "run or finalize"},
      {Stage::running, kAdvertise, "initialize(advertise)", "run or finalize"},
      {Stage::running, kRealize, "initialize(realize)", "run or finalize"},
      {Stage::finalized, kRealize, "initialize(realize)", "initialize(advertise)"},
      {Stage::finalized, kRun, "run", "initialize(advertise)"},
      {Stage::finalized, kProduct, "grid", "initialize(advertise)"},
  };
  for (const Wrong& wrong : all) {
    const auto component = in_stage(wrong.stage);
    CAPTURE(wrong.name);
    const std::int64_t generation = component->generation();
    expect_error(ErrorKind::state,
                 {std::string(wrong.name) + " was called", to_string(wrong.stage),
                  std::string("expected: ") + wrong.expected},
                 [&] { wrong.call(*component); });
    CHECK(component->stage() == wrong.stage);
    CHECK(component->generation() == generation);
  }
}

TEST_CASE("a phase that is done does nothing when it is called again") {
  const auto component = in_stage(Stage::created);
  component->advertise();
  const auto items = component->exports()->items();
  component->advertise();
  CHECK(component->exports()->items() == items);
  component->realize();
  const auto product = component->product();
  component->realize();
  CHECK(component->product() == product);
  CHECK(component->generation() == 1);
  component->finalize();
  component->finalize();
  CHECK(component->stage() == Stage::finalized);
}

TEST_CASE("advertise declares fields without values, realize gives the exports theirs") {
  const auto component = in_stage(Stage::created);
  CHECK(component->imports()->items().empty());
  component->advertise();
  const State& exports = *component->exports();
  for (const char* const name : {"cell_area", "cell_spacing", "cell_longitude", "cell_latitude",
                                 "grid_generation", "longitude", "latitude"}) {
    CAPTURE(name);
    CHECK_FALSE(exports.item(name)->has_data());
  }
  component->realize();
  const auto product = component->product();
  const auto n_cells = static_cast<std::size_t>(product->grid->n_cells());
  const auto area_m2 = exports.item("cell_area")->data();
  CHECK(area_m2.data() == product->grid->cell_area_m2.data());
  CHECK(std::accumulate(area_m2.begin(), area_m2.end(), 0.0) ==
        doctest::Approx(4.0 * kPi * 6371220.0 * 6371220.0).epsilon(1e-12));
  CHECK(exports.item("cell_spacing")->data()[0] == doctest::Approx(1500e3));
  CHECK(exports.item("grid_generation")->data()[0] == 1.0);
  const auto lon_deg = exports.item("longitude")->data();
  const auto lat_deg = exports.item("latitude")->data();
  REQUIRE(lon_deg.size() == n_cells);
  REQUIRE(lat_deg.size() == n_cells);
  for (std::size_t i = 0; i < n_cells; ++i) {
    REQUIRE(lon_deg[i] >= 0.0);
    REQUIRE(lon_deg[i] < 360.0);
    REQUIRE(lat_deg[i] * kRadPerDeg ==
            doctest::Approx(product->grid->cell_lon_lat[i].lat_rad).epsilon(1e-14));
  }
  for (const char* const name : {"surface_eastward_sea_water_velocity",
                                 "surface_northward_sea_water_velocity", "eddy_kinetic_energy"}) {
    CAPTURE(name);
    CHECK(component->imports()->item(name)->n_points() == static_cast<std::int64_t>(n_cells));
    CHECK_FALSE(component->imports()->item(name)->has_data());
  }
}

TEST_CASE("imports on a lat-lon grid are held from advertise to finalize") {
  const auto component = in_stage(Stage::advertised);
  const auto energy = component->imports()->item("eddy_kinetic_energy");
  energy->place_on({{0.0, 180.0}, {-45.0, 45.0}});
  const std::vector<double> values(4, 0.02);
  energy->bind(values);
  component->realize();
  component->run(at("2000-01-01"), at("2000-01-02"));
  CHECK(energy->data().data() == values.data());
  component->finalize();
  CHECK_FALSE(energy->has_data());
}

TEST_CASE("run moves the clock and stamps the exports") {
  const auto component = in_stage(Stage::realized);
  CHECK_FALSE(component->clock());
  const auto area = component->exports()->item("cell_area");
  CHECK_FALSE(area->time_stamp());
  component->run(at("2000-01-31"), at("2000-02-29"));
  CHECK(component->clock()->start() == at("2000-01-31"));
  CHECK(component->clock()->current() == at("2000-02-29"));
  CHECK(*area->time_stamp() == at("2000-02-29"));
  component->run(at("2000-02-29"), at("2000-02-29T00:00:00:1/3"));
  CHECK(*area->time_stamp() == at("2000-02-29T00:00:00:1/3"));
  CHECK(component->clock()->advance_count() == 2);
}

TEST_CASE("steps that are repeated, left out or backward are refused") {
  const auto component = in_stage(Stage::running);  // 2000-01-01 to 2000-01-02
  const auto refused = [&](const Time& from, const Time& until,
                           std::initializer_list<std::string> parts) {
    expect_error(ErrorKind::state, parts, [&] { component->run(from, until); });
    CHECK(component->clock()->current() == at("2000-01-02"));
    CHECK(*component->exports()->item("cell_area")->time_stamp() == at("2000-01-02"));
  };
  refused(at("2000-01-01"), at("2000-01-02"), {"2000-01-01", "stands at 2000-01-02", "once"});
  refused(at("2000-01-03"), at("2000-01-04"), {"2000-01-03", "stands at 2000-01-02"});
  refused(at("2000-01-02"), at("2000-01-02"), {"must be later"});
  refused(at("2000-01-02", Calendar::noleap), at("2000-01-03", Calendar::noleap),
          {"noleap", "gregorian"});
}

TEST_CASE("a component starts again after finalize with the next generation and a new clock") {
  const auto component = in_stage(Stage::running);
  const std::string digest = component->product()->report.digest;
  const auto area = component->exports()->item("cell_area");
  component->finalize();
  CHECK(component->generation() == 0);
  CHECK_FALSE(component->clock());
  expect_error(ErrorKind::state, {"generation 1", "finalized"}, [&] { area->check_generation(1); });
  component->advertise();
  component->realize();
  CHECK(component->generation() == 2);
  CHECK(component->product()->report.digest == digest);
  CHECK(component->exports()->item("grid_generation")->data()[0] == 2.0);
  CHECK(component->exports()->item("cell_area") == area);
  expect_error(ErrorKind::state, {"generation 1", "generation 2"},
               [&] { area->check_generation(1); });
  component->run(at("1999-01-01"), at("1999-01-02"));
}

TEST_CASE("realize that fails or is stopped leaves an advertised component that can go on") {
  std::atomic<bool> cancel{true};
  bool is_angry = false;
  struct HostError {};
  Component component(small(), {.threads = 1,
                                .on_progress =
                                    [&](const Progress&) {
                                      if (is_angry) throw HostError();
                                    },
                                .on_log = {},
                                .cancel = &cancel});
  component.advertise();
  CHECK_THROWS_AS(component.realize(), Error);
  cancel = false;
  is_angry = true;
  CHECK_THROWS_AS(component.realize(), HostError);
  CHECK(component.stage() == Stage::advertised);
  CHECK(component.generation() == 0);
  CHECK_FALSE(component.exports()->item("cell_area")->has_data());
  is_angry = false;
  component.realize();
  CHECK(component.generation() == 1);
}

TEST_CASE("fields that outlive their component have lost their values") {
  auto component = in_stage(Stage::realized);
  const auto area = component->exports()->item("cell_area");
  component.reset();
  CHECK_FALSE(area->has_data());
  expect_error(ErrorKind::state, {"generation 1"}, [&] { area->check_generation(1); });
}
