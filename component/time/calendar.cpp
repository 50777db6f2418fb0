// SPDX-License-Identifier: BSD-3-Clause
#include "time/calendar.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "time/integers.hpp"

namespace delos {
namespace {

constexpr int kFebruary = 2;
constexpr std::array kDaysInMonth = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
constexpr int kDaysInMonth360 = 30;

constexpr std::array<std::pair<std::string_view, Calendar>, 6> kNames = {{
    {"gregorian", Calendar::gregorian},
    {"julian", Calendar::julian},
    {"noleap", Calendar::noleap},
    {"360_day", Calendar::day360},
    {"proleptic_gregorian", Calendar::gregorian},
    {"365_day", Calendar::noleap},
}};

// The years of one cycle and their days: the length of a mean year.
struct Cycle {
  std::int64_t years, days;
};

Cycle cycle_of(Calendar calendar) {
  switch (calendar) {
    case Calendar::gregorian:
      return {400, 146097};
    case Calendar::julian:
      return {4, 1461};
    case Calendar::noleap:
      return {1, 365};
    case Calendar::day360:
      break;
  }
  return {1, 360};
}

// Days from 0000-01-01 to January 1st of the year. Leap years before it: year 0 is one.
std::int64_t days_before_year(Calendar calendar, std::int64_t year) {
  switch (calendar) {
    case Calendar::gregorian:
      return 365 * year + floor_divide(year + 3, 4) - floor_divide(year + 99, 100) +
             floor_divide(year + 399, 400);
    case Calendar::julian:
      return 365 * year + floor_divide(year + 3, 4);
    case Calendar::noleap:
      return 365 * year;
    case Calendar::day360:
      break;
  }
  return 360 * year;
}

void check_year(std::int64_t year) {
  DELOS_CHECK(year >= -kMaxYear && year <= kMaxYear, ErrorKind::config, "the year ",
              std::to_string(year), " is out of range: must be in -", std::to_string(kMaxYear),
              " to ", std::to_string(kMaxYear), ".");
}

}  // namespace

const char* to_string(Calendar calendar) {
  switch (calendar) {
    case Calendar::gregorian:
      return "gregorian";
    case Calendar::julian:
      return "julian";
    case Calendar::noleap:
      return "noleap";
    case Calendar::day360:
      break;
  }
  return "360_day";
}

std::string date_text(const Date& date) {
  const bool expanded = date.year < 0 || date.year > 9999;
  const std::string sign = date.year < 0 ? "-" : expanded ? "+" : "";
  return sign + digits(date.year < 0 ? -date.year : date.year, 4) + "-" + digits(date.month, 2) +
         "-" + digits(date.day, 2);
}

Calendar parse_calendar(std::string_view name) {
  for (const auto& [known, calendar] : kNames) {
    if (known == name) return calendar;
  }
  throw Error(ErrorKind::config, text("unknown calendar '", name,
                                      "': must be gregorian, julian, noleap or 360_day. Take "
                                      "gregorian for dates after 1582 of CF's 'standard'."));
}

bool is_leap_year(Calendar calendar, std::int64_t year) {
  switch (calendar) {
    case Calendar::gregorian:
      return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    case Calendar::julian:
      return year % 4 == 0;
    case Calendar::noleap:
    case Calendar::day360:
      break;
  }
  return false;
}

int days_in_year(Calendar calendar, std::int64_t year) {
  if (calendar == Calendar::day360) return static_cast<int>(kMonthsPerYear) * kDaysInMonth360;
  return is_leap_year(calendar, year) ? 366 : 365;
}

int days_in_month(Calendar calendar, std::int64_t year, int month) {
  if (calendar == Calendar::day360) return kDaysInMonth360;
  const int leap_day = month == kFebruary && is_leap_year(calendar, year) ? 1 : 0;
  return kDaysInMonth[static_cast<std::size_t>(month - 1)] + leap_day;
}

void check_date(Calendar calendar, const Date& date) {
  check_year(date.year);
  DELOS_CHECK(date.month >= 1 && date.month <= kMonthsPerYear, ErrorKind::config, "the date ",
              date_text(date), " has the month ", std::to_string(date.month),
              ": must be in 1 to 12.");
  const int n_days = days_in_month(calendar, date.year, date.month);
  DELOS_CHECK(date.day >= 1 && date.day <= n_days, ErrorKind::config, "the date ", date_text(date),
              " does not exist: this month has ", std::to_string(n_days), " days in the calendar ",
              to_string(calendar), ". Correct the day, or choose the calendar that it is from.");
}

std::int64_t day_number(Calendar calendar, const Date& date) {
  return days_before_year(calendar, date.year) + day_of_year(calendar, date) - 1;
}

Date date_of_day(Calendar calendar, std::int64_t day) {
  const Cycle cycle = cycle_of(calendar);
  // The mean year is right but for the leap days of an unfinished cycle: at most one year off.
  std::int64_t year = floor_divide(day * cycle.years, cycle.days);
  while (days_before_year(calendar, year) > day) --year;
  while (days_before_year(calendar, year + 1) <= day) ++year;
  auto rest = static_cast<int>(day - days_before_year(calendar, year));
  int month = 1;
  while (rest >= days_in_month(calendar, year, month)) {
    rest -= days_in_month(calendar, year, month);
    ++month;
  }
  return {year, month, rest + 1};
}

int day_of_year(Calendar calendar, const Date& date) {
  int day = date.day;
  for (int month = 1; month < date.month; ++month) day += days_in_month(calendar, date.year, month);
  return day;
}

Date add_months(Calendar calendar, const Date& date, std::int64_t n_months) {
  const std::int64_t months = checked_add(date.year * kMonthsPerYear + (date.month - 1), n_months);
  Date result = date;
  result.year = floor_divide(months, kMonthsPerYear);
  check_year(result.year);
  result.month = static_cast<int>(floor_modulo(months, kMonthsPerYear)) + 1;
  result.day = std::min(date.day, days_in_month(calendar, result.year, result.month));
  return result;
}

}  // namespace delos
