// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Products of whole configurations, judged as every product must be; made up fields for them.
#include <doctest/doctest.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "dual/build.hpp"
#include "dual/digest.hpp"
#include "io/netcdf.hpp"
#include "lifecycle/generate.hpp"
#include "lifecycle/settings_tree.hpp"
#include "triangulation/validate.hpp"

namespace delos::testing {

inline Product made(const std::string& yaml, int threads, const std::string& folder = ".") {
  parallel::Executor exec(threads);
  Monitor monitor;
  Context context{exec, monitor};
  return generate(context, read_settings(parse_config(yaml, "test.yaml"), folder), {});
}

/// A value of the report; fails the test where there is none.
template <class T>
T value_of(const Report& report, const std::string& section, const std::string& key) {
  for (const ReportSection& candidate : report.sections) {
    if (candidate.name != section) continue;
    for (const auto& [name, value] : candidate.values) {
      if (name == key) return std::get<T>(value);
    }
  }
  FAIL("the report has no " << section << "." << key);
  return {};
}

/// Valid, and the same to the last bit on 1, 2, 5 and 8 threads.
inline Product checked(const std::string& yaml, const std::string& folder = ".") {
  CAPTURE(yaml);
  Product product = made(yaml, 1, folder);
  ValidateOptions options;
  options.delaunay = false;  // judged by the measured count below
  const auto defects = validate(product.mesh, product.settings.surface, options);
  CHECK_MESSAGE(defects.empty(), summary(defects));
  const Quality& quality = product.report.quality;
  CHECK(quality.n_non_delaunay == 0);
  if (!quality.has_border()) CHECK(quality.euler == 2);
  CHECK(quality.n_degenerate == 0);
  CHECK(quality.total_area_error < 1e-12);
  parallel::Executor exec(2);
  for (const int threads : {2, 5, 8}) {
    CAPTURE(threads);
    const Product again = made(yaml, threads, folder);
    CHECK(again.report.digest == product.report.digest);
    CHECK(digest(exec, *again.grid) == digest(exec, *product.grid));
  }
  return product;
}

/// A variable on the centres of cells that cover the globe, twice as many columns as rows.
struct FieldShape {
  std::string name, units;
  std::size_t n_lat;
};

/// Writes law(node, lat_deg, lon_deg) as floats; NaN where it is missing.
template <class Law>
void write_field(const std::string& path, const FieldShape& shape, const Law& law) {
  const std::size_t n_lat = shape.n_lat, n_lon = 2 * n_lat;
  const double step = 180.0 / static_cast<double>(n_lat);
  std::vector<double> lats(n_lat), lons(n_lon);
  for (std::size_t j = 0; j < n_lat; ++j) lats[j] = (static_cast<double>(j) + 0.5) * step - 90.0;
  for (std::size_t i = 0; i < n_lon; ++i) lons[i] = (static_cast<double>(i) + 0.5) * step - 180.0;
  std::vector<float> values;
  values.reserve(n_lat * n_lon);
  for (const double lat : lats) {
    for (const double lon : lons) {
      values.push_back(static_cast<float>(law(std::uint64_t{values.size()}, lat, lon)));
    }
  }
  netcdf::Writer file(path, netcdf::Format::cdf5);
  const auto lat = file.define_dimension("lat", n_lat), lon = file.define_dimension("lon", n_lon);
  const auto lat_id = file.define_variable("lat", netcdf::Type::float64, {lat});
  const auto lon_id = file.define_variable("lon", netcdf::Type::float64, {lon});
  const auto id = file.define_variable(shape.name, netcdf::Type::float32, {lat, lon});
  file.attribute(lat_id, "units", "degrees_north");
  file.attribute(lon_id, "units", "degrees_east");
  file.attribute(id, "units", shape.units.c_str());
  file.end_definitions();
  file.put(lat_id, std::span<const double>(lats));
  file.put(lon_id, std::span<const double>(lons));
  file.put(id, std::span<const float>(values));
  file.close();
}

}  // namespace delos::testing
