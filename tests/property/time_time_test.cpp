// SPDX-License-Identifier: BSD-3-Clause
#include "time/time.hpp"

#include <doctest/doctest.h>

#include "support/sample_times.hpp"

using namespace delos;
using delos::samples::Numbers;

namespace {

constexpr std::int64_t kFarYear = 5000;
// Some 3000 years.
constexpr std::int64_t kLongInterval_s = 100000000000;

TimeInterval random_interval(Numbers& numbers) {
  const std::int64_t n_months = numbers.one_in(2) ? numbers.in(-5000, 5000) : 0;
  return {n_months, numbers.exact_seconds(numbers.one_in(2) ? kLongInterval_s : 100000)};
}

}  // namespace

TEST_CASE("the days of the months make the year and the days of the years make the calendar") {
  for (const Calendar calendar : samples::kCalendars) {
    std::int64_t day = day_number(calendar, {-1300, 1, 1});
    for (std::int64_t year = -1300; year <= 3000; ++year) {
      REQUIRE(day_number(calendar, {year, 1, 1}) == day);
      std::int64_t in_year = 0;
      for (int month = 1; month <= 12; ++month) in_year += days_in_month(calendar, year, month);
      REQUIRE(in_year == days_in_year(calendar, year));
      REQUIRE(day_of_year(calendar, {year, 12, days_in_month(calendar, year, 12)}) == in_year);
      day += in_year;
    }
    // A whole cycle of leap years, wherever it begins.
    for (const std::int64_t year : {-kMaxYear, std::int64_t{-1}, std::int64_t{0}, kMaxYear - 400}) {
      const std::int64_t cycle =
          day_number(calendar, {year + 400, 1, 1}) - day_number(calendar, {year, 1, 1});
      CHECK(cycle == (calendar == Calendar::gregorian ? 146097
                      : calendar == Calendar::julian  ? 146100
                                                      : 400 * days_in_year(calendar, 1)));
    }
  }
}

TEST_CASE("every day has one date and the next day has the next date") {
  for (const Calendar calendar : samples::kCalendars) {
    for (const std::int64_t first :
         {day_number(calendar, {-kMaxYear, 1, 1}), std::int64_t{-150000}, std::int64_t{600000},
          day_number(calendar, {kMaxYear - 400, 1, 1})}) {
      Date last = date_of_day(calendar, first);
      for (std::int64_t day = first + 1; day < first + 140000; ++day) {
        const Date date = date_of_day(calendar, day);
        REQUIRE(day_number(calendar, date) == day);
        const bool is_month_end = last.day == days_in_month(calendar, last.year, last.month);
        const bool is_year_end = is_month_end && last.month == 12;
        const Date expected = is_year_end    ? Date{last.year + 1, 1, 1}
                              : is_month_end ? Date{last.year, last.month + 1, 1}
                                             : Date{last.year, last.month, last.day + 1};
        REQUIRE(date == expected);
        last = date;
      }
    }
  }
}

TEST_CASE("absolute intervals are added and subtracted without loss") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    CAPTURE(seed);
    Numbers numbers(seed);
    for (int k = 0; k < 20000; ++k) {
      const Calendar calendar = numbers.calendar();
      const Time a = numbers.time(calendar, -kFarYear, kFarYear);
      const Time b = numbers.time(calendar, -kFarYear, kFarYear);
      const TimeInterval way = b - a;
      REQUIRE(a + way == b);
      REQUIRE(b - way == a);
      REQUIRE(a - b == -way);
      REQUIRE((a < b) == way.is_positive());
      REQUIRE((a == b) == way.is_zero());
      const TimeInterval piece(0, numbers.exact_seconds(kLongInterval_s));
      REQUIRE((a + piece) + (way - piece) == b);
      REQUIRE((a + piece) - a == piece);
    }
  }
}

TEST_CASE("later times have later dates") {
  for (const std::uint64_t seed : {4u, 5u}) {
    CAPTURE(seed);
    Numbers numbers(seed);
    const auto tuple = [](const DateTime& t) {
      return std::tuple(t.year, t.month, t.day, t.hour, t.minute, t.second,
                        ExactSeconds(0, t.numerator, t.denominator));
    };
    for (int k = 0; k < 20000; ++k) {
      const Calendar calendar = numbers.calendar();
      const Time a = numbers.time(calendar, 1999, 2001);
      const Time b = numbers.one_in(4) ? a : numbers.time(calendar, 1999, 2001);
      REQUIRE((a <=> b) == (tuple(a.date_time()) <=> tuple(b.date_time())));
    }
  }
}

TEST_CASE("added months keep the time of day, and the day or the last of the month") {
  for (const std::uint64_t seed : {6u, 7u}) {
    CAPTURE(seed);
    Numbers numbers(seed);
    for (int k = 0; k < 20000; ++k) {
      const Calendar calendar = numbers.calendar();
      const Time time = numbers.time(calendar, -kFarYear, kFarYear);
      const std::int64_t n_months = numbers.in(-30000, 30000);
      const DateTime before = time.date_time();
      DateTime after = (time + TimeInterval::of_months(n_months)).date_time();
      REQUIRE((after.year - before.year) * 12 + after.month - before.month == n_months);
      REQUIRE(after.day == std::min(before.day, days_in_month(calendar, after.year, after.month)));
      after.year = before.year;
      after.month = before.month;
      after.day = before.day;
      REQUIRE(after == before);
    }
  }
}

TEST_CASE("the parts between two times lead from one to the other and have one sign") {
  for (const std::uint64_t seed : {8u, 9u}) {
    CAPTURE(seed);
    Numbers numbers(seed);
    for (int k = 0; k < 20000; ++k) {
      const Calendar calendar = numbers.calendar();
      const std::int64_t last_year = numbers.one_in(2) ? 2001 : kFarYear;
      const Time from = numbers.time(calendar, 2000, last_year);
      const Time to = numbers.time(calendar, 2000, last_year);
      const IntervalParts p = parts_between(from, to);
      const TimeInterval months =
          TimeInterval::of_years(p.years) + TimeInterval::of_months(p.months);
      const TimeInterval rest = TimeInterval::of_days(p.days) + TimeInterval::of_hours(p.hours) +
                                TimeInterval::of_minutes(p.minutes) +
                                TimeInterval::of_seconds(p.seconds, p.numerator, p.denominator);
      REQUIRE(from + (months + rest) == to);
      const std::int64_t sign = from <= to ? 1 : -1;
      for (const std::int64_t part :
           {p.years, p.months, p.days, p.hours, p.minutes, p.seconds, p.numerator}) {
        REQUIRE(part * sign >= 0);
      }
      // One month more would go too far.
      const Time beyond = from + (months + TimeInterval::of_months(sign));
      REQUIRE((sign > 0 ? beyond > to : beyond < to));
    }
  }
}

TEST_CASE("times and intervals are read back from their text") {
  for (const std::uint64_t seed : {10u, 11u, 12u}) {
    CAPTURE(seed);
    Numbers numbers(seed);
    for (int k = 0; k < 20000; ++k) {
      const Calendar calendar = numbers.calendar();
      const std::int64_t last_year = numbers.one_in(3) ? kMaxYear : kFarYear;
      const Time time = numbers.time(calendar, -last_year, last_year);
      CAPTURE(iso_text(time));
      REQUIRE(parse_time(calendar, iso_text(time)) == time);
      const TimeInterval interval = random_interval(numbers);
      CAPTURE(iso_text(interval));
      REQUIRE(parse_interval(iso_text(interval)) == interval);
    }
  }
}

TEST_CASE("intervals are a group, and a quotient and its remainder make the dividend") {
  for (const std::uint64_t seed : {13u, 14u}) {
    CAPTURE(seed);
    Numbers numbers(seed);
    for (int k = 0; k < 20000; ++k) {
      const TimeInterval a = random_interval(numbers);
      const TimeInterval b = random_interval(numbers);
      REQUIRE(a + b == b + a);
      REQUIRE((a + b) - b == a);
      REQUIRE(a + (-a) == TimeInterval());
      REQUIRE(a * 3 == a + a + a);
      REQUIRE(a * -2 == -(a + a));
      const ExactSeconds dividend = a.seconds();
      const ExactSeconds divisor = numbers.exact_seconds(100000);
      if (divisor.is_zero()) continue;
      const ExactSeconds rest = remainder(dividend, divisor);
      const ExactSeconds size = divisor.is_negative() ? -divisor : divisor;
      REQUIRE((rest.is_negative() ? -rest : rest) < size);
      REQUIRE((rest.is_zero() || rest.is_negative() == dividend.is_negative()));
      const std::int64_t quotient = floor_ratio(dividend - rest, size);
      REQUIRE(size * quotient + rest == dividend);
    }
  }
}
