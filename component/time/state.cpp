// SPDX-License-Identifier: BSD-3-Clause
#include "time/state.hpp"

#include <numeric>
#include <string>

#include "core/error.hpp"

namespace delos {
namespace {

ExactSeconds exact_seconds_of(const TimeState& state) {
  DELOS_CHECK(state.denominator >= 1 && state.denominator <= kMaxDenominator &&
                  state.numerator >= 0 && state.numerator < state.denominator &&
                  std::gcd(state.numerator, state.denominator) == 1,
              ErrorKind::input, "a time in the restart has the fraction ",
              std::to_string(state.numerator), "/", std::to_string(state.denominator),
              " of a second: must be in [0, 1) and in lowest terms. The file is damaged, take "
              "another one.");
  return ExactSeconds(state.seconds, state.numerator, state.denominator);
}

// visit(integer) for each member, in the order of declaration; State may be const.
template <class State, class Visit>
void visit_time(State& time, const Visit& visit) {
  visit(time.seconds);
  visit(time.numerator);
  visit(time.denominator);
}

template <class State, class Visit>
void visit_interval(State& interval, const Visit& visit) {
  visit(interval.months);
  visit_time(interval, visit);
}

template <class State, class Visit>
void visit_alarm(State& alarm, const Visit& visit) {
  visit_time(alarm.ring_time, visit);
  visit_time(alarm.ring_begin, visit);
  visit_interval(alarm.interval, visit);
  visit_interval(alarm.ring_duration, visit);
  visit(alarm.n_steps_ringing);
  visit(alarm.sticky);
  visit(alarm.enabled);
  visit(alarm.ringing);
  visit(alarm.rang);
  visit(alarm.rang_before);
}

/// All but the alarms.
template <class State, class Visit>
void visit_clock(State& clock, const Visit& visit) {
  visit(clock.calendar);
  visit_time(clock.start, visit);
  visit_time(clock.current, visit);
  visit_time(clock.previous, visit);
  visit(clock.has_stop);
  visit_time(clock.stop, visit);
  visit_interval(clock.step, visit);
  visit(clock.advance_count);
}

}  // namespace

std::vector<std::int64_t> integers_of(const ClockState& state) {
  std::vector<std::int64_t> integers;
  const auto keep = [&](std::int64_t integer) { integers.push_back(integer); };
  visit_clock(state, keep);
  for (const AlarmState& alarm : state.alarms) visit_alarm(alarm, keep);
  return integers;
}

ClockState clock_state_of(std::span<const std::int64_t> integers) {
  ClockState state{};
  AlarmState alarm{};
  std::size_t n_clock = 0, n_alarm = 0;
  visit_clock(state, [&](std::int64_t) { ++n_clock; });
  visit_alarm(alarm, [&](std::int64_t) { ++n_alarm; });
  DELOS_CHECK(integers.size() >= n_clock && (integers.size() - n_clock) % n_alarm == 0,
              ErrorKind::input, "a clock in the restart has ", integers.size(),
              " integers: must be ", n_clock, " and ", n_alarm,
              " for each alarm. The file is damaged, take another one.");
  std::size_t at = 0;
  const auto take = [&](std::int64_t& integer) { integer = integers[at++]; };
  visit_clock(state, take);
  while (at < integers.size()) {
    visit_alarm(alarm, take);
    state.alarms.push_back(alarm);
  }
  return state;
}

TimeState state_of(const Time& time) {
  const ExactSeconds& exact = time.since_year_zero();
  return {exact.whole(), exact.numerator(), exact.denominator()};
}

IntervalState state_of(const TimeInterval& interval) {
  const ExactSeconds& exact = interval.seconds();
  return {interval.months(), exact.whole(), exact.numerator(), exact.denominator()};
}

Calendar calendar_of(std::int64_t number) {
  const auto last = static_cast<std::int64_t>(Calendar::day360);
  DELOS_CHECK(number >= 0 && number <= last, ErrorKind::input,
              "the clock in the restart has the calendar ", std::to_string(number),
              ": must be in 0 to ", std::to_string(last),
              ". The file is damaged or of a newer delos, take another one.");
  return static_cast<Calendar>(number);
}

Time time_of(Calendar calendar, const TimeState& state) {
  const ExactSeconds exact = exact_seconds_of(state);
  try {
    return {calendar, exact};
  } catch (const Error& error) {
    throw Error(ErrorKind::input, text("the clock in the restart is damaged: ", error.what()));
  }
}

TimeInterval interval_of(const IntervalState& state) {
  return {state.months, exact_seconds_of({state.seconds, state.numerator, state.denominator})};
}

bool flag_of(std::int64_t number, const char* name) {
  DELOS_CHECK(number == 0 || number == 1, ErrorKind::input, "the clock in the restart has ", name,
              " = ", std::to_string(number),
              ": must be 0 or 1. The file is damaged, take another one.");
  return number == 1;
}

}  // namespace delos
