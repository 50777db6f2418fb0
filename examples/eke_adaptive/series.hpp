// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Global fields of a netCDF file, one lat-lon table for every time.
#include <string>
#include <vector>

namespace eke_adaptive {

/// Fields f(time, lat, lon) of one file, unpacked; missing values become NaN. Longitudes and
/// latitudes are the variables of the field's own dimensions. std::runtime_error names the file.
class Series {
 public:
  Series(const std::string& path, const std::string& variable);
  ~Series();
  Series(const Series&) = delete;
  Series& operator=(const Series&) = delete;

  std::size_t n_times() const { return n_times_; }
  const std::vector<double>& lon_deg() const { return lon_deg_; }
  const std::vector<double>& lat_deg() const { return lat_deg_; }
  /// [n_lat, n_lon]
  std::vector<double> read(std::size_t time) const;

 private:
  std::string path_;
  int file_ = -1;
  int variable_ = -1;
  std::size_t n_times_ = 0;
  std::vector<double> lon_deg_, lat_deg_;
};

/// A CF file of one field eke(lat, lon) in m2 s-2.
void write_energy(const std::string& path, const Series& axes, const std::vector<double>& eke);

}  // namespace eke_adaptive
