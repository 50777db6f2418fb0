// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Quantities as people write them: "30 km", "0.5 deg", "12.42 h", "0.45 m/s", "0.02 m2/s2".
#include <string>
#include <string_view>

namespace delos {

/// What a number measures. Values are handed on in m, degrees, s, m/s, m2/s2.
enum class Dimension { none, length, angle, time, speed, energy };

/// E.g. "a length".
std::string_view noun(Dimension dimension);
/// What to write, e.g. "60 km".
std::string_view example(Dimension dimension);

struct Quantity {
  double value = 0.0;  ///< finite, in the unit that Dimension names
  std::string error;   ///< one sentence when the text is no such quantity, else empty
};

/// A finite number and, unless the dimension is none, a unit. The decimal sign is a point in every
/// locale. Never throws for a bad text.
Quantity parse_quantity(std::string_view text, Dimension dimension);

}  // namespace delos
