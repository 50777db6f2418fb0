// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// When: an exact instant of one calendar, without time zone and leap seconds.
#include <compare>
#include <cstdint>

#include "time/calendar.hpp"
#include "time/exact_seconds.hpp"
#include "time/interval.hpp"

namespace delos {

/// A time as people read it.
struct DateTime {
  std::int64_t year = 0;
  int month = 1, day = 1;                       ///< from 1
  int hour = 0, minute = 0, second = 0;         ///< 0 to 23, 59, 59
  std::int64_t numerator = 0, denominator = 1;  ///< of a second: 0 <= numerator < denominator
  friend bool operator==(const DateTime&, const DateTime&) = default;
};

/// What compares or subtracts times of two calendars throws Error(config): mixing them is a
/// mistake.
class Time {
 public:
  /// Error(config) for a date or time of day that does not exist, saying which part is wrong.
  Time(Calendar calendar, const DateTime& when);
  /// Seconds from 0000-01-01T00:00:00 of the calendar itself. Error(config) beyond kMaxYear.
  Time(Calendar calendar, const ExactSeconds& since_year_zero);

  Calendar calendar() const { return calendar_; }
  const ExactSeconds& since_year_zero() const { return since_year_zero_; }
  DateTime date_time() const;
  /// 1 for January 1st.
  int day_of_year() const;

  friend bool operator==(const Time& a, const Time& b);
  friend std::strong_ordering operator<=>(const Time& a, const Time& b);

 private:
  Calendar calendar_;
  ExactSeconds since_year_zero_;
};

/// Error(config) that names both times unless they are of one calendar.
void check_same_calendar(const Time& a, const Time& b);

/// Months first, the day clipped to the month's last, then seconds: 2001-01-30 + 1 month and 2 days
/// = 2001-03-02. So a + b - b is not always a when b has months. Error(config) beyond kMaxYear.
Time operator+(const Time& time, const TimeInterval& interval);
/// time + (-interval)
Time operator-(const Time& time, const TimeInterval& interval);
/// Absolute: later - earlier in exact seconds, so b + (a - b) = a.
TimeInterval operator-(const Time& later, const Time& earlier);

/// The way from one time to another as people count it: the most whole months with
/// from + months <= to, then days and less. from + the parts = to, with all parts of one sign.
IntervalParts parts_between(const Time& from, const Time& to);

}  // namespace delos
