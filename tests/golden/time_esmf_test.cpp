// SPDX-License-Identifier: BSD-3-Clause
// esmf_time.txt holds what ESMF's time manager prints. Here the same lines are made with our own
// and compared, line by line, but for the number of spaces.
#include <doctest/doctest.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "time/clock.hpp"
#include "time/iso8601.hpp"

using namespace delos;

namespace {

using Lines = std::vector<std::string>;

// ESMF's return codes: success, an argument out of range, an object that was not set.
constexpr int kSuccess = 0;
constexpr int kOutOfRange = 516;
constexpr int kNotSet = 2;

std::string single_spaced(const std::string& line) {
  std::istringstream words(line);
  std::string result;
  for (std::string word; words >> word;) result += (result.empty() ? "" : " ") + word;
  return result;
}

Lines read_golden() {
  std::ifstream file(DELOS_SOURCE_DIR "/tests/golden/esmf_time.txt");
  Lines lines;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line.front() != '#') lines.push_back(single_spaced(line));
  }
  return lines;
}

std::string fixed(double value, int n_decimals) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", n_decimals, value);
  return buffer;
}

const char* letter(bool value) { return value ? "T" : "F"; }

struct Increment {
  const char* base;
  int years, months, days;
};

void add_calendar_rows(Lines& lines) {
  const std::vector<std::pair<const char*, Calendar>> calendars = {
      {"GREGORIAN", Calendar::gregorian},
      {"NOLEAP", Calendar::noleap},
      {"360DAY", Calendar::day360},
      {"JULIAN", Calendar::julian},
  };
  const std::vector<Increment> increments = {
      {"2000-01-30", 0, 1, 0},  {"2001-01-30", 0, 1, 0}, {"2000-02-28", 0, 0, 1},
      {"1999-12-30", 0, 14, 2}, {"2000-02-29", 1, 0, 0}, {"1900-02-28", 0, 0, 1},
      {"2000-03-30", 0, -1, 0},
  };
  for (const auto& [name, calendar] : calendars) {
    // A date that is refused leaves the sum of the row before, which ESMF then prints again.
    Time sum = parse_time(calendar, "0001-01-01");
    for (const Increment& increment : increments) {
      int set_code = kSuccess;
      try {
        sum = parse_time(calendar, increment.base) + TimeInterval::of_years(increment.years) +
              TimeInterval::of_months(increment.months) + TimeInterval::of_days(increment.days);
      } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::config);
        set_code = kOutOfRange;
      }
      lines.push_back(text(name, " ", increment.base, " + y,m,d ", increment.years, " ",
                           increment.months, " ", increment.days, " -> ", iso_text(sum), " doy ",
                           sum.day_of_year(), " rc ", set_code, " ",
                           set_code == kSuccess ? kSuccess : kNotSet));
    }
  }
}

void add_interval_rows(Lines& lines) {
  const Calendar gregorian = Calendar::gregorian;
  const Time start = parse_time(gregorian, "1850-01-01");
  const Time end = parse_time(gregorian, "2000-01-01");
  const TimeInterval between = end - start;
  lines.push_back("GREGORIAN 2000-01-31 + 1 mm -> " +
                  iso_text(parse_time(gregorian, "2000-01-31") + TimeInterval::of_months(1)) +
                  " rc 0");
  bool is_refused = false;
  try {
    parse_time(gregorian, "2000-02-30");
  } catch (const Error&) {
    is_refused = true;
  }
  lines.push_back(text("TimeSet 2000-02-30 rc=", is_refused ? kOutOfRange : kSuccess));
  lines.push_back(text("Gregorian 2000-01-01 - 1850-01-01 seconds = ", between.seconds().whole()));
  const IntervalParts calendar_parts = parts_between(start, start + between);
  lines.push_back(text("same interval from startTime as yy mm d: ", calendar_parts.years, " ",
                       calendar_parts.months, " ", calendar_parts.days));
  const ExactSeconds eight = ExactSeconds(5, 1, 3) + ExactSeconds(2, 2, 3);
  lines.push_back("5 1/3 s + 2 2/3 s = " + fixed(eight.to_double(), 15));
  const TimeInterval long_day = TimeInterval::of_hours(25);
  const IntervalParts day = parts(long_day);
  lines.push_back(
      text("25h as d h m s ", day.days, " ", day.hours, " ", day.minutes, " ", day.seconds));
  lines.push_back("25h ISO " + iso_text(long_day));
  const IntervalParts negative = parts(TimeInterval::of_seconds(-90));
  lines.push_back(text("-90 s as m s ", negative.minutes, " ", negative.seconds));
  const TimeInterval seven = TimeInterval::of_hours(7), two = TimeInterval::of_hours(2);
  lines.push_back("7h / 2h = " + fixed(ratio(seven, two), 3) + " (real)");
  lines.push_back(text("mod(7h,2h) s = ", remainder(seven, two).seconds().whole()));
}

void add_clock_rows(Lines& lines) {
  const Time start = parse_time(Calendar::gregorian, "2000-01-01");
  const auto hours = [](std::int64_t n) { return TimeInterval::of_hours(n); };
  Clock clock({.start = start, .stop = start + parse_interval("PT6H30M"), .step = hours(1)});
  const int a1 = clock.add_alarm({.ring_time = start + hours(2), .interval = hours(2)});
  const int a2 = clock.add_alarm({.interval = hours(3), .sticky = false, .ring_duration = {}});
  const int a3 = clock.add_alarm({.ring_time = start + parse_interval("PT1H30M")});
  const int a4 = clock.add_alarm({.interval = hours(2)});
  constexpr int kSteps = 8;
  int code = kSuccess;
  for (int step = 0; step <= kSteps; ++step) {
    const auto rings = [&](int id) { return letter(clock.alarm(id).is_ringing()); };
    const char* const done = letter(clock.is_done());
    lines.push_back(text(step, " ", clock.advance_count(), " ", iso_text(clock.current()), " ",
                         done, " ", done, " | ", rings(a1), " ", rings(a4), " ", rings(a2), " ",
                         rings(a3)));
    if (clock.alarm(a1).is_ringing() && step % 2 == 0) clock.alarm(a1).ringer_off();
    if (step == kSteps) break;
    try {
      clock.advance();
    } catch (const Error&) {
      code = kOutOfRange;
    }
  }
  lines.push_back(text("advance beyond stopTime rc=", code));
}

}  // namespace

TEST_CASE("calendars, intervals, clock and alarms do what ESMF does") {
  Lines ours;
  add_calendar_rows(ours);
  add_interval_rows(ours);
  add_clock_rows(ours);
  const Lines golden = read_golden();
  REQUIRE(golden.size() == ours.size());
  CHECK(golden.size() == 48);
  for (std::size_t k = 0; k < golden.size(); ++k) CHECK(ours[k] == golden[k]);
}
