// SPDX-License-Identifier: BSD-3-Clause
#include "time/exact_seconds.hpp"

#include <limits>
#include <numeric>
#include <string>

#include "core/error.hpp"
#include "time/integers.hpp"

namespace delos {
namespace {

// Holds 64-bit seconds in units of 1 / (denominator x denominator): 63 + 62 bits and a sign.
__extension__ using Wide = __int128;

// Two numbers as integers over one denominator.
struct Common {
  Wide a, b;
  std::int64_t denominator;
};

Common over_common_denominator(const ExactSeconds& a, const ExactSeconds& b) {
  const std::int64_t denominator = std::lcm(a.denominator(), b.denominator());
  const auto scaled = [denominator](const ExactSeconds& x) {
    return static_cast<Wide>(x.whole()) * denominator +
           x.numerator() * (denominator / x.denominator());
  };
  return {scaled(a), scaled(b), denominator};
}

std::int64_t narrowed(Wide value) {
  const bool fits = value >= std::numeric_limits<std::int64_t>::min() &&
                    value <= std::numeric_limits<std::int64_t>::max();
  DELOS_CHECK(fits, ErrorKind::config,
              "time arithmetic overflows: the result does not fit 64 bits. Use nearer times or "
              "shorter intervals.");
  return static_cast<std::int64_t>(value);
}

// whole + numerator / denominator, brought to lowest terms before the limit is looked at.
ExactSeconds assembled(Wide whole, Wide numerator, std::int64_t denominator) {
  whole += numerator / denominator;
  auto rest = static_cast<std::int64_t>(numerator % denominator);
  if (rest < 0) {
    rest += denominator;
    whole -= 1;
  }
  const std::int64_t divisor = std::gcd(rest, denominator);
  return ExactSeconds(narrowed(whole), rest / divisor, denominator / divisor);
}

}  // namespace

ExactSeconds::ExactSeconds(std::int64_t whole, std::int64_t numerator, std::int64_t denominator) {
  DELOS_CHECK(denominator >= 1 && denominator <= kMaxDenominator, ErrorKind::config,
              "a fraction of a second has the denominator ", std::to_string(denominator),
              ": must be in 1 to ", std::to_string(kMaxDenominator),
              ". Round it, e.g. to nanoseconds.");
  whole_ = checked_add(whole, floor_divide(numerator, denominator));
  const std::int64_t rest = floor_modulo(numerator, denominator);
  const std::int64_t divisor = std::gcd(rest, denominator);
  numerator_ = rest / divisor;
  denominator_ = denominator / divisor;
}

double ExactSeconds::to_double() const {
  return static_cast<double>(whole_) +
         static_cast<double>(numerator_) / static_cast<double>(denominator_);
}

std::strong_ordering operator<=>(const ExactSeconds& a, const ExactSeconds& b) {
  if (a.whole_ != b.whole_) return a.whole_ <=> b.whole_;
  return a.numerator_ * b.denominator_ <=> b.numerator_ * a.denominator_;
}

ExactSeconds operator+(const ExactSeconds& a, const ExactSeconds& b) {
  const Common both = over_common_denominator(a, b);
  return assembled(0, both.a + both.b, both.denominator);
}

ExactSeconds operator-(const ExactSeconds& a, const ExactSeconds& b) {
  const Common both = over_common_denominator(a, b);
  return assembled(0, both.a - both.b, both.denominator);
}

ExactSeconds operator-(const ExactSeconds& a) { return ExactSeconds() - a; }

ExactSeconds operator*(const ExactSeconds& a, std::int64_t factor) {
  return assembled(static_cast<Wide>(a.whole()) * factor, static_cast<Wide>(a.numerator()) * factor,
                   a.denominator());
}

std::int64_t floor_ratio(const ExactSeconds& a, const ExactSeconds& b) {
  DELOS_ASSERT(!b.is_negative() && !b.is_zero());
  const Common both = over_common_denominator(a, b);
  const Wide quotient = both.a / both.b;
  return narrowed(both.a % both.b < 0 ? quotient - 1 : quotient);
}

ExactSeconds remainder(const ExactSeconds& a, const ExactSeconds& b) {
  DELOS_ASSERT(!b.is_zero());
  const Common both = over_common_denominator(a, b);
  return assembled(0, both.a % both.b, both.denominator);
}

}  // namespace delos
