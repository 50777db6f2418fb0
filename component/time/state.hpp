// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Clocks and alarms as plain integers, for restart files: nothing is rounded, and a clock restored
// from its state goes on as the first one would have.
#include <cstdint>
#include <span>
#include <vector>

#include "time/time.hpp"

namespace delos {

/// Seconds from 0000-01-01T00:00:00 of the clock's calendar, and a fraction of a second in lowest
/// terms, 0 <= numerator < denominator.
struct TimeState {
  std::int64_t seconds;
  std::int64_t numerator;
  std::int64_t denominator;
  friend bool operator==(const TimeState&, const TimeState&) = default;
};

/// As a TimeState, and months beside the seconds.
struct IntervalState {
  std::int64_t months;
  std::int64_t seconds;
  std::int64_t numerator;
  std::int64_t denominator;
  friend bool operator==(const IntervalState&, const IntervalState&) = default;
};

/// Flags are 0 or 1.
struct AlarmState {
  TimeState ring_time;           ///< next time to ring
  TimeState ring_begin;          ///< time of the step that made it ring last
  IntervalState interval;        ///< zero: rings once
  IntervalState ring_duration;   ///< zero: one step
  std::int64_t n_steps_ringing;  ///< steps at whose end it rang, since it began
  std::int64_t sticky;
  std::int64_t enabled;
  std::int64_t ringing;
  std::int64_t rang;         ///< right after the last step
  std::int64_t rang_before;  ///< right after the step before
  friend bool operator==(const AlarmState&, const AlarmState&) = default;
};

struct ClockState {
  std::int64_t calendar;  ///< number of the Calendar: 0 gregorian, 1 julian, 2 noleap, 3 360_day
  TimeState start;
  TimeState current;
  TimeState previous;
  std::int64_t has_stop;
  TimeState stop;  ///< equals start when there is no stop
  IntervalState step;
  std::int64_t advance_count;
  std::vector<AlarmState> alarms;  ///< by id
  friend bool operator==(const ClockState&, const ClockState&) = default;
};

/// Its members one after the other, as they are declared, alarm by alarm at the end.
std::vector<std::int64_t> integers_of(const ClockState& state);
/// The way back; Error(input) for a number of integers that no clock has.
ClockState clock_state_of(std::span<const std::int64_t> integers);

TimeState state_of(const Time& time);
IntervalState state_of(const TimeInterval& interval);

// The way back; Error(input) for integers that state_of and Calendar never give.
Calendar calendar_of(std::int64_t number);
Time time_of(Calendar calendar, const TimeState& state);
TimeInterval interval_of(const IntervalState& state);
/// `name` for the message.
bool flag_of(std::int64_t number, const char* name);

}  // namespace delos
