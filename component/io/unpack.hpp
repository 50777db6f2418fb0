// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From stored numbers to physical ones: missing values, packing, units.
#include <span>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "io/field_units.hpp"
#include "io/netcdf.hpp"

namespace delos {

/// How the stored numbers of one variable become values.
struct Unpacking {
  std::vector<double> missing;  ///< stored numbers that mean "missing"
  double valid_min, valid_max;  ///< of stored numbers
  double valid_min_unpacked, valid_max_unpacked;
  double scale = 1.0, offset = 0.0;  ///< value = scale * stored + offset
  double unsigned_wrap = 0.0;        ///< added to negative stored numbers (attribute _Unsigned)
  UnitConversion units;              ///< applied last
};

/// What the attributes of the variable say. Fill values are compared in the stored type, so that
/// -1e34 written as double finds -1e34 stored as float. Without _FillValue the library's default
/// fill counts as missing (types wider than a byte). Error(input) for a scale_factor of 0 or not
/// a number.
Unpacking read_unpacking(const netcdf::Reader& file, const netcdf::Variable& variable);

/// In place: stored numbers become values in the wanted unit, NaN where missing or not finite.
/// Returns how many are not missing.
std::size_t unpack(parallel::Executor& exec, const Unpacking& unpacking, std::span<double> values);

/// From the unit of the file (its `units` attribute unless `file_units` overrides it) to the wanted
/// one; identity when `wanted` is empty. Error(input) when that can't be done.
UnitConversion file_unit_conversion(const netcdf::Reader& file, const std::string& variable,
                                    const std::string& file_units, const std::string& wanted);

}  // namespace delos
