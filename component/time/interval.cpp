// SPDX-License-Identifier: BSD-3-Clause
#include "time/interval.hpp"

#include "core/error.hpp"
#include "time/calendar.hpp"
#include "time/integers.hpp"
#include "time/iso8601.hpp"

namespace delos {
namespace {

// Both absolute or both whole months, and the divisor not zero.
void check_division(const TimeInterval& a, const TimeInterval& b) {
  DELOS_CHECK(!b.is_zero(), ErrorKind::config, "the interval ", iso_text(a),
              " is divided by an interval of zero. Give one that is longer.");
  const bool both_absolute = a.is_absolute() && b.is_absolute();
  const bool both_months = a.seconds().is_zero() && b.seconds().is_zero();
  DELOS_CHECK(both_absolute || both_months, ErrorKind::config, "the interval ", iso_text(a),
              " can't be divided by ", iso_text(b),
              ": a month has no fixed length. Give both without months, or both in whole months.");
}

}  // namespace

TimeInterval TimeInterval::of_years(std::int64_t n) {
  return of_months(checked_multiply(n, kMonthsPerYear));
}
TimeInterval TimeInterval::of_days(std::int64_t n) {
  return of_seconds(checked_multiply(n, kSecondsPerDay));
}
TimeInterval TimeInterval::of_hours(std::int64_t n) {
  return of_seconds(checked_multiply(n, kSecondsPerHour));
}
TimeInterval TimeInterval::of_minutes(std::int64_t n) {
  return of_seconds(checked_multiply(n, kSecondsPerMinute));
}
TimeInterval TimeInterval::of_seconds(std::int64_t n, std::int64_t numerator,
                                      std::int64_t denominator) {
  return {0, ExactSeconds(n, numerator, denominator)};
}

std::strong_ordering operator<=>(const TimeInterval& a, const TimeInterval& b) {
  const std::strong_ordering by_months = a.months() <=> b.months();
  const std::strong_ordering by_seconds = a.seconds() <=> b.seconds();
  if (by_months == 0) return by_seconds;
  DELOS_CHECK(by_seconds == 0 || by_seconds == by_months, ErrorKind::config, "the intervals ",
              iso_text(a), " and ", iso_text(b),
              " can't be compared: a month has no fixed length. Add both to one time first.");
  return by_months;
}

TimeInterval operator+(const TimeInterval& a, const TimeInterval& b) {
  return {checked_add(a.months(), b.months()), a.seconds() + b.seconds()};
}
TimeInterval operator-(const TimeInterval& a, const TimeInterval& b) { return a + (-b); }
TimeInterval operator-(const TimeInterval& a) { return a * -1; }
TimeInterval operator*(const TimeInterval& a, std::int64_t factor) {
  return {checked_multiply(a.months(), factor), a.seconds() * factor};
}

double ratio(const TimeInterval& a, const TimeInterval& b) {
  check_division(a, b);
  if (b.is_absolute()) return a.seconds().to_double() / b.seconds().to_double();
  return static_cast<double>(a.months()) / static_cast<double>(b.months());
}

TimeInterval remainder(const TimeInterval& a, const TimeInterval& b) {
  check_division(a, b);
  if (b.is_absolute()) return {0, remainder(a.seconds(), b.seconds())};
  // The one quotient that overflows has no remainder.
  return TimeInterval::of_months(b.months() == -1 ? 0 : a.months() % b.months());
}

IntervalParts parts(const TimeInterval& interval) {
  const ExactSeconds& exact = interval.seconds();
  // Rounded to zero: a negative number of seconds is whole + 1 and a negative fraction.
  const bool borrow = exact.is_negative() && exact.numerator() != 0;
  std::int64_t rest = exact.whole() + (borrow ? 1 : 0);
  IntervalParts result{};
  result.years = interval.months() / kMonthsPerYear;
  result.months = interval.months() % kMonthsPerYear;
  result.days = rest / kSecondsPerDay;
  rest %= kSecondsPerDay;
  result.hours = rest / kSecondsPerHour;
  rest %= kSecondsPerHour;
  result.minutes = rest / kSecondsPerMinute;
  result.seconds = rest % kSecondsPerMinute;
  result.numerator = exact.numerator() - (borrow ? exact.denominator() : 0);
  result.denominator = exact.denominator();
  return result;
}

}  // namespace delos
