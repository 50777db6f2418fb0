// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/units.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "core/error.hpp"
#include "core/types.hpp"

namespace delos {
namespace {

struct Unit {
  std::string_view spelling;
  Dimension dimension;
  double factor;
};

constexpr std::array kUnits = {
    Unit{"m", Dimension::length, 1.0},
    Unit{"km", Dimension::length, 1000.0},
    Unit{"deg", Dimension::angle, 1.0},
    Unit{"degree", Dimension::angle, 1.0},
    Unit{"degrees", Dimension::angle, 1.0},
    Unit{"rad", Dimension::angle, kDegPerRad},
    Unit{"arcmin", Dimension::angle, 1.0 / 60.0},
    Unit{"s", Dimension::time, 1.0},
    Unit{"min", Dimension::time, 60.0},
    Unit{"h", Dimension::time, 3600.0},
    Unit{"d", Dimension::time, 86400.0},
    Unit{"day", Dimension::time, 86400.0},
    Unit{"days", Dimension::time, 86400.0},
    Unit{"m/s", Dimension::speed, 1.0},
    Unit{"cm/s", Dimension::speed, 0.01},
    Unit{"m s-1", Dimension::speed, 1.0},
    Unit{"m2/s2", Dimension::energy, 1.0},
    Unit{"m^2/s^2", Dimension::energy, 1.0},
    Unit{"m2 s-2", Dimension::energy, 1.0},
    Unit{"cm2/s2", Dimension::energy, 1e-4},
};

struct Words {
  std::string_view noun, example, units;
};

constexpr Words words(Dimension dimension) {
  switch (dimension) {
    case Dimension::length:
      return {"a length", "60 km", "m or km"};
    case Dimension::angle:
      return {"an angle", "0.5 deg", "deg, arcmin or rad"};
    case Dimension::time:
      return {"a time", "12.42 h", "s, min, h or d"};
    case Dimension::speed:
      return {"a speed", "0.45 m/s", "m/s or cm/s"};
    case Dimension::energy:
      return {"an energy per mass", "0.02 m2/s2", "m2/s2 or cm2/s2"};
    case Dimension::none:
      break;
  }
  return {"a number without unit", "0.15", ""};
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

const Unit* find_unit(std::string_view spelling) {
  for (const Unit& unit : kUnits) {
    if (unit.spelling == spelling) return &unit;
  }
  return nullptr;
}

std::string wrong_unit(std::string_view text, std::string_view unit_text, const Unit* unit,
                       Dimension dimension) {
  const Words needed = words(dimension);
  if (unit == nullptr && dimension != Dimension::none) {
    return delos::text("'", text, "' has the unknown unit '", unit_text, "'; ", needed.noun,
                       " is given in ", needed.units, ", e.g. '", needed.example, "'.");
  }
  return delos::text("'", text, "' is ",
                     unit == nullptr ? "no number" : words(unit->dimension).noun, ", but ",
                     needed.noun, " is needed here, e.g. '", needed.example, "'.");
}

}  // namespace

std::string_view noun(Dimension dimension) { return words(dimension).noun; }
std::string_view example(Dimension dimension) { return words(dimension).example; }

Quantity parse_quantity(std::string_view text, Dimension dimension) {
  const std::string_view body = trimmed(text);
  const char* begin = body.data();
  const char* const end = begin + body.size();
  if (begin != end && *begin == '+') ++begin;
  Quantity result;
  const auto [rest, status] = std::from_chars(begin, end, result.value);
  const Words needed = words(dimension);
  if (status != std::errc() || !std::isfinite(result.value)) {
    result.error =
        delos::text("'", text, "' is not ", needed.noun, ", e.g. '", needed.example, "'.");
    return result;
  }
  const std::string_view unit_text =
      trimmed(std::string_view(rest, static_cast<std::size_t>(end - rest)));
  if (unit_text.empty()) {
    if (dimension != Dimension::none) {
      result.error = delos::text("'", text, "' has no unit; ", needed.noun, " is given in ",
                                 needed.units, ", e.g. '", needed.example, "'.");
    }
    return result;
  }
  const Unit* const unit = find_unit(unit_text);
  if (unit == nullptr || unit->dimension != dimension) {
    result.error = wrong_unit(text, unit_text, unit, dimension);
    return result;
  }
  result.value *= unit->factor;
  if (!std::isfinite(result.value)) {
    result.error = delos::text("'", text, "' is too large to compute with; ", needed.noun,
                               " is e.g. '", needed.example, "'.");
  }
  return result;
}

}  // namespace delos
