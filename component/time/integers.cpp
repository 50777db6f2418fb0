// SPDX-License-Identifier: BSD-3-Clause
#include "time/integers.hpp"

#include "core/error.hpp"

namespace delos {
namespace {

[[noreturn]] void overflow(std::int64_t a, const char* operation, std::int64_t b) {
  throw Error(ErrorKind::config,
              text("time arithmetic overflows: ", std::to_string(a), operation, std::to_string(b),
                   " does not fit 64 bits. Use nearer times or shorter intervals."));
}

}  // namespace

std::int64_t checked_add(std::int64_t a, std::int64_t b) {
  std::int64_t sum = 0;
  if (__builtin_add_overflow(a, b, &sum)) overflow(a, " + ", b);
  return sum;
}

std::int64_t checked_multiply(std::int64_t a, std::int64_t b) {
  std::int64_t product = 0;
  if (__builtin_mul_overflow(a, b, &product)) overflow(a, " x ", b);
  return product;
}

std::string digits(std::int64_t not_negative, int least) {
  const std::string plain = std::to_string(not_negative);
  const auto width = static_cast<std::size_t>(least);
  return plain.size() >= width ? plain : std::string(width - plain.size(), '0') + plain;
}

}  // namespace delos
