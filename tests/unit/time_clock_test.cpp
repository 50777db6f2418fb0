// SPDX-License-Identifier: BSD-3-Clause
#include "time/clock.hpp"

#include "support/expect_error.hpp"
#include "support/sample_times.hpp"

using namespace delos;
using delos::samples::at;
using delos::samples::lasting;
using delos::testing::expect_error;

namespace {

Clock hourly() {
  return Clock(
      {.start = at("2000-01-01"), .stop = at("2000-01-01T06:30"), .step = lasting("PT1H")});
}

}  // namespace

TEST_CASE("a clock goes in steps from start and is done from stop on") {
  Clock clock = hourly();
  CHECK(clock.current() == clock.start());
  CHECK(clock.previous() == clock.start());
  CHECK(clock.next() == at("2000-01-01T01:00"));
  CHECK(clock.next(lasting("P1D")) == at("2000-01-02"));
  CHECK(clock.advance_count() == 0);
  for (int step = 1; step <= 9; ++step) {
    CHECK(clock.is_done() == (step > 7));
    clock.advance();
    CHECK(clock.advance_count() == step);
    CHECK(clock.current() - clock.previous() == lasting("PT1H"));
  }
  CHECK(clock.current() == at("2000-01-01T09:00"));
  CHECK(clock.is_done());
}

TEST_CASE("stop is reached when current equals it, and a clock without stop is never done") {
  Clock clock({.start = at("2000-01-01"), .stop = at("2000-01-02"), .step = lasting("PT12H")});
  clock.advance();
  CHECK_FALSE(clock.is_done());
  clock.advance();
  CHECK(clock.is_done());
  clock.set_stop({});
  CHECK_FALSE(clock.is_done());
  clock.set_stop(at("2000-01-02"));
  CHECK(clock.is_done());
}

TEST_CASE("steps may be months, fractions of a second, and of another length for once") {
  Clock clock({.start = at("2000-01-31"), .step = lasting("P1M")});
  clock.advance();
  CHECK(clock.current() == at("2000-02-29"));
  clock.advance();
  // From the clipped day, not from the start.
  CHECK(clock.current() == at("2000-03-29"));
  clock.advance(lasting("PT0:1/3S"));
  CHECK(clock.current() == at("2000-03-29T00:00:00:1/3"));
  CHECK(clock.previous() == at("2000-03-29"));
  CHECK(clock.step() == lasting("P1M"));
  clock.set_step(lasting("PT0:2/3S"));
  clock.advance();
  CHECK(clock.current() == at("2000-03-29T00:00:01"));
}

TEST_CASE("copies of a clock go on alone") {
  Clock clock = hourly();
  const int id = clock.add_alarm({.interval = lasting("PT1H")});
  Clock copy = clock;
  copy.advance();
  CHECK(copy.alarm(id).is_ringing());
  CHECK_FALSE(clock.alarm(id).is_ringing());
  CHECK(clock.advance_count() == 0);
}

TEST_CASE("steps that do not lead forward are refused with their length") {
  for (const char* const step : {"PT0S", "-PT1H", "P1M-1D", "-P1M"}) {
    CAPTURE(step);
    const std::initializer_list<std::string> parts = {iso_text(lasting(step)), "longer than zero"};
    expect_error(ErrorKind::config, parts,
                 [&] { Clock({.start = at("2000-01-01"), .step = lasting(step)}); });
    Clock clock = hourly();
    expect_error(ErrorKind::config, parts, [&] { clock.advance(lasting(step)); });
    expect_error(ErrorKind::config, parts, [&] { clock.set_step(lasting(step)); });
    CHECK(clock.state() == hourly().state());
  }
}

TEST_CASE("a stop that is not later or of another calendar is refused") {
  const auto with_stop = [](const Time& stop) {
    return Clock({.start = at("2000-01-01"), .stop = stop, .step = lasting("PT1H")});
  };
  expect_error(ErrorKind::config, {"1999-01-01", "2000-01-01", "must be later"},
               [&] { with_stop(at("1999-01-01")); });
  expect_error(ErrorKind::config, {"must be later"}, [&] { with_stop(at("2000-01-01")); });
  expect_error(ErrorKind::config, {"gregorian", "noleap"},
               [&] { with_stop(at("2001-01-01", Calendar::noleap)); });
  Clock clock = hourly();
  clock.advance();
  expect_error(ErrorKind::config, {"2000-01-01T00:30:00", "stands at 2000-01-01T01:00:00"},
               [&] { clock.set_stop(at("2000-01-01T00:30")); });
  CHECK(*clock.stop() == at("2000-01-01T06:30"));
}

TEST_CASE("a step out of the range of years changes nothing") {
  Clock clock({.start = at("+999999999-12-30"), .step = lasting("P1D")});
  // Its next ring time would be out of range.
  const int id = clock.add_alarm({.ring_time = at("+999999999-12-31"), .interval = lasting("P1M")});
  const ClockState before = clock.state();
  expect_error(ErrorKind::config, {"1000000000"}, [&] { clock.advance(); });
  CHECK(clock.state() == before);
  clock.alarm(id).disable();
  expect_error(ErrorKind::config, {"999999999"}, [&] { clock.advance(lasting("P2D")); });
  CHECK(clock.current() == at("+999999999-12-30"));
}

TEST_CASE("unknown alarms are refused") {
  Clock clock = hourly();
  expect_error(ErrorKind::state, {"no alarm 0"}, [&] { clock.alarm(0); });
  CHECK(clock.add_alarm({.interval = lasting("PT1H")}) == 0);
  CHECK(clock.add_alarm({.interval = lasting("PT1H")}) == 1);
  CHECK(clock.n_alarms() == 2);
  expect_error(ErrorKind::state, {"no alarm 2", "0 to 1"}, [&] { clock.alarm(2); });
  expect_error(ErrorKind::state, {"no alarm -1"}, [&] { clock.will_ring_next(-1); });
}
