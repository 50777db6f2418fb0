// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Restart files: named arrays in one netCDF file (CDF-5) that appears whole or not at all, and that
// is refused when it is another version's, cut off or altered anywhere. What the arrays mean is
// their writer's business.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "io/netcdf.hpp"

namespace delos {

/// Grows when arrays get another meaning; only files of the same number are read.
inline constexpr std::int32_t kRestartFormat = 1;

/// One array to be written; it refers to its values, of which there is at least one.
struct RestartArray {
  std::string name;         ///< unique; a netCDF name
  std::string description;  ///< shape and unit, for people
  std::variant<std::span<const double>, std::span<const std::int64_t>,
               std::span<const std::int32_t>, std::string_view>
      values;
};

/// Writes the arrays in their order under a temporary name, then their checksum (SHA-256 of all
/// bytes before it) at the end of the file, flushes it to the disk and renames it: who is killed on
/// the way leaves the former file. `version` is the library's. Error(output) as AtomicFile, naming
/// the path.
void write_restart_arrays(const std::string& path, const std::string& version,
                          std::span<const RestartArray> arrays);

/// An open restart file, already checked.
class RestartFile {
 public:
  /// Error(input) naming the path when there is no such file, it is no restart file, it was cut
  /// off, a byte of it was changed, or it is of another format or library version than these.
  RestartFile(const std::string& path, const std::string& version);

  const std::string& path() const { return file_.path(); }
  bool has(const std::string& name) const { return file_.has_variable(name); }
  std::vector<double> doubles(const std::string& name) const { return file_.read_double(name); }
  std::vector<std::int64_t> integers(const std::string& name) const {
    return file_.read_int64(name);
  }
  std::vector<std::int32_t> ids(const std::string& name) const { return file_.read_int32(name); }
  std::string text(const std::string& name) const { return file_.read_text(name); }

 private:
  netcdf::Reader file_;
};

}  // namespace delos
