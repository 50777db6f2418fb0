// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/restart.hpp"

#include <filesystem>
#include <fstream>
#include <functional>

#include "dual/digest.hpp"
#include "io/restart.hpp"
#include "lifecycle/component.hpp"
#include "lifecycle/settings_tree.hpp"
#include "lifecycle/version.hpp"
#include "support/expect_error.hpp"
#include "support/sample_times.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using delos::samples::at;
using delos::samples::lasting;
using delos::testing::expect_error;
using delos::testing::TemporaryFolder;

namespace {

constexpr const char* kConstant =
    "sizing: {sources: [{type: constant, spacing: 1500 km}]}\n"
    "refine: {tile_vertices: 500}\n";
/// A table in memory, on an ellipsoid.
constexpr const char* kVariable =
    "surface: {shape: wgs84}\n"
    "sizing:\n"
    "  resolution: 2 deg\n"
    "  sources:\n"
    "    - {type: disc, centre: [-40 deg, 35 deg], radius: 20 deg, spacing: 900 km, outside: 1500 "
    "km}\n"
    "refine: {tile_vertices: 500}\n";

/// A line and a point that stay.
constexpr const char* kCoastline =
    "constraints: {shapes: [{type: line, points: [170 deg, -20 deg, 150 deg, -60 deg]}, "
    "{type: points, points: [180 deg, 60 deg]}]}\n";

Settings settings_of(const std::string& yaml) {
  return read_settings(parse_config(yaml, "test.yaml"), ".");
}

Clock host_clock() {
  Clock clock({.start = at("2000-01-30", Calendar::noleap),
               .stop = at("2000-03-02", Calendar::noleap),
               .step = lasting("P5DT0:1/3S")});
  clock.add_alarm({.interval = lasting("P10D")});
  clock.add_alarm({.interval = lasting("P1M"), .sticky = false});
  return clock;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// A component and its host.
struct Run {
  Component component;
  Clock clock = host_clock();
  Run(const std::string& yaml, int threads)
      : component(settings_of(yaml), {.threads = threads, .on_progress = {}, .on_log = {}}) {
    component.advertise();
  }
  void step() {
    component.run(clock.current(), clock.next());
    clock.advance();
    if (clock.advance_count() % 3 == 0) clock.alarm(0).ringer_off();
  }
  void read(const std::string& path) { clock = component.read_restart(path, clock); }
  /// All that the report says but the times of its making.
  std::string report() const {
    Report report = component.product()->report;
    report.phases.clear();
    report.n_threads = 1;
    return report_json(report);
  }
};

void check_same(const Run& one, const Run& other) {
  const Product &mine = *one.component.product(), &theirs = *other.component.product();
  CHECK(digest(mine.mesh) == digest(theirs.mesh));
  CHECK(mine.mesh.fixed.offsets == theirs.mesh.fixed.offsets);
  CHECK(mine.mesh.fixed.ends == theirs.mesh.fixed.ends);
  parallel::Executor exec(1);
  CHECK(digest(exec, *mine.grid) == digest(exec, *theirs.grid));
  CHECK(mine.grid->edge_spacing_m == theirs.grid->edge_spacing_m);
  CHECK(one.report() == other.report());
  CHECK(one.clock.state() == other.clock.state());
  CHECK(one.component.stage() == other.component.stage());
  CHECK(one.component.generation() == other.component.generation());
  const auto area = one.component.exports()->item("cell_area");
  CHECK(area->time_stamp() == other.component.exports()->item("cell_area")->time_stamp());
}

/// From each step of a straight run another component, with other threads, goes on to the end; the
/// files that both write on the way are the same.
void check_restarts(const std::string& yaml) {
  const TemporaryFolder folder;
  const auto file = [&](const std::string& run, std::int64_t step) {
    return folder.file(run + std::to_string(step) + ".nc");
  };
  Run straight(yaml, 1);
  straight.component.realize();
  for (;; straight.step()) {
    straight.component.write_restart(file("straight", straight.clock.advance_count()),
                                     straight.clock);
    if (straight.clock.is_done()) break;
  }
  const std::int64_t n_steps = straight.clock.advance_count();
  REQUIRE(n_steps == 7);
  for (std::int64_t start = 0; start <= n_steps; ++start) {
    CAPTURE(start);
    Run again(yaml, start % 2 == 0 ? 2 : 5);
    again.read(file("straight", start));
    for (;; again.step()) {
      const std::int64_t step = again.clock.advance_count();
      again.component.write_restart(file("again", step), again.clock);
      CHECK(bytes_of(file("again", step)) == bytes_of(file("straight", step)));
      if (again.clock.is_done()) break;
    }
    check_same(again, straight);
  }
}

}  // namespace

TEST_CASE("a restart at any step with other threads is the straight run to the last bit") {
  check_restarts(kConstant);
  check_restarts(kVariable);
  check_restarts(std::string(kVariable) + "output: {spacing: true}\n");
  check_restarts(std::string(kConstant) + "output: {spacing: true}\n");
  check_restarts(std::string(kConstant) + "layers: {kind: z_level}\noutput: {partitions: [3]}\n");
  check_restarts(std::string(kConstant) + "layers: {kind: terrain_following}\n");
  check_restarts(std::string(kConstant) + kCoastline);
}

TEST_CASE("a component that was finalized restarts, and its generation is the file's") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.nc");
  Run run(kConstant, 1);
  for (int life = 1; life <= 3; ++life) {
    run.component.advertise();
    run.component.realize();
    CHECK(run.component.generation() == life);
    if (life == 2) run.component.write_restart(path, run.clock);
    run.component.finalize();
  }
  run.component.advertise();
  run.read(path);
  CHECK(run.component.generation() == 2);
  CHECK(run.component.exports()->item("grid_generation")->data()[0] == 2.0);
  CHECK(run.component.stage() == Stage::realized);
  run.component.finalize();
  run.component.advertise();
  run.component.realize();
  CHECK(run.component.generation() == 3);
}

TEST_CASE("a restart in a wrong order says which call is expected") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.nc");
  Run run(kConstant, 1);
  Component& component = run.component;
  const auto write = [&] { component.write_restart(path, run.clock); };
  const auto read = [&] { run.read(path); };
  expect_error(ErrorKind::state, {"write_restart", "advertised", "expected: initialize(realize)"},
               write);
  CHECK_FALSE(std::filesystem::exists(path));
  component.realize();
  write();
  expect_error(ErrorKind::state, {"read_restart", "realized", "expected: run or finalize"}, read);
  component.run(run.clock.current(), run.clock.next());
  expect_error(ErrorKind::state, {"2000-01-30", "ended at 2000-02-04", "advance the clock"}, write);
  expect_error(ErrorKind::state, {"read_restart", "running"}, read);
  component.finalize();
  expect_error(ErrorKind::state, {"finalized", "expected: initialize(advertise)"}, write);
  expect_error(ErrorKind::state, {"finalized", "expected: initialize(advertise)"}, read);
  Component fresh(settings_of(kConstant), {});
  expect_error(ErrorKind::state, {"created", "expected: initialize(advertise)"},
               [&] { fresh.write_restart(path, run.clock); });
  expect_error(ErrorKind::state, {"created", "expected: initialize(advertise)"},
               [&] { fresh.read_restart(path, run.clock); });
}

TEST_CASE("a restart file of another configuration is refused with the settings that differ") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.nc");
  Run run(kConstant, 1);
  run.component.realize();
  run.component.write_restart(path, run.clock);

  Run other("sizing: {sources: [{type: constant, spacing: 1400 km}]}\n", 1);
  const ClockState before = other.clock.state();
  std::string message;
  expect_error(ErrorKind::input,
               {path, "another configuration", "SHA-256",
                "sizing.sources.0.spacing is 1500 km there and 1400 km here",
                "refine.tile_vertices is 500 there"},
               [&] {
                 try {
                   other.read(path);
                 } catch (const Error& error) {
                   message = error.what();
                   throw;
                 }
               });
  CHECK(message.find("threads") == std::string::npos);
  CHECK(other.clock.state() == before);
  CHECK(other.component.stage() == Stage::advertised);
  CHECK(other.component.generation() == 0);
  other.component.realize();
  CHECK(other.component.generation() == 1);
}

TEST_CASE("a restart file that is damaged, of another version or of another calendar is refused") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.nc");
  Run run(kConstant, 1);
  run.component.realize();
  run.component.write_restart(path, run.clock);
  const std::string bytes = bytes_of(path);
  Run other(kConstant, 1);
  const auto refused = [&](ErrorKind kind, std::initializer_list<std::string> parts) {
    expect_error(kind, parts, [&] { other.read(path); });
    CHECK(other.component.stage() == Stage::advertised);
  };
  other.clock = Clock({.start = at("2000-01-01"), .step = lasting("P1D")});
  refused(ErrorKind::config, {path, "noleap", "gregorian"});
  other.clock = host_clock();

  std::ofstream(path, std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  refused(ErrorKind::input, {path, "truncated"});
  std::string changed = bytes;
  changed[bytes.size() / 2] ^= 4;
  std::ofstream(path, std::ios::binary) << changed;
  refused(ErrorKind::input, {path, "altered"});
  std::filesystem::remove(path);
  refused(ErrorKind::input, {"no restart file", path});
  const std::string words = "something";
  write_restart_arrays(path, "0.0.1",
                       std::vector<RestartArray>{{"words", "a text", std::string_view(words)}});
  refused(ErrorKind::input, {path, "delos 0.0.1", library_version()});
  std::ofstream(path, std::ios::binary) << bytes;
  other.read(path);
  check_same(other, run);
}

TEST_CASE("a restart can be stopped, and the component goes on as if it had not been asked") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.nc");
  Run run(kConstant, 1);
  run.component.realize();
  run.component.write_restart(path, run.clock);
  std::atomic<bool> cancel{true};
  Component other(settings_of(kConstant),
                  {.threads = 1, .on_progress = {}, .on_log = {}, .cancel = &cancel});
  other.advertise();
  expect_error(ErrorKind::cancelled, {}, [&] { other.read_restart(path, run.clock); });
  CHECK(other.stage() == Stage::advertised);
  cancel = false;
  other.read_restart(path, run.clock);
  CHECK(other.stage() == Stage::realized);
}
