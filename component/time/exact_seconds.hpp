// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A number of seconds without rounding: an integer and a fraction.
#include <compare>
#include <cstdint>

namespace delos {

/// Denominators go up to 2^31 - 1, so that the product of two fits 64 bits: nanoseconds and more.
inline constexpr std::int64_t kMaxDenominator = 2147483647;

/// whole + numerator / denominator with 0 <= numerator < denominator <= kMaxDenominator, in lowest
/// terms: equal numbers have equal members. -0.5 s is -1 + 1/2.
class ExactSeconds {
 public:
  ExactSeconds() = default;
  /// Any numerator, e.g. 7/2. Error(config) unless 1 <= denominator <= kMaxDenominator.
  explicit ExactSeconds(std::int64_t whole, std::int64_t numerator = 0,
                        std::int64_t denominator = 1);

  std::int64_t whole() const { return whole_; }
  std::int64_t numerator() const { return numerator_; }
  std::int64_t denominator() const { return denominator_; }
  bool is_zero() const { return whole_ == 0 && numerator_ == 0; }
  bool is_negative() const { return whole_ < 0; }
  /// The nearest double, but for the rounding of two additions.
  double to_double() const;

  friend bool operator==(const ExactSeconds&, const ExactSeconds&) = default;
  friend std::strong_ordering operator<=>(const ExactSeconds& a, const ExactSeconds& b);

 private:
  std::int64_t whole_ = 0;
  std::int64_t numerator_ = 0;
  std::int64_t denominator_ = 1;
};

// Exact; Error(config) when the result does not fit 64 bits or its denominator kMaxDenominator.
ExactSeconds operator+(const ExactSeconds& a, const ExactSeconds& b);
ExactSeconds operator-(const ExactSeconds& a, const ExactSeconds& b);
ExactSeconds operator-(const ExactSeconds& a);
ExactSeconds operator*(const ExactSeconds& a, std::int64_t factor);

/// The largest integer q with q b <= a; b > 0.
std::int64_t floor_ratio(const ExactSeconds& a, const ExactSeconds& b);
/// a - q b with q = a / b rounded to zero, so it has the sign of a; b is not zero.
ExactSeconds remainder(const ExactSeconds& a, const ExactSeconds& b);

}  // namespace delos
