// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/units.hpp"

#include <doctest/doctest.h>

using delos::Dimension;
using delos::parse_quantity;

namespace {

double value(const char* text, Dimension dimension) {
  const delos::Quantity quantity = parse_quantity(text, dimension);
  CHECK_MESSAGE(quantity.error.empty(), quantity.error);
  return quantity.value;
}

bool error_has(const char* text, Dimension dimension, const char* part) {
  const delos::Quantity quantity = parse_quantity(text, dimension);
  CAPTURE(quantity.error);
  return quantity.error.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("quantities are converted to metres, degrees, seconds, m/s and m2/s2") {
  CHECK(value("30 km", Dimension::length) == 30000.0);
  CHECK(value("30km", Dimension::length) == 30000.0);
  CHECK(value("  1.5e3 m ", Dimension::length) == 1500.0);
  CHECK(value("+2 m", Dimension::length) == 2.0);
  CHECK(value("-2 m", Dimension::length) == -2.0);
  CHECK(value("0.5 deg", Dimension::angle) == 0.5);
  CHECK(value("30 arcmin", Dimension::angle) == doctest::Approx(0.5));
  CHECK(value("1 rad", Dimension::angle) == doctest::Approx(57.29577951308232));
  CHECK(value("12.42 h", Dimension::time) == doctest::Approx(44712.0));
  CHECK(value("1 d", Dimension::time) == 86400.0);
  CHECK(value("45 cm/s", Dimension::speed) == doctest::Approx(0.45));
  CHECK(value("200 cm2/s2", Dimension::energy) == doctest::Approx(0.02));
  CHECK(value("0.02 m2 s-2", Dimension::energy) == 0.02);
  CHECK(value("0.15", Dimension::none) == 0.15);
}

TEST_CASE("a missing unit is named together with an example") {
  CHECK(error_has("60", Dimension::length, "'60' has no unit"));
  CHECK(error_has("60", Dimension::length, "60 km"));
  CHECK(error_has("0.5", Dimension::angle, "deg"));
}

TEST_CASE("a unit of another dimension is refused with both dimensions named") {
  CHECK(error_has("60 s", Dimension::length, "is a time, but a length is needed"));
  CHECK(error_has("60 km", Dimension::none, "is a length, but a number without unit is needed"));
}

TEST_CASE("an unknown unit is refused with the known ones") {
  CHECK(error_has("60 furlong", Dimension::length, "unknown unit 'furlong'"));
  CHECK(error_has("60 furlong", Dimension::length, "m or km"));
  CHECK(error_has("60 KM", Dimension::length, "unknown unit 'KM'"));
}

TEST_CASE("what is no finite number is refused") {
  for (const char* const text : {"", "km", "sixty km", "nan km", "inf km", "1e999 km", "--1 km"}) {
    CAPTURE(text);
    CHECK(error_has(text, Dimension::length, "is not a length"));
  }
  CHECK(error_has("1,5 km", Dimension::length, "unknown unit"));
}
