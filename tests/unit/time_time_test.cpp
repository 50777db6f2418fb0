// SPDX-License-Identifier: BSD-3-Clause
#include "time/time.hpp"

#include "support/expect_error.hpp"
#include "support/sample_times.hpp"

using namespace delos;
using delos::samples::at;
using delos::samples::lasting;
using delos::testing::expect_error;

TEST_CASE("a time gives back the date and the time of day that it was made of") {
  DateTime when;
  when.year = 2000;
  when.month = 2;
  when.day = 29;
  when.hour = 23;
  when.minute = 59;
  when.second = 58;
  when.numerator = 1;
  when.denominator = 3;
  const Time time(Calendar::gregorian, when);
  CHECK(time.date_time() == when);
  CHECK(time.day_of_year() == 60);
  CHECK(Time(Calendar::gregorian, time.since_year_zero()) == time);
  CHECK(at("0000-01-01").since_year_zero().is_zero());
  CHECK(at("-0001-12-31T23:59:59.5").since_year_zero() == ExactSeconds(0, -1, 2));
  CHECK(at("-0001-12-31T23:59:59.5").date_time().second == 59);
}

TEST_CASE("a time of day that does not exist is refused with the part that is wrong") {
  const auto refused = [](std::initializer_list<std::string> parts, auto change) {
    DateTime when;
    change(when);
    expect_error(ErrorKind::config, parts, [&] { Time(Calendar::gregorian, when); });
  };
  refused({"the hour 24", "0 to 23"}, [](DateTime& when) { when.hour = 24; });
  refused({"the minute -1", "0 to 59"}, [](DateTime& when) { when.minute = -1; });
  refused({"the second 60", "0 to 59"}, [](DateTime& when) { when.second = 60; });
  refused({"numerator", "0 to 2"}, [](DateTime& when) {
    when.numerator = 3;
    when.denominator = 3;
  });
  refused({"denominator 0"}, [](DateTime& when) { when.denominator = 0; });
  refused({"0000-02-30", "29 days"}, [](DateTime& when) {
    when.month = 2;
    when.day = 30;
  });
}

TEST_CASE("months come before seconds and keep the time of day with its fraction") {
  CHECK(at("2001-01-30") + lasting("P1M2D") == at("2001-03-02"));
  CHECK(at("2000-01-31T06:30:00:1/3") + lasting("P1M") == at("2000-02-29T06:30:00:1/3"));
  CHECK(at("2000-03-31T12:00") - lasting("P1MT13H") == at("2000-02-28T23:00"));
  CHECK(at("1999-12-31T23:59:59.75") + lasting("PT0.25S") == at("2000-01-01"));
  CHECK(at("2000-02-28", Calendar::noleap) + lasting("P1D") == at("2000-03-01", Calendar::noleap));
  CHECK(at("0000-01-01") - lasting("PT1S") == at("-0001-12-31T23:59:59"));
}

TEST_CASE("the difference of two times is absolute") {
  CHECK(at("2000-03-01") - at("2000-02-01") == lasting("P29D"));
  CHECK(at("2000-01-01") - at("1850-01-01") == TimeInterval::of_seconds(4733510400));
  CHECK(at("2000-01-01") - at("2000-01-01T00:00:00:1/3") == lasting("-PT0:1/3S"));
}

TEST_CASE("the way between two times is counted in the most whole months") {
  const auto between = [](const char* from, const char* to) {
    return parts_between(at(from), at(to));
  };
  CHECK(between("1850-01-01", "2000-01-01") == IntervalParts{150, 0, 0, 0, 0, 0, 0, 1});
  CHECK(between("2000-01-31", "2000-02-29") == IntervalParts{0, 1, 0, 0, 0, 0, 0, 1});
  CHECK(between("2000-01-31T01:00", "2000-02-29") == IntervalParts{0, 0, 28, 23, 0, 0, 0, 1});
  // Four whole years end on February 29th.
  CHECK(between("2000-02-29", "2004-02-28") == IntervalParts{3, 11, 30, 0, 0, 0, 0, 1});
  CHECK(between("2000-03-15", "2000-02-10") == IntervalParts{0, -1, -5, 0, 0, 0, 0, 1});
  CHECK(between("2000-03-10", "2000-02-15") == IntervalParts{0, 0, -24, 0, 0, 0, 0, 1});
  CHECK(between("2000-03-10", "2000-03-10") == IntervalParts{0, 0, 0, 0, 0, 0, 0, 1});
}

TEST_CASE("times of two calendars do not mix") {
  const Time a = at("2000-01-01"), b = at("2000-01-01", Calendar::noleap);
  const std::initializer_list<std::string> parts = {"2000-01-01T00:00:00 is gregorian", "noleap",
                                                    "one calendar"};
  expect_error(ErrorKind::config, parts, [&] { (void)(a < b); });
  expect_error(ErrorKind::config, parts, [&] { (void)(a == b); });
  expect_error(ErrorKind::config, parts, [&] { (void)(a - b); });
  expect_error(ErrorKind::config, parts, [&] { parts_between(a, b); });
}

TEST_CASE("times beyond the range of years are refused") {
  CHECK_NOTHROW(at("+999999999-12-31T23:59:59.999999999"));
  CHECK_NOTHROW(at("-999999999-01-01"));
  const std::initializer_list<std::string> parts = {"-999999999 to 999999999"};
  expect_error(ErrorKind::config, parts, [] { at("+999999999-12-31T23:59:59") + lasting("PT1S"); });
  expect_error(ErrorKind::config, parts, [] { at("-999999999-01-01") - lasting("PT0.1S"); });
  expect_error(ErrorKind::config, parts, [] { at("-999999999-01-01") - lasting("P1M"); });
  expect_error(ErrorKind::config, parts, [] { Time(Calendar::day360, ExactSeconds(INT64_MIN)); });
  expect_error(ErrorKind::config, {"64 bits"},
               [] { at("2000-01-01") + TimeInterval::of_seconds(INT64_MAX); });
}
