// SPDX-License-Identifier: BSD-3-Clause
#include "series.hpp"

#include <netcdf.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace eke_adaptive {
namespace {

void must(int status, const std::string& path, const std::string& what) {
  if (status != NC_NOERR) throw std::runtime_error(path + ": " + what + ": " + nc_strerror(status));
}

std::vector<double> axis(int file, int dimension, const std::string& path) {
  std::array<char, NC_MAX_NAME + 1> name{};
  std::size_t n = 0;
  int variable = 0;
  must(nc_inq_dim(file, dimension, name.data(), &n), path, "dimension");
  must(nc_inq_varid(file, name.data(), &variable), path, name.data());
  std::vector<double> values(n);
  must(nc_get_var_double(file, variable, values.data()), path, name.data());
  return values;
}

/// Of an attribute that may be absent.
double attribute(int file, int variable, const char* name, double otherwise) {
  double value = otherwise;
  return nc_get_att_double(file, variable, name, &value) == NC_NOERR ? value : otherwise;
}

}  // namespace

Series::Series(const std::string& path, const std::string& variable) : path_(path) {
  must(nc_open(path.c_str(), NC_NOWRITE, &file_), path, "can't be read");
  std::array<int, 3> dimensions{};
  int n_dimensions = 0;
  must(nc_inq_varid(file_, variable.c_str(), &variable_), path, variable);
  must(nc_inq_varndims(file_, variable_, &n_dimensions), path, variable);
  if (n_dimensions != 3)
    throw std::runtime_error(path + ": " + variable + " is no f(time, lat, lon)");
  must(nc_inq_vardimid(file_, variable_, dimensions.data()), path, variable);
  must(nc_inq_dimlen(file_, dimensions[0], &n_times_), path, "times");
  lat_deg_ = axis(file_, dimensions[1], path);
  lon_deg_ = axis(file_, dimensions[2], path);
}

Series::~Series() { nc_close(file_); }

std::vector<double> Series::read(std::size_t time) const {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> values(lat_deg_.size() * lon_deg_.size());
  const std::array<std::size_t, 3> start{time, 0, 0};
  const std::array<std::size_t, 3> count{1, lat_deg_.size(), lon_deg_.size()};
  must(nc_get_vara_double(file_, variable_, start.data(), count.data(), values.data()), path_,
       "time " + std::to_string(time));
  const double fill = attribute(file_, variable_, "_FillValue", kNone);
  const double scale = attribute(file_, variable_, "scale_factor", 1.0);
  const double offset = attribute(file_, variable_, "add_offset", 0.0);
  for (double& value : values) value = value == fill ? kNone : offset + scale * value;
  return values;
}

void write_energy(const std::string& path, const Series& axes, const std::vector<double>& eke) {
  int file = 0, lat = 0, lon = 0;
  std::array<int, 2> dimensions{};
  must(nc_create(path.c_str(), NC_CLOBBER | NC_64BIT_OFFSET, &file), path, "can't be written");
  must(nc_def_dim(file, "lat", axes.lat_deg().size(), &dimensions[0]), path, "lat");
  must(nc_def_dim(file, "lon", axes.lon_deg().size(), &dimensions[1]), path, "lon");
  must(nc_def_var(file, "lat", NC_DOUBLE, 1, &dimensions[0], &lat), path, "lat");
  must(nc_def_var(file, "lon", NC_DOUBLE, 1, &dimensions[1], &lon), path, "lon");
  int variable = 0;
  must(nc_def_var(file, "eke", NC_DOUBLE, 2, dimensions.data(), &variable), path, "eke");
  const auto note = [&](int id, const char* name, const std::string& text) {
    must(nc_put_att_text(file, id, name, text.size(), text.data()), path, name);
  };
  note(lat, "units", "degrees_north");
  note(lon, "units", "degrees_east");
  note(variable, "units", "m2 s-2");
  const double fill = NC_FILL_DOUBLE;
  must(nc_put_att_double(file, variable, "_FillValue", NC_DOUBLE, 1, &fill), path, "_FillValue");
  must(nc_enddef(file), path, "header");
  std::vector<double> filled = eke;
  for (double& value : filled) value = std::isnan(value) ? fill : value;
  must(nc_put_var_double(file, lat, axes.lat_deg().data()), path, "lat");
  must(nc_put_var_double(file, lon, axes.lon_deg().data()), path, "lon");
  must(nc_put_var_double(file, variable, filled.data()), path, "eke");
  must(nc_close(file), path, "can't be written");
}

}  // namespace eke_adaptive
