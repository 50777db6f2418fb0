// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Units of gridded fields, as far as sizing needs them: lengths, times, speeds, energies per mass,
// temperatures, salinities.
#include <optional>
#include <string>

namespace delos {

/// converted = scale * value + offset.
struct UnitConversion {
  double scale = 1.0;
  double offset = 0.0;
};

/// How values in `from` become values in `to`. Products of powers as CF files write them, in any
/// case: "km", "METERS", "m2 s-2", "cm2/s2", "m**2/s**2", "cm s^-1", "DEG C", "g/kg", "psu", "1".
/// Nothing when one of the two is unknown or when they measure different things.
std::optional<UnitConversion> unit_conversion(const std::string& from, const std::string& to);

}  // namespace delos
