// SPDX-License-Identifier: BSD-3-Clause
#include "io/rasters.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>

#include "core/hash.hpp"
#include "io/data_files.hpp"
#include "io/field_units.hpp"
#include "io/netcdf.hpp"
#include "io/raster_axes.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using netcdf::DimensionId;
using netcdf::Format;
using netcdf::Type;
using netcdf::VariableId;
using netcdf::Writer;
using testing::expect_error;
using testing::TemporaryFolder;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// first, first + step, ... n values.
std::vector<double> even(double first, double step, std::size_t n) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = first + step * static_cast<double>(i);
  return values;
}

/// One field "h" on (lat, lon); what a test does not say is plain.
struct Sample {
  std::vector<double> lat = even(-75, 30, 6);
  std::vector<double> lon = even(-165, 30, 12);
  std::vector<double> values;  ///< [lat, lon]; empty: 100 * row + column
  Type type = Type::float64;
  Format format = Format::netcdf4;
  bool lon_first = false;
  std::string lat_name = "lat", lon_name = "lon";
  /// Attributes of lat, lon and h.
  std::function<void(Writer&, VariableId, VariableId, VariableId)> attributes =
      [](Writer& file, VariableId lat, VariableId lon, VariableId) {
        file.attribute(lat, "units", "degrees_north");
        file.attribute(lon, "units", "degrees_east");
      };
};

std::string write(const TemporaryFolder& folder, const Sample& sample) {
  const std::string path = folder.file("h.nc");
  Writer file(path, sample.format);
  const auto y = file.define_dimension(sample.lat_name, sample.lat.size());
  const auto x = file.define_dimension(sample.lon_name, sample.lon.size());
  const auto lat = file.define_variable(sample.lat_name, Type::float64, {y});
  const auto lon = file.define_variable(sample.lon_name, Type::float64, {x});
  const auto h = sample.lon_first ? file.define_variable("h", sample.type, {x, y})
                                  : file.define_variable("h", sample.type, {y, x});
  sample.attributes(file, lat, lon, h);
  file.end_definitions();
  file.put(lat, sample.lat);
  file.put(lon, sample.lon);
  std::vector<double> values(sample.lat.size() * sample.lon.size());
  for (std::size_t row = 0; row < sample.lat.size(); ++row) {
    for (std::size_t column = 0; column < sample.lon.size(); ++column) {
      const std::size_t at = row * sample.lon.size() + column;
      const double value = sample.values.empty()
                               ? 100.0 * static_cast<double>(row) + static_cast<double>(column)
                               : sample.values[at];
      values[sample.lon_first ? column * sample.lat.size() + row : at] = value;
    }
  }
  file.put(h, values);
  file.close();
  return path;
}

/// With CF coordinates, and further attributes of h.
std::string write_with(const TemporaryFolder& folder, Sample sample,
                       const std::function<void(Writer&, VariableId)>& more) {
  const auto usual = sample.attributes;
  sample.attributes = [=](Writer& file, VariableId lat, VariableId lon, VariableId h) {
    usual(file, lat, lon, h);
    more(file, h);
  };
  return write(folder, sample);
}

double at(const Raster& raster, std::size_t row, std::size_t column) {
  return raster.values[row * raster.n_lon() + column];
}

void check_sound(const Raster& raster) {
  REQUIRE(raster.values.size() == raster.n_lat() * raster.n_lon());
  for (std::size_t i = 1; i < raster.n_lat(); ++i) {
    REQUIRE(raster.lat_deg[i] > raster.lat_deg[i - 1]);
  }
  for (std::size_t i = 1; i < raster.n_lon(); ++i) {
    REQUIRE(raster.lon_deg[i] > raster.lon_deg[i - 1]);
  }
  CHECK(raster.lat_deg.front() >= -90.0);
  CHECK(raster.lat_deg.back() <= 90.0);
  CHECK(raster.lon_deg.front() >= -180.0);
  CHECK(raster.lon_deg.front() < 180.0);
  CHECK(raster.lon_deg.back() - raster.lon_deg.front() < 360.0);
}

/// The share of missing values and the extremes of the others.
struct Range {
  double min = 1e300, max = -1e300, missing = 0.0;
};
Range range_of(const Raster& raster) {
  Range range;
  for (const double value : raster.values) {
    if (std::isnan(value)) {
      range.missing += 1.0 / static_cast<double>(raster.values.size());
    } else {
      range.min = std::min(range.min, value);
      range.max = std::max(range.max, value);
    }
  }
  return range;
}

/// A field of further dimensions: TEMP(time, depth, lat, lon) = 1000 t + 100 z + 10 row + column.
std::string write_deep(const TemporaryFolder& folder, const std::vector<double>& depths,
                       const std::string& units, const std::string& positive) {
  Writer file(folder.file("deep.nc"), Format::cdf5);
  const auto t = file.define_dimension("time", 2);
  const auto z = file.define_dimension("z", depths.size());
  const auto y = file.define_dimension("lat", 3);
  const auto x = file.define_dimension("lon", 4);
  const auto time = file.define_variable("time", Type::float64, {t});
  const auto depth = file.define_variable("z", Type::float64, {z});
  const auto lat = file.define_variable("lat", Type::float64, {y});
  const auto lon = file.define_variable("lon", Type::float64, {x});
  const auto temp = file.define_variable("TEMP", Type::float32, {t, z, y, x});
  file.attribute(time, "units", "days since 1950-01-01");
  if (!units.empty()) file.attribute(depth, "units", units);
  if (!positive.empty()) file.attribute(depth, "positive", positive);
  file.attribute(lat, "standard_name", "latitude");
  file.attribute(lon, "standard_name", "longitude");
  file.attribute(temp, "units", "DEG C");
  file.end_definitions();
  file.put(time, std::vector<double>{1, 2});
  file.put(depth, depths);
  file.put(lat, std::vector<double>{-30, 0, 30});
  file.put(lon, std::vector<double>{0, 90, 180, 270});
  std::vector<double> values;
  for (int i = 0; i < 2 * static_cast<int>(depths.size()) * 12; ++i) {
    const int n_z = static_cast<int>(depths.size());
    values.push_back(1000 * (i / 12 / n_z) + 100 * (i / 12 % n_z) + 10 * (i / 4 % 3) + i % 4);
  }
  file.put(temp, values);
  file.close();
  return folder.file("deep.nc");
}

}  // namespace

TEST_CASE("the order of latitudes, longitudes and dimensions in the file does not matter") {
  const TemporaryFolder folder;
  const Raster plain = read_raster(write(folder, {}), {});
  check_sound(plain);
  CHECK(plain.periodic);
  CHECK(plain.source == folder.file("h.nc") + ":h");
  CHECK(plain.lat_deg == even(-75, 30, 6));
  for (const bool lon_first : {false, true}) {
    for (const bool flip_lat : {false, true}) {
      for (const bool flip_lon : {false, true}) {
        Sample sample;
        sample.lon_first = lon_first;
        if (flip_lat) sample.lat = even(75, -30, 6);
        if (flip_lon) sample.lon = even(165, -30, 12);
        const Raster raster = read_raster(write(folder, sample), {});
        CHECK(raster.lat_deg == plain.lat_deg);
        CHECK(raster.lon_deg == plain.lon_deg);
        CHECK(at(raster, 1, 2) == 100.0 * (flip_lat ? 4 : 1) + (flip_lon ? 9 : 2));
      }
    }
  }
}

TEST_CASE("a repeated last column is dropped and the field goes round the globe") {
  const TemporaryFolder folder;
  for (const double first : {-180.0, 0.0, 20.0, 20.167, 200.0}) {
    for (const std::size_t n_repeated : {0U, 1U, 2U}) {
      CAPTURE(first);
      Sample sample;
      sample.lon = even(first, 30, 12 + n_repeated);
      const Raster raster = read_raster(write(folder, sample), {});
      check_sound(raster);
      CHECK(raster.periodic);
      CHECK(raster.n_lon() == 12);
      CHECK(raster.lon_deg[0] == doctest::Approx(first == 200.0 ? -160.0 : first));
      CHECK(at(raster, 2, 11) == 211.0);
    }
  }
}

TEST_CASE("nearly periodic longitudes are made even, regional ones are left alone") {
  const TemporaryFolder folder;
  Sample sample;
  sample.lon = even(0.0, 359.92 / 4319.0, 4320);  // as ETOPO5 has them
  Raster raster = read_raster(write(folder, sample), {});
  CHECK(raster.periodic);
  CHECK(raster.n_lon() == 4320);
  CHECK(raster.lon_deg[4319] == doctest::Approx(360.0 * 4319 / 4320).epsilon(1e-14));
  sample.lon = {-20, -10, 0, 5, 7.5, 30};
  raster = read_raster(write(folder, sample), {});
  CHECK_FALSE(raster.periodic);
  CHECK(raster.lon_deg == sample.lon);
}

TEST_CASE("longitudes that jump at the date line or at Greenwich are continued") {
  const TemporaryFolder folder;
  Sample sample;
  sample.lon = {15, 45, 75, 105, 135, 165, -165, -135, -105, -75, -45, -15};
  const Raster raster = read_raster(write(folder, sample), {});
  check_sound(raster);
  CHECK(raster.periodic);
  CHECK(raster.lon_deg == even(15, 30, 12));
  CHECK(at(raster, 0, 7) == 7.0);
  sample.lon = {170, 175, 180, -175, -170};
  const Raster pacific = read_raster(write(folder, sample), {});
  CHECK_FALSE(pacific.periodic);
  CHECK(pacific.lon_deg == even(170, 5, 5));
}

TEST_CASE("poles, uneven latitudes and latitudes a rounding beyond the pole are accepted") {
  const TemporaryFolder folder;
  Sample sample;
  sample.lat = {90.00001, 86, 82, 0, -82, -90.00001};
  const Raster raster = read_raster(write(folder, sample), {});
  CHECK(raster.lat_deg == std::vector<double>{-90, -82, 0, 82, 86, 90});
}

TEST_CASE("packed values are unpacked, with negative scale, too") {
  const TemporaryFolder folder;
  Sample sample;
  sample.type = Type::int16;
  sample.values = std::vector<double>(72, 5.0);
  sample.values[3] = -32768;
  sample.values[4] = 7;
  for (const double scale : {0.0001, -2.0}) {
    const Raster raster = read_raster(write_with(folder, sample,
                                                 [&](Writer& file, VariableId h) {
                                                   file.attribute(h, "_FillValue", -32768);
                                                   file.attribute(h, "scale_factor", scale);
                                                   file.attribute(h, "add_offset", 10.0);
                                                 }),
                                      {});
    CHECK(raster.values[0] == doctest::Approx(5.0 * scale + 10.0));
    CHECK(std::isnan(raster.values[3]));
    CHECK(raster.values[4] == doctest::Approx(7.0 * scale + 10.0));
    CHECK(range_of(raster).missing == doctest::Approx(1.0 / 72));
  }
}

TEST_CASE("missing values are known by every attribute that can say so") {
  const TemporaryFolder folder;
  Sample sample;
  sample.type = Type::float32;
  sample.values = std::vector<double>(72, 5.0);
  const auto is_missing = [&](double value, const std::function<void(Writer&, VariableId)>& more) {
    sample.values[1] = value;
    const Raster raster = read_raster(write_with(folder, sample, more), {});
    CHECK(raster.values[0] == 5.0);
    return std::isnan(raster.values[1]);
  };
  const auto nothing = [](Writer&, VariableId) {};
  CHECK(is_missing(kNaN, nothing));
  sample.type = Type::float64;
  CHECK(is_missing(std::numeric_limits<double>::infinity(), nothing));
  sample.type = Type::float32;
  CHECK(is_missing(9.96920996838687e+36, nothing));  // the default fill of float
  CHECK_FALSE(is_missing(-1e34, nothing));
  const auto with = [](const char* name, auto value) {
    return [=](Writer& file, VariableId h) { file.attribute(h, name, value); };
  };
  CHECK(is_missing(-1e34, with("_FillValue", -1e34)));
  // missing_value is written as double here: compared as float it is the stored one.
  CHECK(is_missing(-1e34, with("missing_value", -1e34)));
  CHECK(is_missing(1e34, with("missing_value", 1e34)));
  CHECK(is_missing(-99.9, with("missing_value", -99.9)));
  CHECK(is_missing(11.0, with("valid_max", 10.0)));
  CHECK_FALSE(is_missing(10.0, with("valid_max", 10.0)));
  CHECK(is_missing(0.05, with("valid_min", 0.1)));
  CHECK_FALSE(is_missing(double{0.1F}, with("valid_min", 0.1)));
  const auto range = [](Writer& file, VariableId h) {
    file.attribute(h, "valid_range", std::vector<double>{0.0, 10.0});
  };
  CHECK(is_missing(-1.0, range));
  CHECK(is_missing(11.0, range));
  CHECK_FALSE(is_missing(9.0, range));
}

TEST_CASE("a range of unpacked type limits unpacked values") {
  const TemporaryFolder folder;
  Sample sample;
  sample.type = Type::int16;
  sample.values = std::vector<double>(72, 500.0);
  sample.values[1] = 2000;
  const auto scaled = [](const char* name, auto value) {
    return [=](Writer& file, VariableId h) {
      file.attribute(h, "scale_factor", 0.01);
      file.attribute(h, name, value);
    };
  };
  // 5 and 20 unpacked: as double the limit of 10 is one of unpacked values, as int of stored ones.
  Raster raster = read_raster(write_with(folder, sample, scaled("valid_max", 10.0)), {});
  CHECK(raster.values[0] == doctest::Approx(5.0));
  CHECK(std::isnan(raster.values[1]));
  raster = read_raster(write_with(folder, sample, scaled("valid_max", 1999)), {});
  CHECK(raster.values[0] == doctest::Approx(5.0));
  CHECK(std::isnan(raster.values[1]));
  raster = read_raster(write_with(folder, sample, scaled("valid_max", 2000)), {});
  CHECK(raster.values[1] == doctest::Approx(20.0));
}

TEST_CASE("stored negative numbers of an unsigned variable are large ones") {
  const TemporaryFolder folder;
  Sample sample;
  sample.type = Type::int8;
  sample.values = std::vector<double>(72, -1.0);
  sample.values[0] = 100.0;
  const Raster raster = read_raster(
      write_with(folder, sample,
                 [](Writer& file, VariableId h) { file.attribute(h, "_Unsigned", "true"); }),
      {});
  CHECK(raster.values[0] == 100.0);
  CHECK(raster.values[1] == 255.0);
}

TEST_CASE("coordinates are known by units, standard name, axis or name") {
  const TemporaryFolder folder;
  const auto read_with = [&](const std::string& lat_name, const std::string& lon_name,
                             const char* key, const char* lat_value, const char* lon_value) {
    Sample sample;
    sample.lat_name = lat_name;
    sample.lon_name = lon_name;
    sample.attributes = [=](Writer& file, VariableId lat, VariableId lon, VariableId) {
      if (key == nullptr) return;
      file.attribute(lat, key, lat_value);
      file.attribute(lon, key, lon_value);
    };
    return read_raster(write(folder, sample), {}).n_lat() == 6;
  };
  CHECK(read_with("j", "i", "units", "degrees_north", "degrees_east"));
  CHECK(read_with("j", "i", "units", "degreeN", "degree_E"));
  CHECK(read_with("j", "i", "standard_name", "latitude", "longitude"));
  CHECK(read_with("j", "i", "axis", "Y", "X"));
  CHECK(read_with("latitude", "longitude", nullptr, "", ""));
  CHECK(read_with("y", "x", nullptr, "", ""));
  CHECK(read_with("LAT", "LON", "units", "degrees", "degrees"));
  expect_error(ErrorKind::input, {"h.nc", "no variable on a latitude", "h(6, 12)"},
               [&] { read_with("j", "i", nullptr, "", ""); });
  expect_error(ErrorKind::input, {"h.nc", "no variable on a latitude"},
               [&] { read_with("lat", "lon", "units", "radians", "radians"); });
  // Metres along x and y are a projection.
  expect_error(ErrorKind::input, {"h.nc", "no variable on a latitude"},
               [&] { read_with("y", "x", "units", "m", "m"); });
}

TEST_CASE("values come in the unit asked for") {
  const TemporaryFolder folder;
  const auto first_value = [&](const char* file_units, const RasterRequest& request) {
    Sample sample;
    sample.values = std::vector<double>(72, 5.0);
    return read_raster(write_with(folder, sample,
                                  [&](Writer& file, VariableId h) {
                                    if (file_units != nullptr) {
                                      file.attribute(h, "units", file_units);
                                    }
                                  }),
                       request)
        .values[0];
  };
  RasterRequest metres;
  metres.units = "m";
  CHECK(first_value("km", metres) == 5000.0);
  CHECK(first_value("METERS", metres) == 5.0);
  CHECK(first_value("km", {}) == 5.0);
  expect_error(ErrorKind::input, {"h.nc", "'h'", "no `units` attribute", "m is needed"},
               [&] { first_value(nullptr, metres); });
  expect_error(ErrorKind::input, {"h.nc", "'h'", "'degC'", "'m'"},
               [&] { first_value("degC", metres); });
  metres.file_units = "km";
  CHECK(first_value(nullptr, metres) == 5000.0);
  CHECK(first_value("nonsense", metres) == 5000.0);
}

TEST_CASE("units convert as physics says, and only between like ones") {
  const auto convert = [](const char* from, const char* to, double value) {
    const auto conversion = unit_conversion(from, to);
    return conversion ? conversion->scale * value + conversion->offset : kNaN;
  };
  CHECK(convert("cm2/s2", "m2 s-2", 5.0) == doctest::Approx(5e-4));
  CHECK(convert("cm**2 s**-2", "m2 s-2", 5.0) == doctest::Approx(5e-4));
  CHECK(convert("m^2/s^2", "m2 s-2", 5.0) == doctest::Approx(5.0));
  CHECK(convert("m2.s-2", "m2 s-2", 5.0) == doctest::Approx(5.0));
  CHECK(convert("m*m/s/s", "m2 s-2", 5.0) == doctest::Approx(5.0));
  CHECK(convert("M/S", "m s-1", 3.0) == 3.0);
  CHECK(convert("km/h", "m/s", 36.0) == doctest::Approx(10.0));
  CHECK(convert("Deg C", "K", 0.0) == doctest::Approx(273.15));
  CHECK(convert("K", "degC", 273.15) == doctest::Approx(0.0));
  CHECK(convert("degrees_Celsius", "degC", 4.0) == 4.0);
  CHECK(convert("psu", "g/kg", 35.0) == doctest::Approx(35.0));
  CHECK(convert("PPT", "1e-3", 35.0) == doctest::Approx(35.0));
  CHECK(convert("1", "dimensionless", 2.0) == 2.0);
  for (const char* nonsense : {"", "furlong", "m s", "m2", "m/", "m-", "degC m", "0", "m99"}) {
    CAPTURE(nonsense);
    CHECK_FALSE(unit_conversion(nonsense, "m").has_value());
  }
}

TEST_CASE("what is no lat-lon field is refused with file, variable and reason") {
  const TemporaryFolder folder;
  const auto refuse = [&](Sample sample, std::initializer_list<std::string> parts) {
    expect_error(ErrorKind::input, parts, [&] { read_raster(write(folder, sample), {}); });
    expect_error(ErrorKind::input, {"h.nc", "'h'"},
                 [&] { read_raster(write(folder, sample), {}); });
  };
  Sample sample;
  sample.lat[3] = 20;
  sample.lat[4] = 10;
  refuse(sample, {"latitudes", "not monotonic"});
  sample = {};
  sample.lat[3] = sample.lat[2];
  refuse(sample, {"latitudes", "not monotonic"});
  sample = {};
  sample.lat[5] = 91;
  refuse(sample, {"latitude 91 degrees", "[-90, 90]"});
  sample = {};
  sample.lat[2] = kNaN;
  refuse(sample, {"latitudes 2", "not a number"});
  sample = {};
  sample.lon[3] = sample.lon[4] + 1;
  refuse(sample, {"longitudes", "not monotonic"});
  sample = {};
  sample.lon = even(0, 30, 20);
  refuse(sample, {"longitudes", "more than once round"});
  sample = {};
  sample.values = std::vector<double>(72, kNaN);
  refuse(sample, {"all values are missing"});
  sample = {};
  sample.lat = {5};
  refuse(sample, {"1 latitudes", "at least 2"});
  expect_error(ErrorKind::input, {"h.nc", "no variable 'g'", "h(6, 12)"}, [&] {
    RasterRequest request;
    request.variable = "g";
    read_raster(write(folder, {}), request);
  });
  expect_error(ErrorKind::input, {"h.nc", "'lat'", "1 dimension"}, [&] {
    RasterRequest request;
    request.variable = "lat";
    read_raster(write(folder, {}), request);
  });
  expect_error(ErrorKind::input, {"h.nc", "'h'", "scale_factor = 0"}, [&] {
    read_raster(
        write_with(folder, {},
                   [](Writer& file, VariableId h) { file.attribute(h, "scale_factor", 0.0); }),
        {});
  });
}

TEST_CASE("attributes of packing that are no numbers, or too many, are refused") {
  const TemporaryFolder folder;
  const auto refuse = [&](const auto& change, std::initializer_list<std::string> parts) {
    expect_error(ErrorKind::input, parts, [&] { read_raster(write_with(folder, {}, change), {}); });
  };
  for (const char* const name : {"scale_factor", "add_offset", "valid_min", "missing_value"}) {
    refuse([&](Writer& file, VariableId h) { file.attribute(h, name, "2"); },
           {"h.nc", "'h'", name, "is text where numbers are needed"});
  }
  const std::vector<double> three = {0.0, 1.0, 2.0};
  refuse([&](Writer& file, VariableId h) { file.attribute(h, "scale_factor", three); },
         {"scale_factor has 3 values where 1 is needed"});
  refuse([&](Writer& file, VariableId h) { file.attribute(h, "valid_range", three); },
         {"valid_range has 3 values where 2 are needed"});
}

TEST_CASE("coordinates in radians are refused, said so or not") {
  const TemporaryFolder folder;
  Sample sample;
  for (double& lat : sample.lat) lat *= 1.57 / 75.0;
  for (double& lon : sample.lon) lon *= 6.283 / 360.0;
  expect_error(ErrorKind::input, {"h.nc", "look like radians"},
               [&] { read_raster(write(folder, sample), {}); });
  sample.attributes = [](Writer& file, VariableId lat, VariableId lon, VariableId) {
    file.attribute(lat, "units", "radians");
    file.attribute(lon, "units", "radians");
  };
  RasterRequest request;
  request.variable = "h";
  expect_error(ErrorKind::input, {"h.nc", "is in radians"},
               [&] { read_raster(write(folder, sample), request); });
}

TEST_CASE("a small region about the equator is no globe in radians") {
  const TemporaryFolder folder;
  Sample sample;
  sample.lat = even(-1.5, 0.6, 6);
  sample.lon = even(0, 0.5, 12);
  CHECK(read_raster(write(folder, sample), {}).n_lat() == 6);
}

TEST_CASE("several candidates, curvilinear grids and huge fields are refused") {
  const TemporaryFolder folder;
  const std::string path = folder.file("many.nc");
  {
    Writer file(path, Format::netcdf4);
    const auto y = file.define_dimension("lat", 2);
    const auto x = file.define_dimension("lon", 3);
    const auto j = file.define_dimension("j", 2);
    const auto i = file.define_dimension("i", 3);
    const auto m = file.define_dimension("member", 4);
    const auto lat = file.define_variable("lat", Type::float64, {y});
    const auto lon = file.define_variable("lon", Type::float64, {x});
    file.define_variable("a", Type::float32, {y, x});
    file.define_variable("b", Type::float32, {y, x});
    file.define_variable("ensemble", Type::float32, {m, y, x});
    file.define_variable("nav_lat", Type::float32, {j, i});
    const auto sst = file.define_variable("sst", Type::float32, {j, i});
    file.define_variable("label", Type::text, {y, x});
    file.attribute(sst, "coordinates", "nav_lon nav_lat");
    file.end_definitions();
    file.put(lat, std::vector<double>{0, 1});
    file.put(lon, std::vector<double>{0, 1, 2});
    file.close();
  }
  const auto read = [&](const std::string& variable) {
    RasterRequest request;
    request.variable = variable;
    return [=] { read_raster(path, request); };
  };
  expect_error(ErrorKind::input, {"many.nc", "2 variables", "a(2, 3), b(2, 3)", "`variable`"},
               read(""));
  expect_error(ErrorKind::input, {"many.nc", "'sst'", "curvilinear", "cdo"}, read("sst"));
  expect_error(ErrorKind::input, {"many.nc", "'ensemble'", "'member'", "4 entries"},
               read("ensemble"));
  expect_error(ErrorKind::input, {"many.nc", "'label'", "text"}, read("label"));
  {
    Writer file(path, Format::netcdf4);
    const auto y = file.define_dimension("lat", 100000);
    const auto x = file.define_dimension("lon", 200000);
    file.define_variable("lat", Type::float64, {y});
    file.define_variable("lon", Type::float64, {x});
    file.compress(file.define_variable("h", Type::int8, {y, x}), 1);
    file.end_definitions();
    file.close();
  }
  expect_error(ErrorKind::input, {"many.nc", "'h'", "100000 x 200000", "too many"}, read("h"));
}

TEST_CASE("time and level are chosen by index, and must be when there are several") {
  const TemporaryFolder folder;
  const std::string path = write_deep(folder, {0, 10, 50}, "m", "down");
  RasterRequest request;
  expect_error(ErrorKind::input, {"deep.nc", "'TEMP'", "'time' has 2 entries", "`time`", "0 to 1"},
               [&] { read_raster(path, request); });
  request.time_index = 1;
  expect_error(ErrorKind::input, {"'TEMP'", "'z' has 3 entries", "`level`", "0 to 2"},
               [&] { read_raster(path, request); });
  request.level_index = 2;
  const Raster raster = read_raster(path, request);
  CHECK(at(raster, 1, 3) == 1000 + 200 + 10 + 3);
  request.units = "K";
  CHECK(at(read_raster(path, request), 1, 3) == doctest::Approx(1213 + 273.15));
  request.time_index = 2;
  expect_error(ErrorKind::input, {"'TEMP'", "`time` = 2", "0 to 1"},
               [&] { read_raster(path, request); });
  RasterRequest flat;
  flat.time_index = 1;
  expect_error(ErrorKind::input, {"h.nc", "'h'", "`time` = 1", "no time dimension"},
               [&] { read_raster(write(folder, {}), flat); });
  flat.time_index = 0;
  CHECK(read_raster(write(folder, {}), flat).n_lat() == 6);
}

TEST_CASE("a stack has its levels from the surface down, whatever the file's order") {
  const TemporaryFolder folder;
  RasterRequest request;
  request.time_index = 0;
  const auto read = [&](const std::vector<double>& depths, const char* units,
                        const char* positive) {
    return read_raster_stack(write_deep(folder, depths, units, positive), request);
  };
  const RasterStack down = read({0, 10, 50}, "METERS", "down");
  CHECK(down.depth_m == std::vector<double>{0, 10, 50});
  CHECK(at(down.levels[2], 0, 0) == 200.0);
  const RasterStack up = read({-0.05, -0.01, 0}, "km", "up");
  REQUIRE(up.levels.size() == 3);
  CHECK(up.depth_m[2] == doctest::Approx(50.0));
  CHECK(at(up.levels[0], 0, 0) == 200.0);
  CHECK(at(up.levels[2], 0, 0) == 0.0);
  expect_error(ErrorKind::input, {"deep.nc", "'TEMP'", "-10 m", "positive"}, [&] {
    read({0, -10, -50}, "m", "down");
  });
  expect_error(ErrorKind::input, {"deep.nc", "'z'", "units"}, [&] { read({0, 10}, "", "down"); });
  expect_error(ErrorKind::input, {"deep.nc", "'TEMP'", "two levels at 10 m"}, [&] {
    read({0, 10, 10}, "m", "down");
  });
  expect_error(ErrorKind::input, {"h.nc", "'h'", "none of its dimensions is a depth"},
               [&] { read_raster_stack(write(folder, {}), {}); });
}

TEST_CASE("any rotation of the columns and any packing give the same field back") {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    Sample sample;
    const auto n = static_cast<std::size_t>(8 + hash64(seed, 1) % 30);
    const double first = -360.0 + 720.0 * uniform01(seed, 2);
    sample.lon = even(first, 360.0 / static_cast<double>(n), n + hash64(seed, 3) % 2);
    sample.format = seed % 2 == 0 ? Format::cdf5 : Format::netcdf4;
    sample.lon_first = hash64(seed, 4) % 2 == 0;
    if (seed % 3 == 0) sample.type = Type::int32;
    const Raster raster = read_raster(write(folder, sample), {});
    check_sound(raster);
    CHECK(raster.periodic);
    REQUIRE(raster.n_lon() == n);
    for (std::size_t column = 0; column < n; ++column) {
      CHECK(at(raster, 4, column) == 400.0 + static_cast<double>(column));
      const double turn = std::remainder(raster.lon_deg[column] - sample.lon[column], 360.0);
      CHECK(std::abs(turn) < 1e-9);
    }
  }
}

TEST_CASE("the fields of ferret-datasets are read as they are") {
  if (!has_data_file("etopo5.cdf", kDefaultDataFolder, {})) {
    MESSAGE("skipped: ferret-datasets is not installed");
    return;
  }
  const auto file = [](const char* name) { return find_data_file(name, kDefaultDataFolder, {}); };
  RasterRequest metres;
  metres.units = "m";
  const Raster etopo5 = read_raster(file("etopo5.cdf"), metres);
  check_sound(etopo5);
  CHECK(etopo5.periodic);
  CHECK(etopo5.n_lat() == 2161);
  CHECK(etopo5.n_lon() == 4320);
  CHECK(etopo5.lon_deg[4319] == doctest::Approx(360.0 - 1.0 / 12).epsilon(1e-14));
  CHECK(range_of(etopo5).min == -10376.0);
  CHECK(range_of(etopo5).max == 7833.0);
  const Raster etopo20 = read_raster(file("etopo20.cdf"), metres);
  check_sound(etopo20);
  CHECK(etopo20.periodic);
  CHECK(etopo20.n_lon() == 1080);
  for (const char* name : {"etopo40.cdf", "etopo60.cdf", "etopo120.cdf"}) {
    const Raster raster = read_raster(file(name), metres);
    check_sound(raster);
    CHECK(raster.periodic);
    CHECK(range_of(raster).missing == 0.0);
  }
  RasterRequest temperature;
  temperature.variable = "TEMP";
  temperature.units = "degC";
  const RasterStack levitus = read_raster_stack(file("levitus_climatology.cdf"), temperature);
  CHECK(levitus.depth_m.size() == 20);
  CHECK(levitus.depth_m[0] == 0.0);
  CHECK(range_of(levitus.levels[0]).min > -3.0);
  CHECK(range_of(levitus.levels[0]).max < 35.0);
  CHECK(range_of(levitus.levels[0]).missing > 0.3);
  RasterRequest january;
  january.variable = "SST";
  january.time_index = 0;
  const Raster positive_fill = read_raster(file("esku_heat_budget.cdf"), january);
  check_sound(positive_fill);
  CHECK(range_of(positive_fill).max < 40.0);
  CHECK(range_of(positive_fill).missing > 0.1);
  january.variable = "UWND";
  CHECK(std::abs(range_of(read_raster(file("monthly_navy_winds.cdf"), january)).max) < 50.0);
}

TEST_CASE("the eddy energy and Rossby radius files are read as they are") {
  const char* folder = std::getenv("DELOS_TEST_DATA");
  if (folder == nullptr) {
    MESSAGE("skipped: DELOS_TEST_DATA is not set");
    return;
  }
  const std::string data(folder);
  RasterRequest request;
  request.units = "m2 s-2";
  const Raster mean = read_raster(data + "/eke_mean_1993-2022_0p25.nc", request);
  check_sound(mean);
  CHECK(mean.periodic);
  CHECK(mean.n_lat() == 520);
  CHECK(range_of(mean).min > 0.0);
  CHECK(range_of(mean).max == doctest::Approx(5.8746).epsilon(1e-4));  // one coastal cell
  request.time_index = 1;
  const Raster snapshot = read_raster(data + "/eke_snapshots_2016_2019_0p25.nc", request);
  CHECK(snapshot.periodic);
  CHECK(range_of(snapshot).max < 3.5);
  CHECK(range_of(snapshot).missing > 0.3);
  RasterRequest radius;
  radius.variable = "rossby_radius";
  radius.units = "km";
  const Raster rossby = read_raster(data + "/rossby_radius_levitus94_1deg.nc", radius);
  CHECK(range_of(rossby).max < 400.0);
  CHECK(range_of(rossby).max > 100.0);
}
