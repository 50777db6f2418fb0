// SPDX-License-Identifier: BSD-3-Clause
// Run by mpiexec with 1, 2, 3 and 4 processes; every case is collective. The root also runs a
// delos::Component by itself: what the distributed one does must be that, bit for bit.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

#include "mpi_component_support.hpp"

using delos::InitializePhase;
using delos::Location;
using delos::mpi::DistributedComponent;
using delos::mpi::DistributedGrid;
using namespace mpi_support;

namespace {

/// Waves in the northern hemisphere: at the second day's end the grid is made anew.
constexpr char kConfig[] = R"(
sizing: {sources: [{type: constant, spacing: 1200 km}], gradient_limit: 0.3, resolution: 4 deg,
         clamp: {min: 300 km, max: 2000 km}}
refine: {tile_vertices: 500}
remesh:
  interval: P2D
  sources: [{type: eke, quiet: [0.05 m/s, 1200 km], energetic: [0.5 m/s, 500 km]}]
)";
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

delos::Config config() { return delos::Config::from_text(kConfig); }

std::string path_of(const std::string& name) {
  return "mpi_component." + std::to_string(n_ranks()) + "." + name + ".nc";
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Some of the processes: the first n.
class Group {
 public:
  explicit Group(int n) {
    MPI_Comm_split(MPI_COMM_WORLD, rank() < n ? 0 : MPI_UNDEFINED, 0, &communicator_);
  }
  ~Group() {
    if (is_in()) MPI_Comm_free(&communicator_);
  }
  Group(const Group&) = delete;
  Group& operator=(const Group&) = delete;
  bool is_in() const { return communicator_ != MPI_COMM_NULL; }
  MPI_Comm get() const { return communicator_; }

 private:
  MPI_Comm communicator_ = MPI_COMM_NULL;
};

}  // namespace

TEST_CASE("on any number of processes a component is the serial one, bit for bit") {
  for (const int root : {0, n_ranks() - 1}) {
    const bool is_root = rank() == root;
    std::optional<delos::Component> serial;
    if (is_root) serial.emplace(config(), delos::GenerateOptions{.threads = 2});
    DistributedComponent component(MPI_COMM_WORLD, config, options(root));
    CHECK(component.exports().empty());
    component.initialize(InitializePhase::advertise);
    if (serial) serial->initialize();
    REQUIRE(component.exports().size() == 7);
    CHECK(component.exports()[0].units == "m2");
    CHECK(component.exports()[2].standard_name == "longitude");
    CHECK(component.imports()[0].name == kEast);
    CHECK(component.generation() == 0);
    component.initialize(InitializePhase::realize);
    component.initialize();  // repeated, it does nothing
    CHECK(component.generation() == 1);
    CHECK_FALSE(component.current_time());
    compare_exports(component, serial ? &*serial : nullptr);

    CHECK_FALSE(run_day(component, 0));
    if (serial) run_day(*serial, 0);
    CHECK(component.current_time()->text() == "2001-01-02T00:00:00");
    CHECK(component.remesh_decision().empty());
    // At the alarm all have parts of the new grid.
    std::vector<double> before(component.grid().local().cell_lon_lat().begin(),
                               component.grid().local().cell_lon_lat().end());
    CHECK(run_day(component, 1));
    if (serial) run_day(*serial, 1);
    CHECK(component.generation() == 2);
    CHECK(component.remesh_decision().find("remesh at 2001-01-03") != std::string::npos);
    CHECK(is_same_everywhere(component.remesh_decision()));
    CHECK(component.remesh_failure().empty());
    CHECK(component.get_export("remesh_decision")[0] == 1.0);
    CHECK(component.get_export("remesh_mismatch")[0] > 0.0);
    compare_exports(component, serial ? &*serial : nullptr);
    CHECK(component.grid().local().n_local(Location::cell) * 2 !=
          static_cast<std::int64_t>(before.size()));

    for (int day = 2; day < 4; ++day) {
      run_day(component, day);
      if (serial) run_day(*serial, day);
    }
    compare_exports(component, serial ? &*serial : nullptr);
    // What the statistics and the policy remember is in the file, byte for byte.
    component.write_restart(path_of("distributed"), clock_at(4));
    if (serial) {
      serial->write_restart(path_of("serial"), clock_at(4));
      CHECK(bytes_of(path_of("distributed")).size() > 1000);
      CHECK(bytes_of(path_of("distributed")) == bytes_of(path_of("serial")));
      std::filesystem::remove(path_of("distributed"));
      std::filesystem::remove(path_of("serial"));
    }
    component.finalize();
    CHECK(component.generation() == 0);
    component.initialize();
    CHECK(component.generation() == 3);
  }
}

TEST_CASE("fields of the host move to the new grid as those of one process do") {
  std::optional<delos::Component> serial;
  if (rank() == 0) {
    serial.emplace(config(), delos::GenerateOptions{.threads = 1});
    serial->initialize();
  }
  DistributedComponent component(MPI_COMM_WORLD, config, options());
  component.initialize();
  run_day(component, 0);
  CHECK(begins(thrown([&] { static_cast<void>(component.transfer({})); }),
               "state: transfer was called, but the last run made no new grid"));
  const DistributedGrid old = component.grid();
  auto tracer = filled(old.local().cell_position(), 2);
  const auto velocity = filled(old.local().edge_position(), 1);
  // Values of the halo do not count.
  for (auto i = static_cast<std::size_t>(2 * old.local().n_owned(Location::cell));
       i < tracer.size(); ++i) {
    tracer[i] = kNan;
  }
  REQUIRE(run_day(component, 1));
  const auto moved = component.transfer(tracer, {.n_levels = 2});
  const auto moved_velocity = component.transfer_velocity(velocity);
  CHECK(static_cast<std::int64_t>(moved.size()) ==
        2 * component.grid().local().n_local(Location::cell));
  const auto whole = component.grid().gather(moved, Location::cell, 2);
  const auto whole_velocity = component.grid().gather(moved_velocity, Location::edge);
  if (serial) {
    const delos::Grid before = serial->grid();
    run_day(*serial, 0);
    run_day(*serial, 1);
    const delos::Transfer transfer(before, serial->grid());
    std::vector<double> expected(whole.size()), expected_velocity(whole_velocity.size());
    transfer.apply(filled(before.cell_position(), 2), expected, {.n_levels = 2});
    transfer.apply_velocity(filled(before.edge_position(), 1), expected_velocity);
    CHECK(same_bits(whole, expected));
    CHECK(same_bits(whole_velocity, expected_velocity));
  }
  auto halo = moved;
  component.grid().exchange(std::span(halo), Location::cell, 2);
  CHECK(same_bits(halo, moved));
  // One process's mistake is everybody's.
  auto wrong = tracer;
  if (rank() == n_ranks() - 1) wrong.pop_back();
  const auto refused =
      thrown([&] { static_cast<void>(component.transfer(wrong, {.n_levels = 2})); });
  CHECK(begins(refused, "input: the field has "));
  CHECK(is_same_everywhere(refused));
  run_day(component, 2);
  CHECK(begins(thrown([&] { static_cast<void>(component.transfer(tracer)); }), "state: "));
}

TEST_CASE("a restart goes on with another number of processes, bit for bit") {
  std::optional<delos::Component> serial;
  if (rank() == 0) {
    serial.emplace(config(), delos::GenerateOptions{.threads = 1});
    serial->initialize();
    for (int day = 0; day < 4; ++day) run_day(*serial, day);
  }
  // All write before the alarm, one fewer read and write after it, and all read that.
  const std::string first = path_of("first"), second = path_of("second");
  {
    DistributedComponent component(MPI_COMM_WORLD, config, options());
    component.initialize();
    run_day(component, 0);
    delos::Clock clock = clock_at(1);
    clock.add_alarm({.interval = delos::TimeInterval::of_days(3)});
    component.write_restart(first, clock);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  const auto go_on = [&](MPI_Comm communicator, int root, const std::string& from, int day) {
    DistributedComponent component(communicator, config, options(root));
    component.initialize(InitializePhase::advertise);
    delos::Clock clock = clock_at(0);
    const std::string path = component.whole_imports() ? from : "";
    component.read_restart(path, clock);
    CHECK(clock.n_alarms() == 1);
    CHECK(clock.alarm(0).ring_time().text() == "2001-01-05T00:00:00");
    CHECK(clock.current() == clock_at(day).current());
    CHECK(component.current_time() == clock.current());
    CHECK(run_day(component, day) == (day == 1));
    clock.advance();
    component.write_restart(second, clock);
    return component;
  };
  if (const Group fewer(std::max(1, n_ranks() - 1)); fewer.is_in()) {
    static_cast<void>(go_on(fewer.get(), 0, first, 1));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  DistributedComponent last = go_on(MPI_COMM_WORLD, n_ranks() - 1, second, 2);
  run_day(last, 3);
  CHECK(last.generation() == 2);
  const std::string digest = last.grid().digest();
  CHECK(is_same_everywhere(digest));
  last.write_restart(second, clock_at(4));
  MPI_Barrier(MPI_COMM_WORLD);
  if (serial) {
    CHECK(digest == serial->grid().digest());
    serial->write_restart(first, clock_at(4));
    CHECK(bytes_of(first) == bytes_of(second));
    std::filesystem::remove(first);
    std::filesystem::remove(second);
  }
}

TEST_CASE("a call in the wrong order is refused by all, and changes nothing") {
  DistributedComponent component(MPI_COMM_WORLD, config, options());
  const auto refused = [&](const std::string& beginning, const std::function<void()>& action) {
    CAPTURE(beginning);
    const std::string found = thrown(action);
    CHECK_MESSAGE(begins(found, beginning), found);
    CHECK(is_same_everywhere(found));
  };
  delos::Clock clock = clock_at(0);
  refused("state: run was called on a component that is created", [&] { component.run(clock); });
  refused("state: initialize(realize) was called on a component that is created",
          [&] { component.initialize(InitializePhase::realize); });
  refused("state: read_restart was called on a component that is created",
          [&] { component.read_restart("x.nc", clock); });
  refused("state: finalize was called on a component that is created",
          [&] { component.finalize(); });
  refused("state: the import state has no field", [&] { component.set_import(kEast, {}); });
  component.initialize(InitializePhase::advertise);
  refused("state: write_restart was called on a component that is advertised",
          [&] { component.write_restart(path_of("x"), clock); });
  refused("state: grid was called", [&] { static_cast<void>(component.grid()); });
  refused("state: export field cell_area has no grid",
          [&] { static_cast<void>(component.get_export("cell_area")); });
  component.initialize(InitializePhase::realize);
  refused("state: initialize(advertise) was called on a component that is realized",
          [&] { component.initialize(InitializePhase::advertise); });
  refused("state: the export state has no field \"x\"; it has cell_area",
          [&] { static_cast<void>(component.get_export("x")); });
  run_day(component, 0);
  refused("state: run from 2001-01-01T00:00:00", [&] { component.run(clock); });
  refused("state: initialize(realize) was called on a component that is running",
          [&] { component.initialize(InitializePhase::realize); });
  if (n_ranks() > 1) {
    refused("state: the processes called run and finalize at the same time", [&] {
      rank() == 0 ? static_cast<void>(component.run(clock_at(1))) : component.finalize();
    });
  }
  CHECK_FALSE(component.run(clock_at(1)));  // imports of one day are no statistics yet: no remesh
  component.finalize();
  refused("state: run was called on a component that is finalized",
          [&] { component.run(clock_at(2)); });
}

TEST_CASE("what goes wrong on one process is thrown by all") {
  const int last = n_ranks() - 1;
  const auto all_throw = [&](const std::string& beginning, const std::function<void()>& action) {
    CAPTURE(beginning);
    const std::string found = thrown(action);
    CHECK_MESSAGE(begins(found, beginning), found);
    CHECK(is_same_everywhere(found));
  };
  all_throw("input: the configuration /nowhere.yaml can't be opened", [] {
    DistributedComponent(
        MPI_COMM_WORLD, [] { return delos::Config::from_file("/nowhere.yaml"); }, options());
  });
  all_throw("config: root = -1", [] { DistributedComponent(MPI_COMM_WORLD, config, options(-1)); });
  DistributedComponent component(MPI_COMM_WORLD, config, options());
  component.initialize();
  give_imports(component, 0);
  const auto n_owned = static_cast<std::size_t>(component.grid().local().n_owned(Location::cell));
  if (rank() == last) component.set_import(kEast, std::vector<double>(n_owned + 1, 0.0));
  all_throw(
      "input: import field " + std::string(kEast) + ": process " + std::to_string(last) + " gave ",
      [&] { component.run(clock_at(0)); });
  std::vector<double> east(n_owned, 0.0);
  if (rank() == last) east[0] = kNan;
  component.set_import(kEast, east);
  all_throw("input: ", [&] { component.run(clock_at(0)); });
  if (n_ranks() > 1) {
    if (rank() == last) component.set_import(kEast, std::vector<double>(n_owned, 0.0));
    all_throw("input: import field " + std::string(kEast) + " was given on some processes only",
              [&] { component.run(clock_at(0)); });
    all_throw("state: the clocks of the processes", [&] { component.run(clock_at(rank())); });
  }
  all_throw("output: ", [&] { component.write_restart("/nowhere/x.nc", clock_at(0)); });
  CHECK_FALSE(run_day(component, 0));
  component.finalize();
  component.initialize(InitializePhase::advertise);
  delos::Clock clock = clock_at(3);
  all_throw("input: ", [&] { component.read_restart("/nowhere/x.nc", clock); });
  CHECK(clock.current() == clock_at(3).current());
  component.initialize(InitializePhase::realize);
  CHECK(component.generation() == 2);
}

TEST_CASE("processes sleep while the root makes its grids") {
  delos::mpi::Options how = options();
  bool has_slept = false;
  how.generate.progress = [&](const delos::Progress&) {
    if (std::exchange(has_slept, true)) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  };
  DistributedComponent component(MPI_COMM_WORLD, config, how);
  const auto used_s = [&](const std::function<void()>& action) {
    has_slept = false;
    const std::clock_t before = std::clock();
    action();
    return static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  };
  const double to_start_s = used_s([&] { component.initialize(); });
  run_day(component, 0);
  const double to_remesh_s = used_s([&] { CHECK(run_day(component, 1)); });
  if (rank() == 0) {
    CHECK(has_slept);
    return;
  }
  CHECK(to_start_s < 0.3);
  CHECK(to_remesh_s < 0.3);
}

TEST_CASE("imports on a grid of the host's are given on the root") {
  DistributedComponent component(MPI_COMM_WORLD, config, options());
  component.initialize();
  if (const auto imports = component.whole_imports()) {
    CHECK(rank() == 0);
    for (const char* const name : {kEast, kNorth}) {
      delos::Field field = imports->field(name);
      field.place_on_lat_lon({0.0, 120.0, 240.0}, {-80.0, 0.0, 80.0});
      field.store(std::vector<double>(9, 0.25));
    }
  }
  CHECK_FALSE(component.run(clock_at(0)));
  CHECK_FALSE(component.run(clock_at(1)));
  // Steady: no eddies.
  CHECK(component.get_export("remesh_decision")[0] == 0.0);
  CHECK(component.remesh_decision().find("2001-01-03") != std::string::npos);
}

int main(int argc, char** argv) {
  int level = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  const int failed = doctest::Context(argc, argv).run();
  MPI_Finalize();
  return failed;
}
