// SPDX-License-Identifier: BSD-3-Clause
#include "time/clock.hpp"

#include <doctest/doctest.h>

#include "support/sample_times.hpp"

using namespace delos;
using delos::samples::Numbers;

namespace {

constexpr int kSteps = 40;

// Hours and odd fractions, sometimes months.
TimeInterval random_step(Numbers& numbers, std::int64_t largest_h) {
  if (numbers.one_in(5)) return TimeInterval::of_months(numbers.in(1, 3));
  const std::int64_t denominator = numbers.in(1, 7);
  const std::int64_t numerator = numbers.in(0, denominator - 1);
  return TimeInterval::of_seconds(numbers.in(1, largest_h) * kSecondsPerHour, numerator,
                                  denominator);
}

Clock random_clock(Numbers& numbers) {
  const Time start = numbers.time(numbers.calendar(), 1990, 2010);
  Clock clock({.start = start, .step = random_step(numbers, 5)});
  if (numbers.one_in(2)) clock.set_stop(start + clock.step() * numbers.in(1, kSteps));
  return clock;
}

AlarmOptions random_alarm(Numbers& numbers, const Clock& clock) {
  AlarmOptions options;
  if (numbers.one_in(2)) {
    options.ring_time =
        clock.current() + TimeInterval::of_minutes(30) * numbers.in(-10, 3 * kSteps);
  }
  if (!options.ring_time || numbers.one_in(2)) options.interval = random_step(numbers, 12);
  options.sticky = numbers.one_in(2);
  if (!options.sticky && numbers.one_in(3)) options.ring_duration = random_step(numbers, 9);
  options.enabled = !numbers.one_in(5);
  return options;
}

// Each way that a host has to change an alarm, at random.
void act(Numbers& numbers, Clock& clock) {
  for (int id = 0; id < clock.n_alarms(); ++id) {
    Alarm& alarm = clock.alarm(id);
    const std::int64_t action = numbers.in(1, 12);
    if (action <= 4 && alarm.is_ringing()) alarm.ringer_off();
    if (action == 5) alarm.disable();
    if (action <= 7 && action >= 6) alarm.enable();
    if (action == 8 && alarm.is_enabled()) alarm.ringer_on(clock.current());
  }
}

}  // namespace

TEST_CASE("a clock restored after any step goes on alike whatever its host does") {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    CAPTURE(seed);
    Numbers numbers(seed);
    Clock clock = random_clock(numbers);
    Clock restored = clock;
    for (int step = 0; step < kSteps; ++step) {
      if (numbers.one_in(6)) {
        const AlarmOptions options = random_alarm(numbers, clock);
        REQUIRE(clock.add_alarm(options) == restored.add_alarm(options));
      }
      Numbers same = numbers;
      act(numbers, clock);
      act(same, restored);
      const TimeInterval length = numbers.one_in(5) ? random_step(numbers, 7) : clock.step();
      for (int id = 0; id < clock.n_alarms(); ++id) {
        REQUIRE(clock.will_ring_next(id, length) == restored.will_ring_next(id, length));
      }
      clock.advance(length);
      restored.advance(length);
      REQUIRE(restored.state() == clock.state());
      restored = Clock::restored(clock.state());
      REQUIRE(restored.state() == clock.state());
      REQUIRE(restored.ringing_alarms() == clock.ringing_alarms());
    }
  }
}

TEST_CASE("an alarm rings after exactly the steps that reach one of its ring times") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Numbers numbers(seed);
    Clock clock = random_clock(numbers);
    const TimeInterval interval = random_step(numbers, 12);
    const int loose = clock.add_alarm({.interval = interval, .sticky = false});
    const int sticky = clock.add_alarm({.interval = interval});
    const int muted = clock.add_alarm({.interval = interval, .enabled = false});
    // The ring times from their definition, one by one.
    Time ring_time = clock.start() + interval;
    for (int step = 0; step < kSteps; ++step) {
      bool is_reached = false;
      for (; ring_time <= clock.next(); ring_time = ring_time + interval) is_reached = true;
      REQUIRE(clock.will_ring_next(loose) == is_reached);
      REQUIRE(clock.will_ring_next(sticky) == is_reached);
      clock.advance();
      REQUIRE(clock.alarm(loose).is_ringing() == is_reached);
      REQUIRE(clock.alarm(sticky).is_ringing() == is_reached);
      REQUIRE_FALSE(clock.alarm(muted).is_ringing());
      for (const int id : {loose, sticky, muted}) {
        REQUIRE(clock.alarm(id).ring_time() == ring_time);
      }
      clock.alarm(sticky).ringer_off();
    }
  }
}

TEST_CASE("a clock is done from the first step on that reaches its stop") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Numbers numbers(seed);
    Clock clock = random_clock(numbers);
    const Time stop = clock.start() + TimeInterval::of_minutes(numbers.in(1, 20000));
    clock.set_stop(stop);
    TimeInterval elapsed;
    for (int step = 0; step < kSteps; ++step) {
      REQUIRE(clock.is_done() == (clock.current() >= stop));
      REQUIRE(clock.advance_count() == step);
      REQUIRE(clock.current() - clock.start() == elapsed);
      clock.advance();
      elapsed = elapsed + (clock.current() - clock.previous());
    }
  }
}
