// SPDX-License-Identifier: BSD-3-Clause
#include "time/exact_seconds.hpp"

#include <limits>

#include "support/expect_error.hpp"
#include "time/integers.hpp"

using namespace delos;
using delos::testing::expect_error;

namespace {
constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kSmallest = std::numeric_limits<std::int64_t>::min();
}  // namespace

TEST_CASE("exact seconds are kept in lowest terms with the fraction in 0 to 1") {
  CHECK(ExactSeconds(5, 7, 2) == ExactSeconds(8, 1, 2));
  CHECK(ExactSeconds(0, 4, 6).numerator() == 2);
  CHECK(ExactSeconds(0, 4, 6).denominator() == 3);
  CHECK(ExactSeconds(0, -1, 2) == ExactSeconds(-1, 1, 2));
  CHECK(ExactSeconds(3, 0, 17) == ExactSeconds(3));
  CHECK(ExactSeconds(-1, 1, 2).to_double() == -0.5);
  CHECK(ExactSeconds(-1, 1, 2).is_negative());
  CHECK_FALSE(ExactSeconds(0, 1, 2).is_negative());
  CHECK(ExactSeconds(1, -2, 2).is_zero());
}

TEST_CASE("exact seconds add, subtract and multiply without rounding") {
  CHECK(ExactSeconds(5, 1, 3) + ExactSeconds(2, 2, 3) == ExactSeconds(8));
  CHECK(ExactSeconds(0, 1, 3) - ExactSeconds(0, 1, 2) == ExactSeconds(-1, 5, 6));
  CHECK(-ExactSeconds(1, 1, 4) == ExactSeconds(-2, 3, 4));
  CHECK(ExactSeconds(1, 1, 3) * -3 == ExactSeconds(-4));
  CHECK(ExactSeconds(0, 1, kMaxDenominator) * kMaxDenominator == ExactSeconds(1));
  // Two steps of a third are not 0.666667.
  ExactSeconds sum;
  for (int k = 0; k < 300000; ++k) sum = sum + ExactSeconds(0, 1, 3);
  CHECK(sum == ExactSeconds(100000));
}

TEST_CASE("exact seconds are ordered as numbers") {
  CHECK(ExactSeconds(0, 1, 3) < ExactSeconds(0, 1, 2));
  CHECK(ExactSeconds(0, kMaxDenominator - 2, kMaxDenominator - 1) <
        ExactSeconds(0, kMaxDenominator - 1, kMaxDenominator));
  CHECK(ExactSeconds(-1, 1, 2) < ExactSeconds());
  CHECK(ExactSeconds(kSmallest) < ExactSeconds(kLargest, 1, 2));
}

TEST_CASE("ratios round down and remainders have the sign of the dividend") {
  CHECK(floor_ratio(ExactSeconds(7), ExactSeconds(2)) == 3);
  CHECK(floor_ratio(ExactSeconds(-7), ExactSeconds(2)) == -4);
  CHECK(floor_ratio(ExactSeconds(-8), ExactSeconds(2)) == -4);
  CHECK(floor_ratio(ExactSeconds(1), ExactSeconds(0, 1, 3)) == 3);
  CHECK(remainder(ExactSeconds(7), ExactSeconds(2)) == ExactSeconds(1));
  CHECK(remainder(ExactSeconds(-7), ExactSeconds(2)) == ExactSeconds(-1));
  CHECK(remainder(ExactSeconds(7), ExactSeconds(-2)) == ExactSeconds(1));
  CHECK(remainder(ExactSeconds(1), ExactSeconds(0, 3, 10)) == ExactSeconds(0, 1, 10));
  CHECK(remainder(ExactSeconds(kLargest, 1, 2), ExactSeconds(kLargest)) == ExactSeconds(0, 1, 2));
}

TEST_CASE("seconds beyond 64 bits and finer than the largest denominator are refused") {
  const auto refused = [](auto&& action) { expect_error(ErrorKind::config, {"64 bits"}, action); };
  refused([] { ExactSeconds(kLargest) + ExactSeconds(1); });
  refused([] { ExactSeconds(kLargest, 1, 2) + ExactSeconds(0, 1, 2); });
  refused([] { ExactSeconds(kSmallest) - ExactSeconds(0, 1, 2); });
  refused([] { -ExactSeconds(kSmallest); });
  refused([] { ExactSeconds(kLargest) * 2; });
  refused([] { floor_ratio(ExactSeconds(kLargest), ExactSeconds(0, 1, 2)); });
  refused([] { ExactSeconds(kLargest, 3, 2); });
  CHECK(ExactSeconds(kLargest) + ExactSeconds(kSmallest) == ExactSeconds(-1));
  CHECK(ExactSeconds(kSmallest) * 1 == ExactSeconds(kSmallest));
  const auto bad_denominator = [](std::int64_t denominator) {
    expect_error(ErrorKind::config, {std::to_string(denominator), "1 to 2147483647"},
                 [&] { ExactSeconds(0, 1, denominator); });
  };
  bad_denominator(0);
  bad_denominator(-2);
  bad_denominator(kMaxDenominator + 1);
  expect_error(ErrorKind::config, {"denominator", "Round"},
               [] { ExactSeconds(0, 1, 1000003) + ExactSeconds(0, 1, 999983); });
}

TEST_CASE("checked integers overflow loudly and floor division rounds down") {
  CHECK(checked_add(kLargest, -1) == kLargest - 1);
  CHECK(checked_multiply(kSmallest, 1) == kSmallest);
  expect_error(ErrorKind::config, {"9223372036854775807 + 1", "shorter intervals"},
               [] { checked_add(kLargest, 1); });
  expect_error(ErrorKind::config, {"-9223372036854775808 x -1"},
               [] { checked_multiply(kSmallest, -1); });
  CHECK(floor_divide(-1, 4) == -1);
  CHECK(floor_divide(-4, 4) == -1);
  CHECK(floor_divide(7, 4) == 1);
  CHECK(floor_modulo(-1, 4) == 3);
  CHECK(floor_modulo(-4, 4) == 0);
  CHECK(digits(7, 4) == "0007");
  CHECK(digits(12345, 4) == "12345");
}
