// SPDX-License-Identifier: BSD-3-Clause
#include "time/iso8601.hpp"

#include <locale>

#include "support/expect_error.hpp"

using namespace delos;
using delos::testing::expect_error;

namespace {

std::string again(const char* text) { return iso_text(parse_time(Calendar::gregorian, text)); }
std::string interval_again(const char* text) { return iso_text(parse_interval(text)); }

void time_is_refused(const char* text, std::initializer_list<std::string> parts) {
  CAPTURE(text);
  expect_error(ErrorKind::config, parts, [&] { parse_time(Calendar::gregorian, text); });
}

}  // namespace

TEST_CASE("times are read with and without time of day and written in full") {
  CHECK(again("2000-02-29") == "2000-02-29T00:00:00");
  CHECK(again("2000-02-29T06:30") == "2000-02-29T06:30:00");
  CHECK(again("2000-02-29 06:30:01") == "2000-02-29T06:30:01");
  CHECK(again("0000-01-01") == "0000-01-01T00:00:00");
  CHECK(again("-0044-03-15") == "-0044-03-15T00:00:00");
  CHECK(again("+12345-01-01") == "+12345-01-01T00:00:00");
  CHECK(again("+2000-01-01") == "2000-01-01T00:00:00");
}

TEST_CASE("fractions of a second are decimal where that is exact, else a ratio") {
  CHECK(again("2000-01-01T00:00:05.25") == "2000-01-01T00:00:05.25");
  CHECK(again("2000-01-01T00:00:05,250") == "2000-01-01T00:00:05.25");
  CHECK(again("2000-01-01T00:00:05:1/4") == "2000-01-01T00:00:05.25");
  CHECK(again("2000-01-01T00:00:05:1/3") == "2000-01-01T00:00:05:1/3");
  CHECK(again("2000-01-01T00:00:05.000000001") == "2000-01-01T00:00:05.000000001");
  CHECK(again("2000-01-01T00:00:05:1/1024") == "2000-01-01T00:00:05:1/1024");
  CHECK(again("2000-01-01T00:00:05.000") == "2000-01-01T00:00:05");
}

TEST_CASE("what is no time is refused with an example") {
  for (const char* const text : {"",
                                 "2000",
                                 "2000-01",
                                 "20000101",
                                 "2000-1-1",
                                 "200-01-01",
                                 "12345-01-01",
                                 "2000-01-01T",
                                 "2000-01-01T06",
                                 "2000-01-01T6:30",
                                 "2000-01-01T06:30:",
                                 "2000-01-01T06:30:00.",
                                 "2000-01-01T06:30:00.0123456789",
                                 "2000-01-01T06:30:00:3/3",
                                 "2000-01-01T06:30:00:1/0",
                                 "2000-01-01T06:30:00:1/2147483648",
                                 "2000-01-01t06:30",
                                 " 2000-01-01",
                                 "2000-01-01 ",
                                 "2000-01-01T06:30:00x",
                                 "+99999999999-01-01",
                                 "2000/01/01",
                                 "today"}) {
    time_is_refused(text, {"is not a time", "2000-01-31T06:30:00"});
  }
}

TEST_CASE("time zones, leap seconds and dates that do not exist are refused by name") {
  time_is_refused("2000-01-01T06:30:00Z", {"2000-01-01T06:30:00Z", "time zone"});
  time_is_refused("2000-01-01T06:30:00+01:00", {"time zone", "Leave"});
  time_is_refused("2000-01-01T06:30-05", {"time zone"});
  time_is_refused("2000-01-01T24:00:00", {"the hour 24"});
  time_is_refused("2016-12-31T23:59:60", {"the second 60"});
  time_is_refused("2001-02-29", {"2001-02-29", "28 days"});
  time_is_refused("+1000000000-01-01", {"the year 1000000000"});
  expect_error(ErrorKind::config, {"2000-01-31", "30 days", "360_day"},
               [] { parse_time(Calendar::day360, "2000-01-31"); });
}

TEST_CASE("intervals are read in any units in order and written in all") {
  CHECK(interval_again("P1Y2M10DT2H30M") == "P1Y2M10DT2H30M0S");
  CHECK(interval_again("PT25H") == "P0Y0M1DT1H0M0S");
  CHECK(interval_again("P14M") == "P1Y2M0DT0H0M0S");
  CHECK(interval_again("P2W") == "P0Y0M14DT0H0M0S");
  CHECK(interval_again("PT90S") == "P0Y0M0DT0H1M30S");
  CHECK(interval_again("PT0S") == "P0Y0M0DT0H0M0S");
  CHECK(interval_again("-PT90S") == "P0Y0M0DT0H-1M-30S");
  CHECK(interval_again("-P1MT-1S") == "P0Y-1M0DT0H0M1S");
  CHECK(interval_again("P1M-1D") == "P0Y1M-1DT0H0M0S");
}

TEST_CASE("the last part of an interval may have a fraction") {
  CHECK(interval_again("PT0.5S") == "P0Y0M0DT0H0M0.5S");
  CHECK(interval_again("PT0,5S") == "P0Y0M0DT0H0M0.5S");
  CHECK(interval_again("-PT0.5S") == "P0Y0M0DT0H0M-0.5S");
  CHECK(interval_again("P1.5D") == "P0Y0M1DT12H0M0S");
  CHECK(interval_again("P0.5W") == "P0Y0M3DT12H0M0S");
  CHECK(interval_again("PT1H0.125M") == "P0Y0M0DT1H0M7.5S");
  CHECK(interval_again("PT5:1/3S") == "P0Y0M0DT0H0M5:1/3S");
  CHECK(interval_again("-PT0:1/3S") == "P0Y0M0DT0H0M-0:1/3S");
  // A nanosecond of a day is not one of a second.
  CHECK(parse_interval("P0.000000001D") == TimeInterval::of_seconds(0, 86400, 1000000000));
}

TEST_CASE("what is no interval is refused with an example") {
  for (const char* const text : {"",
                                 "P",
                                 "PT",
                                 "1D",
                                 "P1",
                                 "P1S",
                                 "PT1D",
                                 "P1DT",
                                 "P1D2M",
                                 "P1M1M",
                                 "PT1M1H",
                                 "P1.5Y",
                                 "P0.5M",
                                 "P1.5DT1H",
                                 "PT1.5H30M",
                                 "P1D ",
                                 "p1d",
                                 "PT.5S",
                                 "PT5.S",
                                 "P--1D",
                                 "PT1:1/3",
                                 "P1:1/3D",
                                 "PT0.0123456789S",
                                 "PT99999999999999999999S",
                                 "P1Y2",
                                 "hourly"}) {
    CAPTURE(text);
    expect_error(ErrorKind::config, {text, "is not an interval", "P1Y2M10DT2H30M"},
                 [&] { parse_interval(text); });
  }
  expect_error(ErrorKind::config, {"64 bits"}, [] { parse_interval("P9223372036854775807D"); });
  expect_error(ErrorKind::config, {"64 bits"}, [] { parse_interval("P9223372036854775807Y"); });
}

TEST_CASE("the text does not depend on the host's locale") {
  struct Grouping : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale(), new Grouping));
  const std::string time = again("+12345-01-01T00:00:05.25");
  const std::string interval = interval_again("P12345D");
  std::string message;
  try {
    parse_time(Calendar::gregorian, "+1234567890-01-01");
  } catch (const Error& error) {
    message = error.what();
  }
  std::locale::global(before);
  CHECK(time == "+12345-01-01T00:00:05.25");
  CHECK(interval == "P0Y0M12345DT0H0M0S");
  CHECK(message.find("1234567890") != std::string::npos);
}
