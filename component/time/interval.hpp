// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How long: months of a calendar plus exact seconds.
#include <compare>
#include <cstdint>

#include "time/exact_seconds.hpp"

namespace delos {

/// Years are 12 months and days 86400 seconds in every calendar; only a month has no fixed length.
/// An interval without months is absolute, one with months is of the calendar of the time that it
/// is added to. The parts may have different signs.
class TimeInterval {
 public:
  /// Zero.
  TimeInterval() = default;
  TimeInterval(std::int64_t n_months, const ExactSeconds& seconds)
      : months_(n_months), seconds_(seconds) {}
  static TimeInterval of_years(std::int64_t n);
  static TimeInterval of_months(std::int64_t n) { return {n, ExactSeconds()}; }
  static TimeInterval of_days(std::int64_t n);
  static TimeInterval of_hours(std::int64_t n);
  static TimeInterval of_minutes(std::int64_t n);
  /// n + numerator / denominator seconds.
  static TimeInterval of_seconds(std::int64_t n, std::int64_t numerator = 0,
                                 std::int64_t denominator = 1);

  std::int64_t months() const { return months_; }
  const ExactSeconds& seconds() const { return seconds_; }
  bool is_absolute() const { return months_ == 0; }
  bool is_zero() const { return months_ == 0 && seconds_.is_zero(); }
  /// No part is negative and one is positive: it leads forward from every time.
  bool is_positive() const { return !is_zero() && months_ >= 0 && !seconds_.is_negative(); }

  friend bool operator==(const TimeInterval&, const TimeInterval&) = default;

 private:
  std::int64_t months_ = 0;
  ExactSeconds seconds_;
};

/// By months and seconds. Error(config) when one has more months and the other more seconds: then
/// the order depends on where they start.
std::strong_ordering operator<=>(const TimeInterval& a, const TimeInterval& b);

TimeInterval operator+(const TimeInterval& a, const TimeInterval& b);
TimeInterval operator-(const TimeInterval& a, const TimeInterval& b);
TimeInterval operator-(const TimeInterval& a);
TimeInterval operator*(const TimeInterval& a, std::int64_t factor);

/// a / b, rounded. Error(config) when b is zero or they are not both absolute or both whole months.
double ratio(const TimeInterval& a, const TimeInterval& b);
/// a - q b with q = a / b rounded to zero; errors as for ratio.
TimeInterval remainder(const TimeInterval& a, const TimeInterval& b);

/// An interval in units, each part less than one of the next larger unit, rounded to zero: months
/// and years have one sign, days to the fraction of a second have one sign.
struct IntervalParts {
  std::int64_t years, months, days, hours, minutes, seconds;
  std::int64_t numerator, denominator;  ///< of a second, in lowest terms; the numerator is signed
  friend bool operator==(const IntervalParts&, const IntervalParts&) = default;
};

/// Months become years and months, seconds become days, hours, minutes and seconds.
IntervalParts parts(const TimeInterval& interval);

}  // namespace delos
