// SPDX-License-Identifier: BSD-3-Clause
#include "time/time.hpp"

#include <string>

#include "core/error.hpp"
#include "time/integers.hpp"
#include "time/iso8601.hpp"

namespace delos {
namespace {

void check_part(const char* name, std::int64_t value, std::int64_t last) {
  DELOS_CHECK(value >= 0 && value <= last, ErrorKind::config, "a time of day has the ", name, " ",
              std::to_string(value), ": must be in 0 to ", std::to_string(last), ".");
}

ExactSeconds seconds_of(Calendar calendar, const DateTime& when) {
  const Date date{when.year, when.month, when.day};
  check_date(calendar, date);
  check_part("hour", when.hour, 23);
  check_part("minute", when.minute, 59);
  check_part("second", when.second, 59);
  // A bad denominator is for ExactSeconds to refuse.
  if (when.denominator >= 1)
    check_part("numerator of a second", when.numerator, when.denominator - 1);
  return ExactSeconds(day_number(calendar, date) * kSecondsPerDay + when.hour * kSecondsPerHour +
                          when.minute * kSecondsPerMinute + when.second,
                      when.numerator, when.denominator);
}

std::int64_t first_day(Calendar calendar, std::int64_t year) {
  return day_number(calendar, {year, 1, 1});
}

// The day of a time and the seconds since its midnight.
struct DayAndRest {
  std::int64_t day;
  ExactSeconds rest;
};

DayAndRest split_day(const ExactSeconds& since_year_zero) {
  const std::int64_t whole = since_year_zero.whole();
  return {floor_divide(whole, kSecondsPerDay),
          ExactSeconds(floor_modulo(whole, kSecondsPerDay), since_year_zero.numerator(),
                       since_year_zero.denominator())};
}

}  // namespace

Time::Time(Calendar calendar, const DateTime& when)
    : calendar_(calendar), since_year_zero_(seconds_of(calendar, when)) {}

Time::Time(Calendar calendar, const ExactSeconds& since_year_zero)
    : calendar_(calendar), since_year_zero_(since_year_zero) {
  const std::int64_t day = split_day(since_year_zero).day;
  DELOS_CHECK(day >= first_day(calendar, -kMaxYear) && day < first_day(calendar, kMaxYear + 1),
              ErrorKind::config, "a time is ", std::to_string(since_year_zero.whole()),
              " s from the year 0: years must be in -", std::to_string(kMaxYear), " to ",
              std::to_string(kMaxYear), ".");
}

DateTime Time::date_time() const {
  const auto [day, rest] = split_day(since_year_zero_);
  const Date date = date_of_day(calendar_, day);
  DateTime when;
  when.year = date.year;
  when.month = date.month;
  when.day = date.day;
  when.hour = static_cast<int>(rest.whole() / kSecondsPerHour);
  when.minute = static_cast<int>(rest.whole() % kSecondsPerHour / kSecondsPerMinute);
  when.second = static_cast<int>(rest.whole() % kSecondsPerMinute);
  when.numerator = rest.numerator();
  when.denominator = rest.denominator();
  return when;
}

int Time::day_of_year() const {
  return delos::day_of_year(calendar_, date_of_day(calendar_, split_day(since_year_zero_).day));
}

bool operator==(const Time& a, const Time& b) {
  check_same_calendar(a, b);
  return a.since_year_zero_ == b.since_year_zero_;
}

std::strong_ordering operator<=>(const Time& a, const Time& b) {
  check_same_calendar(a, b);
  return a.since_year_zero_ <=> b.since_year_zero_;
}

void check_same_calendar(const Time& a, const Time& b) {
  DELOS_CHECK(a.calendar() == b.calendar(), ErrorKind::config,
              "times of two calendars meet: ", iso_text(a), " is ", to_string(a.calendar()), ", ",
              iso_text(b), " is ", to_string(b.calendar()), ". Give both in one calendar.");
}

Time operator+(const Time& time, const TimeInterval& interval) {
  ExactSeconds start = time.since_year_zero();
  if (!interval.is_absolute()) {
    const auto [day, rest] = split_day(start);
    const Date date = date_of_day(time.calendar(), day);
    const Date shifted = add_months(time.calendar(), date, interval.months());
    start = ExactSeconds(day_number(time.calendar(), shifted) * kSecondsPerDay) + rest;
  }
  return {time.calendar(), start + interval.seconds()};
}

Time operator-(const Time& time, const TimeInterval& interval) { return time + (-interval); }

TimeInterval operator-(const Time& later, const Time& earlier) {
  check_same_calendar(later, earlier);
  return {0, later.since_year_zero() - earlier.since_year_zero()};
}

IntervalParts parts_between(const Time& from, const Time& to) {
  const DateTime a = from.date_time(), b = to.date_time();
  std::int64_t n_months = (b.year - a.year) * kMonthsPerYear + (b.month - a.month);
  // The months of the dates are right, or one too far when the rest of the month is not reached.
  const bool forward = from <= to;
  const Time guess = from + TimeInterval::of_months(n_months);
  if (forward && guess > to) --n_months;
  if (!forward && guess < to) ++n_months;
  const Time last = from + TimeInterval::of_months(n_months);
  return parts(TimeInterval(n_months, (to - last).seconds()));
}

}  // namespace delos
