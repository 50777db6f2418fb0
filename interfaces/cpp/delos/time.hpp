// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Model time, exact, as ESMF counts it: calendars, times and intervals. Values; nothing is global.
#include <compare>
#include <cstdint>
#include <string>

#include "delos/export.hpp"

namespace delos::api {

struct TimeAccess;

enum class Calendar {
  gregorian = 0,  ///< proleptic: today's leap years at all times
  julian = 1,     ///< every fourth year has 366 days
  noleap = 2,     ///< every year has 365 days
  day360 = 3      ///< every month has 30 days
};

/// "gregorian", "julian", "noleap" or "360_day".
DELOS_API const char* to_string(Calendar calendar);
/// Of these names, or CF's "proleptic_gregorian" and "365_day"; else Error(config).
DELOS_API Calendar parse_calendar(const std::string& name);

/// A time as people read it; a second may have a fraction numerator / denominator.
struct DateTime {
  std::int64_t year = 0;
  int month = 1, day = 1;                ///< from 1
  int hour = 0, minute = 0, second = 0;  ///< 0 to 23, 59, 59
  std::int64_t numerator = 0, denominator = 1;
  friend bool operator==(const DateTime&, const DateTime&) = default;
};

/// Months of a calendar, and exact seconds: whole + numerator / denominator. Years are 12 months,
/// days 86400 s. Results beyond 64 bits are Error(config).
class DELOS_API TimeInterval {
 public:
  /// Zero.
  TimeInterval() = default;
  /// ISO 8601, "P1Y2M10DT2H30M", "P2W", "PT0.5S", "-P1D"; Error(config) says what is wrong.
  static TimeInterval parse(const std::string& text);
  /// Of a negative number: backward.
  static TimeInterval of_years(std::int64_t n);
  static TimeInterval of_months(std::int64_t n);
  static TimeInterval of_days(std::int64_t n);
  static TimeInterval of_hours(std::int64_t n);
  static TimeInterval of_minutes(std::int64_t n);
  static TimeInterval of_seconds(std::int64_t n, std::int64_t numerator = 0,
                                 std::int64_t denominator = 1);

  std::int64_t months() const { return months_; }
  /// The seconds rounded down, and the fraction in lowest terms.
  std::int64_t seconds() const { return seconds_; }
  std::int64_t numerator() const { return numerator_; }
  std::int64_t denominator() const { return denominator_; }
  /// "P1Y2M10DT2H30M0S"; parse reads it back exactly.
  std::string text() const;

  friend bool operator==(const TimeInterval&, const TimeInterval&) = default;
  TimeInterval operator+(const TimeInterval& other) const;
  TimeInterval operator-(const TimeInterval& other) const;
  TimeInterval operator-() const;
  TimeInterval operator*(std::int64_t factor) const;
  /// Error(config) when the order depends on where the intervals start.
  std::strong_ordering operator<=>(const TimeInterval& other) const;

 private:
  friend struct TimeAccess;
  std::int64_t months_ = 0;
  std::int64_t seconds_ = 0;
  std::int64_t numerator_ = 0;
  std::int64_t denominator_ = 1;
};

/// An instant of one calendar, without time zone. Comparing or subtracting times of two calendars
/// is Error(config).
class DELOS_API Time {
 public:
  /// "2000-02-29", with or without "T06:30:00.25".
  static Time parse(const std::string& text, Calendar calendar = Calendar::gregorian);
  /// Error(config) for a date that does not exist.
  static Time of(const DateTime& when, Calendar calendar = Calendar::gregorian);

  Calendar calendar() const { return calendar_; }
  /// The same time as numbers; of() reads them back.
  DateTime date_time() const;
  /// 1 for January 1st.
  int day_of_year() const;
  /// "2000-02-29T06:30:00"; parse reads it back exactly.
  std::string text() const;

  bool operator==(const Time& other) const;
  std::strong_ordering operator<=>(const Time& other) const;
  /// Months first, the day clipped to the month's last, then seconds. Error(config) beyond the
  /// range of years.
  Time operator+(const TimeInterval& interval) const;
  Time operator-(const TimeInterval& interval) const;
  /// Exact seconds.
  TimeInterval operator-(const Time& earlier) const;

 private:
  friend struct TimeAccess;
  Time() = default;
  Calendar calendar_ = Calendar::gregorian;
  std::int64_t seconds_ = 0;  // since 0000-01-01T00:00:00
  std::int64_t numerator_ = 0;
  std::int64_t denominator_ = 1;
};

}  // namespace delos::api

#ifndef DELOS_BUILDING_LIBRARY
namespace delos {
using api::Calendar;
using api::DateTime;
using api::parse_calendar;
using api::Time;
using api::TimeInterval;
using api::to_string;
}  // namespace delos
#endif
