// SPDX-License-Identifier: BSD-3-Clause
#include "time/state.hpp"

#include <functional>
#include <type_traits>

#include "support/expect_error.hpp"
#include "support/sample_times.hpp"
#include "time/clock.hpp"

using namespace delos;
using delos::samples::at;
using delos::samples::lasting;
using delos::testing::expect_error;

// Fit to be written as they are.
static_assert(std::is_trivially_copyable_v<AlarmState> && std::is_standard_layout_v<AlarmState>);
static_assert(sizeof(AlarmState) == (2 * 3 + 2 * 4 + 6) * sizeof(std::int64_t));

namespace {

Clock busy_clock() {
  Clock clock({.start = at("2000-01-01", Calendar::noleap),
               .stop = at("2000-01-03", Calendar::noleap),
               .step = lasting("PT20M0:1/3S")});
  clock.add_alarm({.interval = lasting("PT1H")});
  clock.add_alarm(
      {.interval = lasting("PT2H"), .sticky = false, .ring_duration = lasting("PT50M")});
  clock.add_alarm({.ring_time = at("2000-01-01T07:00:00.5", Calendar::noleap), .enabled = false});
  clock.add_alarm({.interval = lasting("P1M"), .sticky = false});
  return clock;
}

// What a host does between steps, from the clock's state alone.
void act(Clock& clock) {
  if (clock.advance_count() % 5 == 0) clock.alarm(0).ringer_off();
  if (clock.advance_count() == 7) clock.alarm(2).enable();
  if (clock.advance_count() == 30) clock.alarm(1).disable();
  if (clock.advance_count() == 33) clock.alarm(3).ringer_on(clock.current());
}

}  // namespace

TEST_CASE("a clock restored in the middle goes on as the first one") {
  constexpr int kSteps = 60;
  Clock straight = busy_clock();
  for (int stop = 0; stop < kSteps; ++stop) {
    Clock restored = Clock::restored(straight.state());
    CHECK(restored.state() == straight.state());
    CHECK(clock_state_of(integers_of(straight.state())) == straight.state());
    Clock other = straight;
    for (int step = stop; step < kSteps; ++step) {
      act(restored);
      act(other);
      restored.advance();
      other.advance();
      REQUIRE(restored.state() == other.state());
      REQUIRE(restored.ringing_alarms() == other.ringing_alarms());
    }
    act(straight);
    straight.advance();
  }
}

TEST_CASE("a clock past its stop, or without one, is restored too") {
  Clock clock({.start = at("2000-01-01"), .stop = at("2000-01-02"), .step = lasting("P1M")});
  clock.advance();
  CHECK(Clock::restored(clock.state()).is_done());
  clock.set_stop({});
  CHECK(clock.state().stop == clock.state().start);
  CHECK_FALSE(Clock::restored(clock.state()).stop().has_value());
}

TEST_CASE("the integers of a state mean what their comments say") {
  Clock clock({.start = at("0000-01-02T00:00:01", Calendar::day360), .step = lasting("P1MT0.5S")});
  clock.add_alarm({.interval = lasting("PT0:1/3S")});
  const ClockState state = clock.state();
  CHECK(state.calendar == 3);
  CHECK(state.start == TimeState{86401, 0, 1});
  CHECK(state.current == state.start);
  CHECK(state.has_stop == 0);
  CHECK(state.step == IntervalState{1, 0, 1, 2});
  CHECK(state.advance_count == 0);
  REQUIRE(state.alarms.size() == 1);
  CHECK(state.alarms[0].ring_time == TimeState{86401, 1, 3});
  CHECK(state.alarms[0].interval == IntervalState{0, 0, 1, 3});
  CHECK(state.alarms[0].sticky == 1);
  CHECK(state.alarms[0].enabled == 1);
  CHECK(state.alarms[0].ringing == 0);
}

TEST_CASE("a damaged state is refused with what is wrong") {
  const auto refused = [](std::initializer_list<std::string> parts,
                          const std::function<void(ClockState&)>& damage) {
    Clock clock = busy_clock();
    for (int step = 0; step < 4; ++step) clock.advance();
    ClockState state = clock.state();
    damage(state);
    expect_error(ErrorKind::input, parts, [&] { Clock::restored(state); });
  };
  refused({"calendar 4", "0 to 3"}, [](ClockState& state) { state.calendar = 4; });
  refused({"calendar -1"}, [](ClockState& state) { state.calendar = -1; });
  refused({"has_stop = 2"}, [](ClockState& state) { state.has_stop = 2; });
  refused({"fraction 1/0"}, [](ClockState& state) { state.start = {0, 1, 0}; });
  refused({"fraction 2/4"}, [](ClockState& state) { state.step = {0, 1, 2, 4}; });
  refused({"fraction 3/2"},
          [](ClockState& state) { state.current.numerator = 3, state.current.denominator = 2; });
  refused({"fraction -1/2"}, [](ClockState& state) { state.previous = {0, -1, 2}; });
  refused({"years"}, [](ClockState& state) { state.current.seconds = INT64_MAX; });
  refused({"contradicts itself"}, [](ClockState& state) { state.advance_count = 0; });
  refused({"contradicts itself"}, [](ClockState& state) { state.advance_count = -1; });
  refused({"contradicts itself"}, [](ClockState& state) { state.previous = state.current; });
  refused({"contradicts itself"}, [](ClockState& state) { state.start.seconds += 100000; });
  refused({"contradicts itself"}, [](ClockState& state) { state.step = {0, 0, 0, 1}; });
  refused({"contradicts itself"}, [](ClockState& state) { state.stop = state.start; });
  refused({"contradicts itself"}, [](ClockState& state) { state.has_stop = 0; });
  const std::string alarm = "an alarm in the restart";
  refused({"enabled = -1"}, [](ClockState& state) { state.alarms[1].enabled = -1; });
  refused({"rang = 7"}, [](ClockState& state) { state.alarms[1].rang = 7; });
  refused({alarm}, [](ClockState& state) { state.alarms[0].enabled = 0; });
  refused({alarm}, [](ClockState& state) { state.alarms[0].ring_time = state.current; });
  refused({alarm}, [](ClockState& state) { state.alarms[0].interval.months = -1; });
  refused({alarm}, [](ClockState& state) { state.alarms[1].sticky = 1; });
  refused({alarm}, [](ClockState& state) { state.alarms[1].ring_duration.seconds = -1; });
  refused({alarm}, [](ClockState& state) { state.alarms[1].n_steps_ringing = -1; });
}

TEST_CASE("a number of integers that no clock has is refused") {
  std::vector<std::int64_t> integers = integers_of(busy_clock().state());
  integers.pop_back();
  expect_error(ErrorKind::input, {"integers", "damaged"}, [&] { clock_state_of(integers); });
  expect_error(ErrorKind::input, {"has 0 integers"}, [&] { clock_state_of({}); });
}
