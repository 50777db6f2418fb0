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

}  // namespace

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
