// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Public times and intervals to the engine's, and back.
#include "delos/time.hpp"
#include "time/time.hpp"

namespace delos::api {

static_assert(static_cast<int>(Calendar::gregorian) ==
              static_cast<int>(delos::Calendar::gregorian));
static_assert(static_cast<int>(Calendar::julian) == static_cast<int>(delos::Calendar::julian));
static_assert(static_cast<int>(Calendar::noleap) == static_cast<int>(delos::Calendar::noleap));
static_assert(static_cast<int>(Calendar::day360) == static_cast<int>(delos::Calendar::day360));

struct TimeAccess {
  static delos::Time engine(const Time& time) {
    return {static_cast<delos::Calendar>(time.calendar_),
            ExactSeconds(time.seconds_, time.numerator_, time.denominator_)};
  }
  static delos::TimeInterval engine(const TimeInterval& interval) {
    return {interval.months_,
            ExactSeconds(interval.seconds_, interval.numerator_, interval.denominator_)};
  }
  static Time made(const delos::Time& time) {
    Time out;
    const ExactSeconds& seconds = time.since_year_zero();
    out.calendar_ = static_cast<Calendar>(time.calendar());
    out.seconds_ = seconds.whole();
    out.numerator_ = seconds.numerator();
    out.denominator_ = seconds.denominator();
    return out;
  }
  static TimeInterval made(const delos::TimeInterval& interval) {
    TimeInterval out;
    out.months_ = interval.months();
    out.seconds_ = interval.seconds().whole();
    out.numerator_ = interval.seconds().numerator();
    out.denominator_ = interval.seconds().denominator();
    return out;
  }
};

}  // namespace delos::api
