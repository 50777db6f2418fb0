// SPDX-License-Identifier: BSD-3-Clause
// Hosts of the component, well behaved and not.
#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <delos/delos.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "component_support.hpp"
#include "support/temporary_folder.hpp"

using namespace hosts;

namespace {

// The stages of a component's life, and who may be called in which.
enum Stage { created, advertised, realized, running, finalized, n_stages };

/// A component with what its host has of it, brought to a stage.
struct Host {
  Host(Stage stage, std::string restart_file)
      : component(uniform("1500 km"), {.threads = 1}), path(std::move(restart_file)) {
    if (stage == created) return;
    component.initialize(delos::InitializePhase::advertise);
    if (stage >= realized) component.initialize(delos::InitializePhase::realize);
    if (stage >= running) run();
    if (stage == finalized) component.finalize();
  }
  void run() {
    component.run(component.import_state(), component.export_state(), clock);
    clock.advance();
  }
  delos::Component component;
  delos::Clock clock = daily();
  std::string path;
};

struct Call {
  const char* name;
  std::function<void(Host&)> action;
  std::array<bool, n_stages> is_allowed;
};

const std::array kCalls = {
    Call{"initialize(advertise)",
         [](Host& host) { host.component.initialize(delos::InitializePhase::advertise); },
         {true, true, false, false, true}},
    Call{"initialize(realize)",
         [](Host& host) { host.component.initialize(delos::InitializePhase::realize); },
         {false, true, true, false, false}},
    Call{"initialize",
         [](Host& host) { host.component.initialize(); },
         {true, true, true, false, true}},
    Call{"run", [](Host& host) { host.run(); }, {false, false, true, true, false}},
    Call{
        "finalize", [](Host& host) { host.component.finalize(); }, {false, true, true, true, true}},
    Call{"grid",
         [](Host& host) { static_cast<void>(host.component.grid()); },
         {false, false, true, true, false}},
    Call{"write_restart",
         [](Host& host) { host.component.write_restart(host.path + ".new", host.clock); },
         {false, false, true, true, false}},
    Call{"read_restart",
         [](Host& host) { host.component.read_restart(host.path, host.clock); },
         {false, true, false, false, false}},
};

}  // namespace

TEST_CASE("a component lives through its phases and its grid is that of generate") {
  const auto config = uniform("600 km");
  delos::Component component(config);
  CHECK(component.export_state().size() == 0);
  component.initialize(delos::InitializePhase::advertise);
  CHECK(component.export_state().names() ==
        std::vector<std::string>{"cell_area", "cell_spacing", "cell_longitude", "cell_latitude",
                                 "grid_generation"});
  CHECK(component.generation() == 0);
  component.initialize(delos::InitializePhase::realize);
  CHECK(component.generation() == 1);
  const delos::Grid grid = component.grid();
  CHECK(grid.digest() == delos::generate(config).digest());
  const delos::Field area = component.export_state().field("cell_area");
  CHECK(area.data().data() == grid.cell_area_m2().data());
  CHECK(area.units() == "m2");
  CHECK(area.location() == delos::Location::cell);
  CHECK(std::string(delos::to_string(area.location())) == "cell");
  CHECK(area.n_points() == grid.n_cells());

  auto clock = daily();
  CHECK_FALSE(component.current_time());
  run_all(component, clock);
  CHECK(clock.advance_count() == 4);
  CHECK(component.current_time()->text() == "2000-03-02T00:00:00");
  CHECK(*area.time_stamp() == clock.current());
  component.finalize();
  CHECK(grid.cell_area_m2().size() == static_cast<std::size_t>(grid.n_cells()));
}

TEST_CASE("every call in a wrong order is Error(state) that says what is expected") {
  const auto clock = daily();
  delos::Component component(uniform("1500 km"));
  const delos::State imports = component.import_state();
  const delos::State exports = component.export_state();
  const auto advertise = [&] { component.initialize(delos::InitializePhase::advertise); };
  const auto realize = [&] { component.initialize(delos::InitializePhase::realize); };
  const auto run = [&] { component.run(imports, exports, clock); };
  const auto finalize = [&] { component.finalize(); };
  const auto grid = [&] { static_cast<void>(component.grid()); };

  for (const auto& call : std::vector<std::function<void()>>{realize, run, finalize, grid}) {
    refused(call, {"created", "expected: initialize(advertise)"});
  }
  advertise();
  for (const auto& call : std::vector<std::function<void()>>{run, grid}) {
    refused(call, {"advertised", "expected: initialize(realize)"});
  }
  realize();
  refused(advertise, {"realized", "expected: run or finalize"});
  component.initialize();
  run();
  refused(run, {"stands at 2000-02-28", "once"});
  refused(advertise, {"running", "expected: run or finalize"});
  refused(realize, {"running", "expected: run or finalize"});
  refused([&] { component.initialize(); }, {"running", "run or finalize"});
  finalize();
  finalize();
  for (const auto& call : std::vector<std::function<void()>>{realize, run, grid}) {
    refused(call, {"finalized", "expected: initialize(advertise)"});
  }
}

TEST_CASE("every call in every stage does its work, or is refused and changes nothing") {
  const delos::testing::TemporaryFolder folder;
  const std::string path = folder.file("a.nc");
  {
    const Host host(realized, path);
    host.component.write_restart(path, host.clock);
  }
  for (int stage = 0; stage < n_stages; ++stage) {
    for (const Call& call : kCalls) {
      CAPTURE(stage);
      CAPTURE(call.name);
      Host host(static_cast<Stage>(stage), path);
      const std::int64_t generation = host.component.generation();
      if (call.is_allowed[static_cast<std::size_t>(stage)]) {
        CHECK_NOTHROW(call.action(host));
        continue;
      }
      refused([&] { call.action(host); }, {"was called on a component that is", "expected: "});
      CHECK(host.component.generation() == generation);
      // And it goes on as if it had not been asked.
      if (generation == 0) host.component.initialize();
      CHECK_NOTHROW(host.run());
    }
  }
}

TEST_CASE("a driver that knows phases by number alone runs a component") {
  const delos::testing::TemporaryFolder folder;
  std::vector<delos::EntryPoint> table;
  const auto set = [&](delos::EntryPoint entry) { table.push_back(std::move(entry)); };
  delos::set_services(set);
  CHECK(table.size() == 4);
  table.clear();
  std::string asked_at;
  delos::set_services(set, [&](const delos::Clock& clock) {
    asked_at = clock.current().text();
    return folder.file("a.nc");
  });
  std::vector<std::string> labels;
  labels.reserve(table.size());
  for (const delos::EntryPoint& entry : table) {
    labels.push_back(delos::to_string(entry.method) + std::to_string(entry.phase) + entry.label);
  }
  CHECK(labels == std::vector<std::string>{"initialize1advertise", "initialize2realize", "run1run",
                                           "finalize1finalize", "write_restart1write_restart",
                                           "read_restart1read_restart"});
  CHECK(static_cast<int>(delos::Method::read_restart) == 5);  // ESMF_METHOD_READRESTART

  delos::Component component(uniform("1500 km"));
  delos::Component other(uniform("1500 km"));
  auto clock = daily();
  const auto call = [&](delos::Component& of, delos::Method method, int phase) {
    for (const delos::EntryPoint& entry : table) {
      if (entry.method != method || entry.phase != phase) continue;
      entry.call(of, of.import_state(), of.export_state(), clock);
    }
  };
  refused([&] { call(component, delos::Method::run, 1); }, {"expected: initialize(advertise)"});
  call(component, delos::Method::initialize, 1);
  call(component, delos::Method::initialize, 2);
  for (; clock.advance_count() < 2; clock.advance()) call(component, delos::Method::run, 1);
  call(component, delos::Method::write_restart, 1);
  CHECK(asked_at == "2000-02-29T00:00:00");
  const std::string digest = component.grid().digest();
  call(component, delos::Method::finalize, 1);
  CHECK(component.generation() == 0);
  call(other, delos::Method::initialize, 1);
  call(other, delos::Method::read_restart, 1);
  CHECK(other.grid().digest() == digest);
  CHECK(other.current_time() == clock.current());
}

TEST_CASE("run takes the component's own states, the right way round") {
  delos::Component component(uniform("1500 km"));
  delos::Component other(uniform("1500 km"));
  component.initialize();
  const auto clock = daily();
  refused([&] { component.run(component.export_state(), component.import_state(), clock); },
          {"import state", "intent export"});
  refused([&] { component.run(component.import_state(), other.export_state(), clock); },
          {"export state", "own export_state()"});
  CHECK_FALSE(component.current_time());
}

TEST_CASE("fields of an older generation fail and name both generations") {
  delos::Component component(uniform("1500 km"));
  component.initialize(delos::InitializePhase::advertise);
  const delos::Field early = component.export_state().field("cell_area");
  component.initialize();
  refused([&] { static_cast<void>(early.data()); }, {"cell_area", "generation 0", "generation 1"});
  const delos::Field area = component.export_state().field("cell_area");
  delos::Field energy = component.import_state().field("eddy_kinetic_energy");
  const std::vector<double> values(static_cast<std::size_t>(area.n_points()), 0.01);
  energy.bind(values);
  const delos::Grid grid = component.grid();
  component.finalize();
  CHECK_FALSE(area.has_data());
  refused([&] { static_cast<void>(area.data()); }, {"generation 1", "generation 0", "finalized"});
  component.initialize();
  CHECK(component.generation() == 2);
  CHECK(component.grid().generation() == 2);
  CHECK(grid.generation() == 1);
  CHECK(component.grid().digest() == grid.digest());
  CHECK_FALSE(area.has_data());
  refused([&] { static_cast<void>(area.data()); }, {"generation 1", "generation 2"});
  refused([&] { energy.bind(values); }, {"eddy_kinetic_energy", "generation 1", "generation 2"});
  refused([&] { energy.store(values); }, {"generation 1", "generation 2"});
  refused([&] { energy.stamp(delos::Time::parse("2000-01-01")); }, {"generation 1"});
  CHECK(component.export_state().field("cell_area").data().size() == values.size());
}

TEST_CASE("fields outlive their component without values") {
  std::optional<delos::Component> component(uniform("1500 km"));
  component->initialize();
  const delos::Field area = component->export_state().field("cell_area");
  const delos::State exports = component->export_state();
  component.reset();
  refused([&] { static_cast<void>(area.data()); }, {"generation 1"});
  refused([&] { static_cast<void>(exports.field("cell_area").data()); }, {"no grid"});
}

TEST_CASE("imports are the host's own memory, or a copy, on cells or on a lat-lon grid") {
  delos::Component component(uniform("1500 km"));
  component.initialize();
  const delos::State imports = component.import_state();
  delos::Field u = imports.field("surface_eastward_sea_water_velocity");
  CHECK(u.units() == "m s-1");
  std::vector<double> values(static_cast<std::size_t>(u.n_points()), 0.1);
  u.bind(values);
  CHECK(u.data().data() == values.data());
  u.store(values);
  CHECK(u.data().data() != values.data());
  u.stamp(delos::Time::parse("2000-01-01"));
  CHECK(u.is_updated());
  delos::Field energy = imports.field("eddy_kinetic_energy");
  energy.place_on_lat_lon({0.0, 90.0, 180.0, 270.0}, {-60.0, 0.0, 60.0});
  CHECK(energy.n_points() == 12);
  values.resize(12);
  energy.bind(values);
  CHECK(energy.has_data());
  CHECK(energy.location() == delos::Location::lat_lon);
  delos::Field area = component.export_state().field("cell_area");
  refused([&] { area.bind(area.data()); }, {"cell_area", "only imports"});
  refused([&] { area.stamp(delos::Time::parse("2000-01-01")); }, {"belongs to the component"});
  CHECK_THROWS_AS(u.bind(values), delos::Error);
}

TEST_CASE("a component goes on from its restart file with its clock, alarms and grid") {
  const delos::testing::TemporaryFolder folder;
  const std::string path = folder.file("a.nc");
  const auto config = uniform("900 km");
  delos::Component first(config, {.threads = 1});
  first.initialize();
  auto clock = daily();
  clock.add_alarm({.interval = delos::TimeInterval::of_days(2)});
  refused([&] { delos::Component(config).write_restart(path, clock); }, {"write_restart"});
  for (int step = 0; step < 2; ++step, clock.advance()) {
    first.run(first.import_state(), first.export_state(), clock);
  }
  first.write_restart(path, clock);
  first.finalize();

  delos::Component second(config, {.threads = 2});
  delos::Clock again({.start = delos::Time::parse("1990-01-01"),
                      .stop = {},
                      .step = delos::TimeInterval::of_hours(1)});
  const delos::Alarm alarm = again.add_alarm({.interval = delos::TimeInterval::of_hours(1)});
  const delos::Alarm lost = again.add_alarm({.interval = delos::TimeInterval::of_hours(2)});
  refused([&] { second.read_restart(path, again); }, {"read_restart", "created"});
  second.initialize(delos::InitializePhase::advertise);
  second.read_restart(path, again);
  CHECK(again.current() == clock.current());
  CHECK(again.step() == clock.step());
  CHECK(alarm.is_ringing());
  refused([&] { static_cast<void>(lost.is_ringing()); }, {"no alarm 1"});
  CHECK(second.current_time()->text() == "2000-02-29T00:00:00");
  CHECK(*second.export_state().field("cell_area").time_stamp() == again.current());
  CHECK(second.grid().digest() == delos::generate(config).digest());
  run_all(second, again);
  CHECK(again.advance_count() == 4);

  delos::Component other(uniform("800 km"));
  other.initialize(delos::InitializePhase::advertise);
  try {
    other.read_restart(path, again);
    FAIL("a restart file of another configuration was taken");
  } catch (const delos::Error& error) {
    CHECK(error.kind() == delos::ErrorKind::input);
    CHECK(std::string(error.what()).find("900 km there and 800 km here") != std::string::npos);
  }
  CHECK(again.current().text() == "2000-03-02T00:00:00");
}

TEST_CASE("absent items are listed, and ESMF's codes are ESMF's") {
  delos::Component component(uniform("1500 km"));
  CHECK_FALSE(component.import_state().contains("eddy_kinetic_energy"));
  refused([&] { static_cast<void>(component.import_state().field("eddy_kinetic_energy")); },
          {"empty", "initialize(advertise)"});
  component.initialize(delos::InitializePhase::advertise);
  CHECK(component.import_state().contains("eddy_kinetic_energy"));
  CHECK(component.export_state().contains("longitude"));
  refused([&] { static_cast<void>(component.export_state().field("salt")); },
          {"\"salt\"", "cell_area, cell_spacing"});
  CHECK(delos::kEsmfNotFound == 41);
  CHECK(delos::esmf_code(delos::ErrorKind::state) == 42);
  CHECK(delos::esmf_code(delos::ErrorKind::config) == 9);
  CHECK(delos::esmf_code(delos::ErrorKind::resource) == 30);
  for (int kind = 0; kind <= static_cast<int>(delos::ErrorKind::internal); ++kind) {
    CHECK(delos::esmf_code(static_cast<delos::ErrorKind>(kind)) != delos::kEsmfSuccess);
  }
}

TEST_CASE("a mistake in the configuration is found before the first phase") {
  try {
    const delos::Component component(uniform("-5 km"));
    FAIL("a negative spacing was taken");
  } catch (const delos::Error& error) {
    CHECK(error.kind() == delos::ErrorKind::config);
  }
}

TEST_CASE("a stopped realize leaves the component advertised, and it can go on") {
  std::atomic<bool> cancel{true};
  delos::Component component(uniform("600 km"), {.cancel = &cancel});
  CHECK_THROWS_AS(component.initialize(), delos::Error);
  CHECK(component.generation() == 0);
  cancel = false;
  component.initialize(delos::InitializePhase::realize);
  CHECK(component.generation() == 1);
  delos::Component moved(std::move(component));
  CHECK(moved.grid().n_cells() > 1000);
}

TEST_CASE("clocks, alarms, times and intervals of the host are exact") {
  const auto noleap = delos::parse_calendar("365_day");
  CHECK(noleap == delos::Calendar::noleap);
  CHECK(std::string(delos::to_string(delos::Calendar::day360)) == "360_day");
  const auto start = delos::Time::parse("2000-01-31");
  CHECK((start + delos::TimeInterval::of_months(1)).text() == "2000-02-29T00:00:00");
  const auto third = delos::TimeInterval::of_seconds(0, 1, 3);
  CHECK(third * 3 == delos::TimeInterval::of_seconds(1));
  CHECK(third < delos::TimeInterval::of_seconds(1));
  CHECK((start + third - start) == third);
  CHECK((-third).text() == delos::TimeInterval::parse((-third).text()).text());
  CHECK(delos::Time::of({.year = 2001, .month = 3, .day = 1}, noleap).day_of_year() == 60);
  CHECK(start.date_time() == delos::DateTime{.year = 2000, .month = 1, .day = 31});
  CHECK(start < delos::Time::parse("2000-01-31T00:00:00.5"));
  CHECK_THROWS_AS(static_cast<void>(start < delos::Time::parse("2000-01-31", noleap)),
                  delos::Error);
  CHECK_THROWS_AS(delos::Time::parse("2001-02-29"), delos::Error);

  auto clock = daily();
  delos::Alarm alarm = clock.add_alarm({.interval = delos::TimeInterval::of_days(2)});
  const delos::Clock copy = clock;
  clock.advance();
  CHECK_FALSE(alarm.is_ringing());
  clock.advance();
  CHECK(alarm.is_ringing());
  CHECK(clock.ringing_alarms() == std::vector<int>{0});
  CHECK_FALSE(copy.alarm(0).is_ringing());
  alarm.ringer_off();
  CHECK_FALSE(clock.alarm(0).is_ringing());
  CHECK(alarm.ring_time().text() == "2000-03-02T00:00:00");
  alarm.disable();
  refused([&] { alarm.ringer_on(); }, {"alarm"});
  refused([&] { static_cast<void>(clock.alarm(3)); }, {"3"});
  CHECK_THROWS_AS(delos::Clock({.start = start, .stop = {}, .step = {}}), delos::Error);
}
