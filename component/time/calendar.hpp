// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The calendars that models use, and dates in them: year 0 exists, before it come -1, -2, ...
#include <cstdint>
#include <string>
#include <string_view>

namespace delos {

/// The numbers go into restart files.
enum class Calendar {
  gregorian = 0,  ///< proleptic: today's leap years at all times
  julian = 1,     ///< every fourth year has 366 days
  noleap = 2,     ///< every year has 365 days
  day360 = 3      ///< every month has 30 days
};

/// "gregorian", "julian", "noleap" or "360_day".
const char* to_string(Calendar calendar);
/// The calendar of that name; also by CF's "proleptic_gregorian" and "365_day". Error(config) for
/// any other name, CF's mixed "standard" among them.
Calendar parse_calendar(std::string_view name);

/// Years run from -kMaxYear to kMaxYear, so that no sum of seconds overflows on the way.
inline constexpr std::int64_t kMaxYear = 999999999;

// The same in every calendar; there are no leap seconds.
inline constexpr std::int64_t kSecondsPerMinute = 60;
inline constexpr std::int64_t kSecondsPerHour = 3600;
inline constexpr std::int64_t kSecondsPerDay = 86400;
inline constexpr std::int64_t kMonthsPerYear = 12;

struct Date {
  std::int64_t year;
  int month;  ///< 1 to 12
  int day;    ///< 1 to days_in_month
  friend bool operator==(const Date&, const Date&) = default;
};

/// "2000-02-29"; years before 0 and after 9999 have a sign and as many digits as they need.
std::string date_text(const Date& date);

bool is_leap_year(Calendar calendar, std::int64_t year);
int days_in_year(Calendar calendar, std::int64_t year);
/// `month` in 1 to 12.
int days_in_month(Calendar calendar, std::int64_t year, int month);

/// Error(config) unless the date exists, naming what is wrong with it.
void check_date(Calendar calendar, const Date& date);

/// Days from 0000-01-01; the date exists.
std::int64_t day_number(Calendar calendar, const Date& date);
/// The date whose day_number is `day`.
Date date_of_day(Calendar calendar, std::int64_t day);
/// 1 for January 1st.
int day_of_year(Calendar calendar, const Date& date);

/// The date so many months later (earlier when negative); the day is clipped to the month's last:
/// 2000-01-31 + 1 month = 2000-02-29. Error(config) beyond kMaxYear.
Date add_months(Calendar calendar, const Date& date, std::int64_t n_months);

}  // namespace delos
