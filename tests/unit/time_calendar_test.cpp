// SPDX-License-Identifier: BSD-3-Clause
#include "time/calendar.hpp"

#include "support/expect_error.hpp"

using namespace delos;
using delos::testing::expect_error;

TEST_CASE("calendars are found by name and unknown names are refused with the known ones") {
  for (const char* const name : {"gregorian", "julian", "noleap", "360_day"}) {
    CHECK(std::string(to_string(parse_calendar(name))) == name);
  }
  CHECK(parse_calendar("proleptic_gregorian") == Calendar::gregorian);
  CHECK(parse_calendar("365_day") == Calendar::noleap);
  for (const char* const name : {"", "Gregorian", "standard", "lunar", "noleap "}) {
    CAPTURE(name);
    expect_error(ErrorKind::config, {text("'", name, "'"), "gregorian, julian, noleap or 360_day"},
                 [&] { parse_calendar(name); });
  }
}

TEST_CASE("leap years are those of the calendar, before the year 0 too") {
  for (const std::int64_t year : {-400, -4, 0, 4, 1600, 2000, 2024}) {
    CHECK(is_leap_year(Calendar::gregorian, year));
  }
  for (const std::int64_t year : {-100, -1, 1, 100, 1900, 2001, 2100}) {
    CHECK_FALSE(is_leap_year(Calendar::gregorian, year));
  }
  CHECK(is_leap_year(Calendar::julian, 1900));
  CHECK_FALSE(is_leap_year(Calendar::noleap, 2000));
  CHECK_FALSE(is_leap_year(Calendar::day360, 2000));
  CHECK(days_in_year(Calendar::gregorian, 2000) == 366);
  CHECK(days_in_year(Calendar::noleap, 2000) == 365);
  CHECK(days_in_year(Calendar::day360, 2000) == 360);
}

TEST_CASE("days are counted from January 1st of the year 0") {
  for (const Calendar calendar :
       {Calendar::gregorian, Calendar::julian, Calendar::noleap, Calendar::day360}) {
    CHECK(day_number(calendar, {0, 1, 1}) == 0);
    CHECK(date_of_day(calendar, -1) == Date{-1, 12, calendar == Calendar::day360 ? 30 : 31});
  }
  // 1970-01-01 is the rata die 719163 (counted from 0000-12-31) and the Julian day number 2440588.
  CHECK(day_number(Calendar::gregorian, {1970, 1, 1}) == 719163 + 365);
  CHECK(day_number(Calendar::gregorian, {1970, 1, 1}) -
            day_number(Calendar::gregorian, {-4713, 11, 24}) ==
        2440588);
  // Gregorian 1582-10-15 followed Julian 1582-10-04; the zeros of the two are two days apart.
  CHECK(day_number(Calendar::gregorian, {1582, 10, 15}) - 1 -
            day_number(Calendar::julian, {1582, 10, 4}) ==
        -2);
  CHECK(day_number(Calendar::noleap, {2, 3, 1}) == 2 * 365 + 59);
  CHECK(day_number(Calendar::day360, {-1, 12, 30}) == -1);
}

TEST_CASE("dates that do not exist are refused with the reason") {
  expect_error(ErrorKind::config, {"2001-02-29", "28 days", "gregorian"}, [] {
    check_date(Calendar::gregorian, {2001, 2, 29});
  });
  expect_error(ErrorKind::config, {"2000-02-29", "28 days", "noleap", "choose the calendar"}, [] {
    check_date(Calendar::noleap, {2000, 2, 29});
  });
  expect_error(ErrorKind::config, {"2000-01-31", "30 days", "360_day"}, [] {
    check_date(Calendar::day360, {2000, 1, 31});
  });
  expect_error(ErrorKind::config, {"2000-04-00", "30 days"}, [] {
    check_date(Calendar::julian, {2000, 4, 0});
  });
  expect_error(ErrorKind::config, {"2000-13-01", "the month 13", "1 to 12"}, [] {
    check_date(Calendar::julian, {2000, 13, 1});
  });
  expect_error(ErrorKind::config, {"the year 1000000000", "999999999"}, [] {
    check_date(Calendar::gregorian, {kMaxYear + 1, 1, 1});
  });
  CHECK_NOTHROW(check_date(Calendar::julian, {1900, 2, 29}));
  CHECK_NOTHROW(check_date(Calendar::day360, {2001, 2, 30}));
}

TEST_CASE("months are added over years with the day clipped to the last of the month") {
  const Calendar gregorian = Calendar::gregorian;
  CHECK(add_months(gregorian, {2000, 1, 31}, 1) == Date{2000, 2, 29});
  CHECK(add_months(gregorian, {2000, 12, 31}, 1) == Date{2001, 1, 31});
  CHECK(add_months(gregorian, {2000, 1, 31}, -1) == Date{1999, 12, 31});
  CHECK(add_months(gregorian, {2000, 3, 31}, -13) == Date{1999, 2, 28});
  CHECK(add_months(gregorian, {0, 1, 1}, -1) == Date{-1, 12, 1});
  CHECK(add_months(Calendar::day360, {2000, 1, 30}, 1) == Date{2000, 2, 30});
  expect_error(ErrorKind::config, {"the year 1000000000"}, [] {
    add_months(Calendar::noleap, {kMaxYear, 12, 1}, 1);
  });
  expect_error(ErrorKind::config, {"64 bits"}, [] {
    add_months(Calendar::noleap, {kMaxYear, 12, 1}, INT64_MAX);
  });
}

TEST_CASE("dates are written with four digits of the year, more with a sign") {
  CHECK(date_text({2000, 2, 29}) == "2000-02-29");
  CHECK(date_text({7, 12, 1}) == "0007-12-01");
  CHECK(date_text({-7, 12, 1}) == "-0007-12-01");
  CHECK(date_text({12345, 1, 1}) == "+12345-01-01");
}
