// SPDX-License-Identifier: BSD-3-Clause
#include "io/unpack.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "core/error.hpp"

namespace delos {
namespace {

using netcdf::Type;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Values per block: a tenth of a millisecond.
constexpr std::int64_t kUnpackGrain = std::int64_t{1} << 15;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// What writers leave where nothing was put (netCDF User Guide, "Fill values").
std::optional<double> default_fill(Type type) {
  switch (type) {
    case Type::int16:
      return -32767.0;
    case Type::uint16:
      return 65535.0;
    case Type::int32:
      return -2147483647.0;
    case Type::uint32:
      return 4294967295.0;
    case Type::int64:
      return -9223372036854775806.0;
    case Type::uint64:
      return 18446744073709551614.0;
    case Type::float32:
    case Type::float64:
      return 9.9692099683868690e+36;
    default:
      return std::nullopt;
  }
}

/// The number as the variable's type stores it.
double in_stored_type(Type type, double value) {
  return type == Type::float32 ? static_cast<double>(static_cast<float>(value)) : value;
}

/// The numbers of an attribute, `n` of them (0: any number). One that is text would otherwise go
/// unnoticed, and the values be taken as they are stored.
std::optional<std::vector<double>> numbers_of(const netcdf::Reader& file,
                                              const std::string& variable, const char* name,
                                              std::size_t n) {
  auto numbers = file.number_attribute(variable, name);
  if (!numbers && file.text_attribute(variable, name).value_or("").empty()) return std::nullopt;
  DELOS_CHECK(numbers, ErrorKind::input, file.path(), ": variable '", variable, "': ", name,
              " is text where numbers are needed. Repair the attribute, e.g. with `ncatted`.");
  DELOS_CHECK(n == 0 || numbers->size() == n, ErrorKind::input, file.path(), ": variable '",
              variable, "': ", name, " has ", numbers->size(), " values where ", n,
              n == 1 ? " is" : " are", " needed. Repair the attribute, e.g. with `ncatted`.");
  return numbers;
}

std::optional<double> one_number(const netcdf::Reader& file, const std::string& variable,
                                 const char* name) {
  const auto numbers = numbers_of(file, variable, name, 1);
  return numbers ? std::optional(numbers->front()) : std::nullopt;
}

double finite_factor(const netcdf::Reader& file, const std::string& variable, const char* name,
                     double otherwise) {
  const double value = one_number(file, variable, name).value_or(otherwise);
  DELOS_CHECK(std::isfinite(value), ErrorKind::input, file.path(), ": variable '", variable,
              "': ", name, " = ", value, ": must be finite. Repair the attribute.");
  return value;
}

bool is_floating(Type type) { return type == Type::float32 || type == Type::float64; }

/// A limit counts for unpacked values when only its type is that of unpacked values (NUG,
/// "valid_range"), else for stored ones.
void set_limits(const netcdf::Reader& file, const netcdf::Variable& variable,
                Unpacking& unpacking) {
  const auto set = [&](const char* name, double low, double high) {
    const bool packed = file.number_attribute(variable.name, "scale_factor").has_value() ||
                        file.number_attribute(variable.name, "add_offset").has_value();
    const bool for_unpacked = packed && !is_floating(variable.type) &&
                              is_floating(*file.attribute_type(variable.name, name));
    double& min = for_unpacked ? unpacking.valid_min_unpacked : unpacking.valid_min;
    double& max = for_unpacked ? unpacking.valid_max_unpacked : unpacking.valid_max;
    min = std::max(min, low);
    max = std::min(max, high);
  };
  const auto range = numbers_of(file, variable.name, "valid_range", 2);
  const auto stored = [&](double value) { return in_stored_type(variable.type, value); };
  if (range) set("valid_range", stored((*range)[0]), stored((*range)[1]));
  if (const auto low = one_number(file, variable.name, "valid_min")) {
    set("valid_min", stored(*low), kInfinity);
  }
  if (const auto high = one_number(file, variable.name, "valid_max")) {
    set("valid_max", -kInfinity, stored(*high));
  }
}

double wrap_of_unsigned(const netcdf::Reader& file, const netcdf::Variable& variable) {
  const std::string flag = file.text_attribute(variable.name, "_Unsigned").value_or("");
  if (flag != "true" && flag != "TRUE") return 0.0;
  if (variable.type == Type::int8) return 256.0;
  if (variable.type == Type::int16) return 65536.0;
  return variable.type == Type::int32 ? 4294967296.0 : 0.0;
}

std::size_t unpack_some(const Unpacking& u, const std::vector<double>& missing,
                        std::span<double> values) {
  std::size_t n_valid = 0;
  for (double& value : values) {
    bool is_missing = !std::isfinite(value);
    for (const double fill : missing) is_missing = is_missing || value == fill;
    if (value < 0.0) value += u.unsigned_wrap;
    is_missing = is_missing || value < u.valid_min || value > u.valid_max;
    value = u.scale * value + u.offset;
    is_missing = is_missing || value < u.valid_min_unpacked || value > u.valid_max_unpacked;
    value = is_missing ? kNaN : u.units.scale * value + u.units.offset;
    n_valid += is_missing ? 0 : 1;
  }
  return n_valid;
}

}  // namespace

Unpacking read_unpacking(const netcdf::Reader& file, const netcdf::Variable& variable) {
  Unpacking unpacking{{}, -kInfinity, kInfinity, -kInfinity, kInfinity, 1.0, 0.0, 0.0, {}};
  const auto fill = numbers_of(file, variable.name, "_FillValue", 0);
  if (!fill) {
    if (const auto value = default_fill(variable.type)) {
      unpacking.missing.push_back(in_stored_type(variable.type, *value));
    }
  }
  for (const auto& numbers : {fill, numbers_of(file, variable.name, "missing_value", 0)}) {
    if (!numbers) continue;
    for (const double value : *numbers) {
      unpacking.missing.push_back(in_stored_type(variable.type, value));
    }
  }
  set_limits(file, variable, unpacking);
  unpacking.scale = finite_factor(file, variable.name, "scale_factor", 1.0);
  unpacking.offset = finite_factor(file, variable.name, "add_offset", 0.0);
  DELOS_CHECK(unpacking.scale != 0.0, ErrorKind::input, file.path(), ": variable '", variable.name,
              "': scale_factor = 0: must not be 0. Repair the attribute.");
  unpacking.unsigned_wrap = wrap_of_unsigned(file, variable);
  return unpacking;
}

std::size_t unpack(parallel::Executor& exec, const Unpacking& unpacking, std::span<double> values) {
  // Only the distinct fills: usually one.
  std::vector<double> missing = unpacking.missing;
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  const auto count_in = [&](std::int64_t begin, std::int64_t end) {
    return unpack_some(
        unpacking, missing,
        values.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)));
  };
  return parallel::reduce(exec, static_cast<std::int64_t>(values.size()), kUnpackGrain,
                          std::size_t{0}, count_in, std::plus<>());
}

UnitConversion file_unit_conversion(const netcdf::Reader& file, const std::string& variable,
                                    const std::string& file_units, const std::string& wanted) {
  if (wanted.empty()) return {};
  const std::string where = file.path() + ": variable '" + variable + "'";
  const std::string from =
      file_units.empty() ? file.text_attribute(variable, "units").value_or("") : file_units;
  DELOS_CHECK(!from.empty(), ErrorKind::input, where, " has no `units` attribute, and ", wanted,
              " is needed. Give the unit of the file with `units`.");
  const auto conversion = unit_conversion(from, wanted);
  DELOS_CHECK(conversion, ErrorKind::input, where, ": its unit '", from,
              "' can't be converted to '", wanted,
              "'. Check that it is the right variable, or give its unit with `units`.");
  return *conversion;
}

}  // namespace delos
