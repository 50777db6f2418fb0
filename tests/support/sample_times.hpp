// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Random times and intervals, from counters alone.
#include <algorithm>
#include <array>

#include "core/hash.hpp"
#include "time/iso8601.hpp"
#include "time/time.hpp"

namespace delos::samples {

inline constexpr std::array kCalendars = {Calendar::gregorian, Calendar::julian, Calendar::noleap,
                                          Calendar::day360};

/// The n-th number of a seed is the same wherever it is asked for.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : seed_(seed) {}
  /// Uniform in [first, last].
  std::int64_t in(std::int64_t first, std::int64_t last) {
    const auto n = static_cast<std::uint64_t>(last - first) + 1;
    return first + static_cast<std::int64_t>(hash64(seed_, next_++) % n);
  }
  bool one_in(std::int64_t n) { return in(1, n) == 1; }

  Calendar calendar() { return kCalendars[static_cast<std::size_t>(in(0, 3))]; }

  /// Every second one with a fraction, decimal or not.
  ExactSeconds exact_seconds(std::int64_t largest) {
    const std::int64_t whole = in(-largest, largest);
    if (one_in(2)) return ExactSeconds(whole);
    const std::int64_t denominator = one_in(2) ? 1000 : in(2, 700);
    return ExactSeconds(whole, in(0, denominator - 1), denominator);
  }

  /// Every third one on one of the last two days of its month.
  Time time(Calendar calendar, std::int64_t first_year, std::int64_t last_year) {
    DateTime when;
    when.year = in(first_year, last_year);
    when.month = static_cast<int>(in(1, 12));
    const int n_days = days_in_month(calendar, when.year, when.month);
    when.day = static_cast<int>(one_in(3) ? n_days - in(0, 1) : in(1, n_days));
    when.hour = static_cast<int>(in(0, 23));
    when.minute = static_cast<int>(in(0, 59));
    when.second = static_cast<int>(in(0, 59));
    const ExactSeconds fraction = exact_seconds(0);
    when.numerator = fraction.numerator();
    when.denominator = fraction.denominator();
    return {calendar, when};
  }

 private:
  std::uint64_t seed_;
  std::uint64_t next_ = 0;
};

/// A time as text is how tests write it.
inline Time at(const char* text, Calendar calendar = Calendar::gregorian) {
  return parse_time(calendar, text);
}
inline TimeInterval lasting(const char* text) { return parse_interval(text); }

}  // namespace delos::samples
