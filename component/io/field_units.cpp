// SPDX-License-Identifier: BSD-3-Clause
#include "io/field_units.hpp"

#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace delos {
namespace {

/// Powers of metre, second, kilogram and kelvin.
using Powers = std::array<int, 4>;

struct Unit {
  double scale = 1.0;   ///< in SI units
  double offset = 0.0;  ///< SI = scale * value + offset
  Powers powers{};
};

struct NamedUnit {
  const char* name;
  double scale;
  Powers powers;
};

constexpr Powers kLength = {1, 0, 0, 0};
constexpr Powers kTime = {0, 1, 0, 0};
constexpr Powers kMass = {0, 0, 1, 0};
constexpr Powers kTemperature = {0, 0, 0, 1};
constexpr Powers kNone4 = {0, 0, 0, 0};

constexpr std::array<NamedUnit, 43> kUnits = {{{"m", 1, kLength},
                                               {"meter", 1, kLength},
                                               {"meters", 1, kLength},
                                               {"metre", 1, kLength},
                                               {"metres", 1, kLength},
                                               {"km", 1e3, kLength},
                                               {"kilometer", 1e3, kLength},
                                               {"kilometers", 1e3, kLength},
                                               {"kilometre", 1e3, kLength},
                                               {"kilometres", 1e3, kLength},
                                               {"dm", 1e-1, kLength},
                                               {"cm", 1e-2, kLength},
                                               {"centimeter", 1e-2, kLength},
                                               {"centimeters", 1e-2, kLength},
                                               {"centimetres", 1e-2, kLength},
                                               {"mm", 1e-3, kLength},
                                               {"s", 1, kTime},
                                               {"sec", 1, kTime},
                                               {"second", 1, kTime},
                                               {"seconds", 1, kTime},
                                               {"min", 60, kTime},
                                               {"minute", 60, kTime},
                                               {"minutes", 60, kTime},
                                               {"h", 3600, kTime},
                                               {"hr", 3600, kTime},
                                               {"hour", 3600, kTime},
                                               {"hours", 3600, kTime},
                                               {"d", 86400, kTime},
                                               {"day", 86400, kTime},
                                               {"days", 86400, kTime},
                                               {"kg", 1, kMass},
                                               {"g", 1e-3, kMass},
                                               {"k", 1, kTemperature},
                                               {"kelvin", 1, kTemperature},
                                               {"degk", 1, kTemperature},
                                               {"psu", 1e-3, kNone4},
                                               {"pss", 1e-3, kNone4},
                                               {"pss-78", 1e-3, kNone4},
                                               {"ppt", 1e-3, kNone4},  // per thousand, in salinity
                                               {"permil", 1e-3, kNone4},
                                               {"%", 1e-2, kNone4},
                                               {"percent", 1e-2, kNone4},
                                               {"dimensionless", 1, kNone4}}};

constexpr std::array<const char*, 9> kCelsius = {"c",
                                                 "degc",
                                                 "deg_c",
                                                 "deg c",
                                                 "celsius",
                                                 "degree_celsius",
                                                 "degrees_celsius",
                                                 "degree celsius",
                                                 "degrees celsius"};
constexpr double kCelsiusZero = 273.15;

const NamedUnit* find_named(const std::string& name) {
  for (const NamedUnit& unit : kUnits) {
    if (name == unit.name) return &unit;
  }
  return nullptr;
}

std::string lower_trimmed(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  while (!result.empty() && result.back() == ' ') result.pop_back();
  result.erase(0, result.find_first_not_of(' '));
  return result;
}

bool is_separator(char c) { return c == ' ' || c == '.' || c == '*'; }

/// One factor at `position`: a number ("1", "1e-3") or a name with an exponent ("m2", "s-1",
/// "m**2", "s^-2"). Multiplies it into `unit`, to the power `sign`.
bool multiply_factor(const std::string& text, std::size_t& position, int sign, Unit& unit) {
  const char* begin = text.c_str() + position;
  if (std::isdigit(static_cast<unsigned char>(*begin)) != 0) {
    char* end = nullptr;
    const double number = std::strtod(begin, &end);
    position += static_cast<std::size_t>(end - begin);
    unit.scale *= sign > 0 ? number : 1.0 / number;
    return number > 0.0;
  }
  std::size_t end = position;
  while (end < text.size() && (std::isalpha(static_cast<unsigned char>(text[end])) != 0 ||
                               text[end] == '_' || text[end] == '%')) {
    ++end;
  }
  const NamedUnit* named = find_named(text.substr(position, end - position));
  if (named == nullptr) return false;
  if (text.compare(end, 2, "**") == 0) {
    end += 2;
  } else if (text.compare(end, 1, "^") == 0) {
    end += 1;
  }
  char* after = nullptr;
  const long exponent = std::strtol(text.c_str() + end, &after, 10);
  const bool has_exponent = after != text.c_str() + end && !is_separator(text[end]);
  const int power = sign * (has_exponent ? static_cast<int>(exponent) : 1);
  if (std::abs(power) > 9) return false;
  position = has_exponent ? static_cast<std::size_t>(after - text.c_str()) : end;
  for (int i = 0; i < std::abs(power); ++i) {
    unit.scale = power > 0 ? unit.scale * named->scale : unit.scale / named->scale;
  }
  for (std::size_t i = 0; i < unit.powers.size(); ++i) unit.powers[i] += power * named->powers[i];
  return true;
}

std::optional<Unit> parse_unit(const std::string& given) {
  const std::string text = lower_trimmed(given);
  Unit unit;
  for (const char* celsius : kCelsius) {
    if (text == celsius) return Unit{1.0, kCelsiusZero, kTemperature};
  }
  if (const NamedUnit* named = find_named(text)) return Unit{named->scale, 0.0, named->powers};
  std::size_t position = 0;
  int sign = 1;
  while (position < text.size()) {
    if (text[position] == '/') {
      sign = -1;
      ++position;
    } else if (is_separator(text[position])) {
      ++position;
    } else {
      if (!multiply_factor(text, position, sign, unit)) return std::nullopt;
      sign = 1;
    }
  }
  if (text.empty() || sign < 0) return std::nullopt;
  return unit;
}

}  // namespace

std::optional<UnitConversion> unit_conversion(const std::string& from, const std::string& to) {
  const std::optional<Unit> a = parse_unit(from);
  const std::optional<Unit> b = parse_unit(to);
  if (!a || !b || a->powers != b->powers) return std::nullopt;
  return UnitConversion{a->scale / b->scale, (a->offset - b->offset) / b->scale};
}

}  // namespace delos
