// SPDX-License-Identifier: BSD-3-Clause
#include "time/interval.hpp"

#include <limits>

#include "support/expect_error.hpp"
#include "support/sample_times.hpp"

using namespace delos;
using delos::samples::lasting;
using delos::testing::expect_error;

TEST_CASE("a year is twelve months and a day has 86400 seconds") {
  CHECK(TimeInterval::of_years(1) == TimeInterval::of_months(12));
  CHECK(TimeInterval::of_days(1) == TimeInterval::of_hours(24));
  CHECK(TimeInterval::of_hours(1) == TimeInterval::of_minutes(60));
  CHECK(TimeInterval::of_minutes(1) == TimeInterval::of_seconds(60));
  CHECK(TimeInterval::of_days(-2).is_absolute());
  CHECK_FALSE(TimeInterval::of_months(1).is_absolute());
  CHECK(TimeInterval().is_zero());
}

TEST_CASE("an interval is forward when no part is negative and one is positive") {
  CHECK(lasting("P1M").is_positive());
  CHECK(lasting("PT0.001S").is_positive());
  CHECK_FALSE(TimeInterval().is_positive());
  CHECK_FALSE(lasting("-PT1S").is_positive());
  CHECK_FALSE(lasting("P1M-1D").is_positive());
  CHECK_FALSE(lasting("P-1M40D").is_positive());
}

TEST_CASE("intervals add, subtract, negate and multiply part by part") {
  CHECK(lasting("P1Y2M10DT2H30M") + lasting("P-1Y1DT-30M") == lasting("P2M11DT2H"));
  CHECK(lasting("P1M") - lasting("P1D") == lasting("P1M-1D"));
  CHECK(-lasting("P1M-1D") == lasting("P-1M1D"));
  CHECK(lasting("P1MT0:1/3S") * 3 == lasting("P3MT1S"));
  CHECK(lasting("P1M") * 0 == TimeInterval());
  const std::int64_t largest = std::numeric_limits<std::int64_t>::max();
  for (const auto make : {TimeInterval::of_years, TimeInterval::of_days, TimeInterval::of_hours,
                          TimeInterval::of_minutes}) {
    expect_error(ErrorKind::config, {"64 bits"}, [&] { make(largest); });
  }
  expect_error(ErrorKind::config, {"64 bits"},
               [&] { TimeInterval::of_months(largest) + TimeInterval::of_months(1); });
}

TEST_CASE("intervals are ordered where the order does not depend on their start") {
  CHECK(lasting("PT1H") < lasting("PT61M"));
  CHECK(lasting("P1Y") > lasting("P11M"));
  CHECK(lasting("P1M") > TimeInterval());
  CHECK(lasting("P1M1D") < lasting("P1M2D"));
  CHECK(lasting("P1M1D") < lasting("P2M1D"));
  CHECK(lasting("-P1M") < TimeInterval());
  expect_error(ErrorKind::config, {"P0Y1M0DT0H0M0S", "P0Y0M30DT0H0M0S", "no fixed length"},
               [] { (void)(lasting("P1M") < lasting("P30D")); });
}

TEST_CASE("intervals divide when both are absolute or both are whole months") {
  CHECK(ratio(lasting("PT7H"), lasting("PT2H")) == 3.5);
  CHECK(ratio(lasting("P1Y"), lasting("P8M")) == 1.5);
  CHECK(ratio(TimeInterval(), lasting("P8M")) == 0.0);
  CHECK(remainder(lasting("PT7H"), lasting("PT2H")) == lasting("PT1H"));
  CHECK(remainder(lasting("-PT7H"), lasting("PT2H")) == lasting("-PT1H"));
  CHECK(remainder(lasting("P1Y"), lasting("P5M")) == lasting("P2M"));
  CHECK(remainder(TimeInterval::of_months(INT64_MIN), lasting("-P1M")) == TimeInterval());
  expect_error(ErrorKind::config, {"P0Y0M0DT7H0M0S", "interval of zero"},
               [] { ratio(lasting("PT7H"), TimeInterval()); });
  expect_error(ErrorKind::config, {"P0Y1M0DT0H0M0S", "P0Y0M1DT0H0M0S", "whole months"},
               [] { remainder(lasting("P1M"), lasting("P1D")); });
  expect_error(ErrorKind::config, {"whole months"},
               [] { ratio(lasting("P1M"), lasting("P1M1D")); });
}

TEST_CASE("parts are rounded to zero and have one sign") {
  const IntervalParts day = parts(lasting("PT25H"));
  CHECK(day == IntervalParts{0, 0, 1, 1, 0, 0, 0, 1});
  CHECK(parts(lasting("-PT90S")) == IntervalParts{0, 0, 0, 0, -1, -30, 0, 1});
  CHECK(parts(lasting("-PT90.5S")) == IntervalParts{0, 0, 0, 0, -1, -30, -1, 2});
  CHECK(parts(lasting("-PT0.25S")) == IntervalParts{0, 0, 0, 0, 0, 0, -1, 4});
  CHECK(parts(lasting("P14M-1DT1:1/3S")) == IntervalParts{1, 2, 0, -23, -59, -58, -2, 3});
}
