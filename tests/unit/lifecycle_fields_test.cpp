// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/fields.hpp"

#include <array>
#include <limits>

#include "support/expect_error.hpp"
#include "support/sample_times.hpp"

using namespace delos;
using delos::samples::at;
using delos::testing::expect_error;

namespace {

FieldTraits speed(const char* name = "speed") {
  return {.name = name, .standard_name = "speed_of_water", .units = "m s-1", .long_name = "speed"};
}

Field import_of(std::int64_t n_cells) {
  Field field(speed(), Intent::imports);
  field.attach({.generation = 3, .n_points = n_cells, .values = {}, .owner = nullptr});
  return field;
}

const LatLonAxes kAxes{{0.0, 120.0, 240.0}, {45.0, -45.0}};

}  // namespace

TEST_CASE("items of a state are found by name, else by standard name, in order") {
  State state(Intent::imports);
  state.declare(speed());
  state.declare({.name = "depth", .standard_name = "", .units = "m", .long_name = "depth"});
  CHECK(state.items().size() == 2);
  CHECK(state.items()[1]->traits().name == "depth");
  CHECK(state.find("speed") == state.items()[0]);
  CHECK(state.find("speed_of_water") == state.items()[0]);
  CHECK(state.find("") == nullptr);
  CHECK(state.find("salt") == nullptr);
  CHECK(state.item("depth")->intent() == Intent::imports);
}

TEST_CASE("an absent item is an error that lists what there is") {
  State state(Intent::exports);
  expect_error(ErrorKind::state, {"export state", "\"salt\"", "empty", "initialize(advertise)"},
               [&] { static_cast<void>(state.item("salt")); });
  state.declare(speed());
  state.declare(speed("other"));
  expect_error(ErrorKind::state, {"\"salt\"", "speed, other"},
               [&] { static_cast<void>(state.item("salt")); });
  expect_error(ErrorKind::state, {"several fields", "speed_of_water", "ask by name"},
               [&] { static_cast<void>(state.item("speed_of_water")); });
  CHECK(state.item("other")->traits().name == "other");
}

TEST_CASE("a name is found before the standard name of an earlier item") {
  State state(Intent::imports);
  state.declare(speed());
  state.declare({.name = "speed_of_water", .standard_name = "", .units = "1", .long_name = ""});
  CHECK(state.item("speed_of_water") == state.items()[1]);
}

TEST_CASE("declarations without name, units or components, and names taken, are refused") {
  State state(Intent::imports);
  state.declare(speed());
  expect_error(ErrorKind::config, {"already", "speed"}, [&] { state.declare(speed()); });
  expect_error(ErrorKind::config, {"no name"}, [&] { state.declare(speed("")); });
  FieldTraits wrong = speed("a");
  wrong.units = "";
  expect_error(ErrorKind::config, {"field a", "no units"}, [&] { state.declare(wrong); });
  wrong = speed("a");
  wrong.n_components = 0;
  expect_error(ErrorKind::config, {"field a", "0 components"}, [&] { state.declare(wrong); });
  CHECK(state.items().size() == 1);
}

TEST_CASE("bound values are the host's own, stored ones a copy") {
  Field field = import_of(3);
  CHECK_FALSE(field.has_data());
  std::array<double, 3> values{1.0, 2.0, 3.0};
  field.bind(values);
  CHECK(field.data().data() == values.data());
  values[1] = 7.0;
  CHECK(field.data()[1] == 7.0);
  field.store(values);
  values[1] = 9.0;
  CHECK(field.data().data() != values.data());
  CHECK(field.data()[1] == 7.0);
  // From its own storage, too.
  field.store(field.data());
  CHECK(field.data()[2] == 3.0);
}

TEST_CASE("values of another size, null, or without a place are refused and change nothing") {
  std::array<double, 4> values{};
  Field early(speed(), Intent::imports);
  expect_error(ErrorKind::state, {"import field speed", "no place yet", "initialize(realize)"},
               [&] { early.bind(values); });
  expect_error(ErrorKind::state, {"no grid", "initialize(realize)"},
               [&] { static_cast<void>(early.data()); });
  Field field = import_of(3);
  expect_error(ErrorKind::state, {"no values", "bind or store 3 x 1"},
               [&] { static_cast<void>(field.data()); });
  const std::span<const double> all(values);
  field.bind(all.first(3));
  expect_error(ErrorKind::input, {"got 4 values", "needs 3 x 1", "cell", "generation 3"},
               [&] { field.store(all); });
  expect_error(ErrorKind::input, {"got 0 values"}, [&] { field.bind({}); });
  CHECK(field.data().data() == values.data());
}

TEST_CASE("exports take neither values nor a place") {
  Field field(speed(), Intent::exports);
  const std::array<double, 2> values{1.0, 2.0};
  field.attach({.generation = 1, .n_points = 2, .values = values, .owner = nullptr});
  CHECK(field.data().data() == values.data());
  CHECK(field.is_updated());
  expect_error(ErrorKind::state, {"export field speed", "only imports"},
               [&] { field.bind(values); });
  expect_error(ErrorKind::state, {"only imports"}, [&] { field.store(values); });
  expect_error(ErrorKind::state, {"only imports"}, [&] { field.place_on(kAxes); });
}

TEST_CASE("an import on a lat-lon grid needs no grid and outlives one") {
  Field field(speed(), Intent::imports);
  field.place_on(kAxes);
  CHECK(field.n_points() == 6);
  CHECK(field.traits().location == Location::lat_lon);
  const std::array<double, 6> values{1, 2, 3, 4, 5, 6};
  field.bind(values);
  field.attach({.generation = 1, .n_points = 42, .values = {}, .owner = nullptr});
  CHECK(field.data().size() == 6);
  CHECK(field.generation() == 0);
  field.check_generation(0);
  field.check_generation(5);
  field.release();
  CHECK(field.traits().location == Location::cell);
  CHECK_FALSE(field.has_data());
}

TEST_CASE("axes that are none are refused") {
  Field field = import_of(3);
  const auto refused = [&](const LatLonAxes& axes, std::initializer_list<std::string> parts) {
    expect_error(ErrorKind::input, parts, [&] { field.place_on(axes); });
  };
  refused({{0.0}, {0.0, 1.0}}, {"lon_deg has 1"});
  refused({{0.0, 1.0}, {}}, {"lat_deg has 0"});
  refused({{0.0, 2.0, 1.0}, {0.0, 1.0}}, {"lon_deg", "strictly"});
  refused({{0.0, 1.0}, {0.0, 0.0}}, {"lat_deg", "strictly"});
  refused({{0.0, std::numeric_limits<double>::quiet_NaN()}, {0.0, 1.0}}, {"lon_deg", "finite"});
  refused({{0.0, 360.0}, {0.0, 1.0}}, {"360", "one turn"});
  refused({{0.0, 1.0}, {0.0, 91.0}}, {"91", "[-90, 90]"});
  CHECK(field.traits().location == Location::cell);
  CHECK(field.n_points() == 3);
}

TEST_CASE("a stale handle is told both generations") {
  Field field = import_of(3);
  field.check_generation(3);
  field.attach({.generation = 4, .n_points = 5, .values = {}, .owner = nullptr});
  expect_error(ErrorKind::state, {"generation 3", "generation 4", "take the field"},
               [&] { field.check_generation(3); });
  expect_error(ErrorKind::state, {"generation 0", "generation 4"},
               [&] { field.check_generation(0); });
  field.release();
  expect_error(ErrorKind::state, {"generation 4", "generation 0", "finalized"},
               [&] { field.check_generation(4); });
}

TEST_CASE("a stamp marks values as new, a new grid takes it away") {
  Field field = import_of(3);
  CHECK_FALSE(field.is_updated());
  field.stamp(at("2000-02-29T06:30:00"));
  CHECK(field.is_updated());
  CHECK(*field.time_stamp() == at("2000-02-29T06:30:00"));
  field.attach({.generation = 4, .n_points = 5, .values = {}, .owner = nullptr});
  CHECK_FALSE(field.is_updated());
  CHECK_FALSE(field.time_stamp());
}
