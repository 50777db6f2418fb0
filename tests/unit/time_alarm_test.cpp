// SPDX-License-Identifier: BSD-3-Clause
#include "time/alarm.hpp"

#include "support/expect_error.hpp"
#include "support/sample_times.hpp"
#include "time/clock.hpp"

using namespace delos;
using delos::samples::at;
using delos::samples::lasting;
using delos::testing::expect_error;

namespace {

Clock hourly() { return Clock({.start = at("2000-01-01"), .step = lasting("PT1H")}); }

// One letter for each step from the clock's current one on: R when the alarm rings after it.
std::string rings(Clock& clock, int id, int n_steps) {
  std::string result;
  for (int step = 0; step < n_steps; ++step) {
    if (step > 0) clock.advance();
    result += clock.alarm(id).is_ringing() ? 'R' : '.';
  }
  return result;
}

std::string rings_of(const AlarmOptions& options, int n_steps = 8) {
  Clock clock = hourly();
  const int id = clock.add_alarm(options);
  return rings(clock, id, n_steps);
}

}  // namespace

TEST_CASE("an alarm with an interval and no ring time rings first at start and interval") {
  CHECK(rings_of({.interval = lasting("PT3H"), .sticky = false}) == "...R..R.");
}

TEST_CASE("a sticky alarm rings until it is switched off, and again at the next ring time") {
  CHECK(rings_of({.interval = lasting("PT3H")}) == "...RRRRR");
  Clock clock = hourly();
  const int id = clock.add_alarm({.interval = lasting("PT3H")});
  CHECK(rings(clock, id, 6) == "...RRR");
  clock.alarm(id).ringer_off();
  CHECK_FALSE(clock.alarm(id).is_ringing());
  CHECK(clock.alarm(id).ring_time() == at("2000-01-01T06:00"));
  CHECK(rings(clock, id, 4) == ".RRR");
}

TEST_CASE("an alarm rings at the first step that reaches its ring time") {
  CHECK(rings_of({.ring_time = at("2000-01-01T01:30"), .sticky = false}) == "..R.....");
  CHECK(rings_of({.ring_time = at("2000-01-01T01:30")}) == "..RRRRRR");
  CHECK(rings_of({.ring_time = at("2000-01-01T01:30"),
                  .interval = lasting("PT2H30M"),
                  .sticky = false}) == "..R.R..R");
  CHECK(rings_of({.ring_time = at("2000-01-01"), .interval = lasting("PT3H"), .sticky = false}) ==
        "R..R..R.");
}

TEST_CASE("an alarm that is not sticky rings for its duration") {
  CHECK(
      rings_of({.interval = lasting("PT4H"), .sticky = false, .ring_duration = lasting("PT2H")}) ==
      "....RR..");
  CHECK(
      rings_of({.interval = lasting("PT4H"), .sticky = false, .ring_duration = lasting("PT90M")}) ==
      "....RR..");
  CHECK(rings_of({.interval = lasting("PT2H"), .sticky = false, .ring_duration = lasting("P1D")}) ==
        "..RRRRRR");
  CHECK(rings_of({.interval = lasting("PT1H"), .sticky = false}) == ".RRRRRRR");
}

TEST_CASE("the duration counts from the step that made the alarm ring") {
  CHECK(rings_of({.ring_time = at("2000-01-01T01:30"),
                  .sticky = false,
                  .ring_duration = lasting("PT75M")}) == "..RR....");
  CHECK(rings_of({.interval = lasting("PT4H"), .sticky = false, .ring_duration = lasting("PT2H")},
                 14) == "....RR..RR..RR");
}

TEST_CASE("an alarm whose interval is shorter than the step rings at every step") {
  Clock clock = hourly();
  const int id = clock.add_alarm({.interval = lasting("PT25M"), .sticky = false});
  CHECK(rings(clock, id, 4) == ".RRR");
  // Ring times stay on the grid of 25 minutes.
  CHECK(clock.alarm(id).ring_time() == at("2000-01-01T03:20"));
  clock.advance(lasting("P1000000DT1S"));
  CHECK(clock.alarm(id).is_ringing());
  CHECK(clock.alarm(id).ring_time() - clock.current() <= lasting("PT25M"));
  CHECK(remainder(clock.alarm(id).ring_time() - clock.start(), lasting("PT25M")).is_zero());
}

TEST_CASE("monthly alarms meet the steps of a monthly clock") {
  for (const Calendar calendar : samples::kCalendars) {
    Clock clock({.start = at("2000-01-30", calendar), .step = lasting("P1M")});
    const int monthly = clock.add_alarm({.interval = lasting("P1M"), .sticky = false});
    const int yearly = clock.add_alarm({.interval = lasting("P1Y"), .sticky = false});
    for (int month = 1; month <= 36; ++month) {
      CHECK(clock.will_ring_next(monthly));
      clock.advance();
      CHECK(clock.alarm(monthly).is_ringing());
      if (month % 12 == 0) CHECK(clock.current().date_time().month == 1);
    }
    CHECK(clock.alarm(yearly).ring_time() > clock.current());
  }
}

TEST_CASE("ring times of the past count only before the first step") {
  CHECK(rings_of({.ring_time = at("1999-12-31T23:00")}) == "RRRRRRRR");
  CHECK(rings_of(
            {.ring_time = at("1999-12-31T23:00"), .interval = lasting("PT3H"), .sticky = false}) ==
        "R.R..R..");
  Clock clock = hourly();
  clock.advance();
  clock.advance();
  const int passed = clock.add_alarm({.ring_time = at("2000-01-01T01:00")});
  CHECK_FALSE(clock.alarm(passed).is_ringing());
  const int within_last_step = clock.add_alarm({.ring_time = at("2000-01-01T01:30")});
  CHECK(clock.alarm(within_last_step).is_ringing());
  const int periodic = clock.add_alarm(
      {.ring_time = at("2000-01-01T01:00"), .interval = lasting("PT3H"), .sticky = false});
  CHECK(clock.alarm(periodic).ring_time() == at("2000-01-01T04:00"));
  CHECK(rings(clock, periodic, 4) == "..R.");
  CHECK_FALSE(clock.alarm(passed).is_ringing());
}

TEST_CASE("a disabled alarm is silent and lets its ring times pass") {
  CHECK(rings_of({.ring_time = at("2000-01-01"), .enabled = false}) == "........");
  Clock clock = hourly();
  const int id = clock.add_alarm({.interval = lasting("PT2H"), .sticky = false, .enabled = false});
  CHECK_FALSE(clock.alarm(id).is_enabled());
  CHECK_FALSE(clock.will_ring_next(id));
  CHECK(rings(clock, id, 6) == "......");
  CHECK_FALSE(clock.will_ring_next(id));
  clock.alarm(id).enable();
  CHECK(clock.will_ring_next(id));
  CHECK(rings(clock, id, 4) == ".R.R");
  clock.alarm(id).disable();
  CHECK_FALSE(clock.alarm(id).is_ringing());
  expect_error(ErrorKind::state, {"disabled alarm", "Enable"},
               [&] { clock.alarm(id).ringer_on(clock.current()); });
}

TEST_CASE("a ringer is switched on by hand") {
  Clock clock = hourly();
  const int sticky = clock.add_alarm({.interval = lasting("PT6H")});
  const int loose = clock.add_alarm({.interval = lasting("PT6H"), .sticky = false});
  const int lasting_two = clock.add_alarm(
      {.interval = lasting("PT6H"), .sticky = false, .ring_duration = lasting("PT2H")});
  clock.advance();
  for (const int id : {sticky, loose, lasting_two}) {
    clock.alarm(id).ringer_on(clock.current());
    CHECK(clock.alarm(id).is_ringing());
  }
  CHECK(clock.ringing_alarms() == std::vector<int>{sticky, loose, lasting_two});
  clock.advance();
  // The step during which it was switched on does not count.
  CHECK(clock.ringing_alarms() == std::vector<int>{sticky, loose, lasting_two});
  clock.advance();
  CHECK(clock.ringing_alarms() == std::vector<int>{sticky});
  clock.advance();
  CHECK(clock.ringing_alarms() == std::vector<int>{sticky});
}

TEST_CASE("a ringer switched on again rings as the first time") {
  Clock clock = hourly();
  const int id = clock.add_alarm({.ring_time = at("2000-01-01T01:00"), .sticky = false});
  CHECK(rings(clock, id, 2) == ".R");
  clock.alarm(id).ringer_off();
  clock.alarm(id).ringer_on(clock.current());
  CHECK(rings(clock, id, 3) == "RR.");
}

TEST_CASE("an alarm knows whether it will ring and whether it rang a step ago") {
  Clock clock = hourly();
  const int id = clock.add_alarm({.interval = lasting("PT3H"), .sticky = false});
  const std::string expected_rings = "...R..R.", expected_next = "..R..R..",
                    expected_before = "....R..R";
  for (std::size_t step = 0; step < expected_rings.size(); ++step) {
    CAPTURE(step);
    if (step > 0) clock.advance();
    CHECK(clock.alarm(id).is_ringing() == (expected_rings[step] == 'R'));
    CHECK(clock.will_ring_next(id) == (expected_next[step] == 'R'));
    CHECK(clock.alarm(id).was_ringing() == (expected_before[step] == 'R'));
  }
  CHECK_FALSE(clock.will_ring_next(id));
  CHECK(clock.will_ring_next(id, lasting("PT2H")));
  CHECK_FALSE(clock.will_ring_next(id, lasting("PT30M")));
}

TEST_CASE("what was switched off since still rang a step ago") {
  Clock clock = hourly();
  const int id = clock.add_alarm({.interval = lasting("PT1H")});
  clock.advance();
  clock.alarm(id).ringer_off();
  clock.advance();
  CHECK(clock.alarm(id).was_ringing());
  clock.alarm(id).disable();
  clock.advance();
  CHECK(clock.alarm(id).was_ringing());
  clock.advance();
  CHECK_FALSE(clock.alarm(id).was_ringing());
}

TEST_CASE("references to alarms hold while the clock advances") {
  Clock clock = hourly();
  Alarm& alarm = clock.alarm(clock.add_alarm({.interval = lasting("PT1H")}));
  for (int step = 0; step < 3; ++step) {
    clock.advance();
    CHECK(alarm.is_ringing());
    alarm.ringer_off();
    CHECK(clock.ringing_alarms().empty());
  }
}

TEST_CASE("options of alarms that contradict themselves are refused") {
  const auto refused = [](std::initializer_list<std::string> parts, const AlarmOptions& options) {
    Clock clock = hourly();
    expect_error(ErrorKind::config, parts, [&] { clock.add_alarm(options); });
    CHECK(clock.n_alarms() == 0);
  };
  refused({"neither a ring time nor an interval"}, {});
  refused({"P0Y0M0DT0H0M0S", "longer than zero"}, {.interval = TimeInterval()});
  refused({"P0Y0M0DT-1H0M0S", "longer than zero"}, {.interval = lasting("-PT1H")});
  refused({"P0Y0M0DT-1H0M0S", "no part may be negative"},
          {.interval = lasting("PT1H"), .sticky = false, .ring_duration = lasting("-PT1H")});
  refused({"sticky", "P0Y0M0DT1H0M0S", "switched off"},
          {.interval = lasting("PT1H"), .ring_duration = lasting("PT1H")});
  refused({"2000-01-01T03:00:00 is noleap", "gregorian"},
          {.ring_time = at("2000-01-01T03:00", Calendar::noleap)});
  Clock clock = hourly();
  const int id = clock.add_alarm({.interval = lasting("PT1H")});
  expect_error(ErrorKind::config, {"noleap"},
               [&] { clock.alarm(id).ringer_on(at("2000-01-01", Calendar::noleap)); });
}
