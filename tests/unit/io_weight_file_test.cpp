// SPDX-License-Identifier: BSD-3-Clause
#include "io/weight_file.hpp"

#include <doctest/doctest.h>

#include <numeric>

#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"
#include "support/temporary_folder.hpp"

using delos::ErrorKind;
using delos::WeightFile;
using delos::WeightFileGrid;
using delos::netcdf::Format;
using delos::netcdf::Type;
using delos::testing::expect_error;
using delos::testing::TemporaryFolder;

namespace {

WeightFile sample() {
  const delos::Ellipsoid surface = delos::Ellipsoid::wgs84();
  const delos::Grid a =
      delos::samples::grid_of(surface, delos::samples::bisected_icosahedron(surface, 1));
  const delos::Grid b =
      delos::samples::grid_of(surface, delos::samples::bisected_icosahedron(surface, 0));
  return {delos::weight_file_grid(a), delos::weight_file_grid(b), {0, 0, 11}, {0, 41, 7},
          {0.25, 0.75, 1.0},          "First-order Conservative"};
}

void check_equal(const WeightFileGrid& a, const WeightFileGrid& b) {
  CHECK(a.lon_deg == b.lon_deg);
  CHECK(a.lat_deg == b.lat_deg);
  CHECK(a.n_corners == b.n_corners);
  CHECK(a.corner_lon_deg == b.corner_lon_deg);
  CHECK(a.corner_lat_deg == b.corner_lat_deg);
  CHECK(a.area == b.area);
  CHECK(a.fraction == b.fraction);
}

/// A SCRIP file of two cells to one.
void write_scrip(const std::string& path, std::size_t n_weights, std::int32_t address) {
  delos::netcdf::Writer file(path, Format::cdf5);
  const auto links = file.define_dimension("num_links", 2);
  const auto wgts = file.define_dimension("num_wgts", n_weights);
  const auto src = file.define_dimension("src_grid_size", 2);
  const auto dst = file.define_dimension("dst_grid_size", 1);
  const auto matrix = file.define_variable("remap_matrix", Type::float64, {links, wgts});
  const auto from = file.define_variable("src_address", Type::int32, {links});
  const auto to = file.define_variable("dst_address", Type::int32, {links});
  std::vector<delos::netcdf::VariableId> of_src, of_dst;
  for (const char* name : {"center_lat", "center_lon", "area", "frac"}) {
    of_src.push_back(file.define_variable(std::string("src_grid_") + name, Type::float64, {src}));
    of_dst.push_back(file.define_variable(std::string("dst_grid_") + name, Type::float64, {dst}));
  }
  file.attribute(of_src[0], "units", "radians");
  file.end_definitions();
  const std::vector<double> values(2 * n_weights, 0.5), two{0.5, 0.25}, one{1.0};
  const std::vector<std::int32_t> sources{1, address}, targets{1, 1};
  file.put(matrix, std::span<const double>(values));
  file.put(from, std::span<const std::int32_t>(sources));
  file.put(to, std::span<const std::int32_t>(targets));
  for (const auto id : of_src) file.put(id, std::span<const double>(two));
  for (const auto id : of_dst) file.put(id, std::span<const double>(one));
  file.close();
}

}  // namespace

TEST_CASE("weights come back from their file to the bit") {
  const TemporaryFolder folder;
  const WeightFile written = sample();
  for (const Format format : {Format::cdf5, Format::netcdf4}) {
    delos::write_weights(folder.file("w.nc"), written, delos::samples::provenance(), format);
    const WeightFile read = delos::read_weights(folder.file("w.nc"));
    check_equal(read.source, written.source);
    check_equal(read.target, written.target);
    CHECK(read.row == written.row);
    CHECK(read.column == written.column);
    CHECK(read.value == written.value);
    CHECK(read.method == written.method);
  }
}

TEST_CASE("a weight file has ESMF's names, ids from 1 and degrees") {
  const TemporaryFolder folder;
  delos::write_weights(folder.file("w.nc"), sample(), {});
  const delos::netcdf::Reader file(folder.file("w.nc"));
  CHECK(file.dimension("n_a").length == 42);
  CHECK(file.dimension("n_b").length == 12);
  CHECK(file.dimension("n_s").length == 3);
  CHECK(file.dimension("nv_a").length == 6);
  CHECK(file.dimension("nv_b").length == 5);
  CHECK(file.read_int32("row") == std::vector<std::int32_t>{1, 1, 12});
  CHECK(file.read_int32("col") == std::vector<std::int32_t>{1, 42, 8});
  CHECK(file.read_int32("src_grid_dims") == std::vector<std::int32_t>{42});
  CHECK(file.text_attribute("", "map_method") == "Conservative remapping");
  CHECK(file.text_attribute("", "normalization") == "destarea");
  CHECK(file.text_attribute("xv_a", "units") == "degrees");
  const auto area = file.read_double("area_b");
  const double sum = std::accumulate(area.begin(), area.end(), 0.0);
  CHECK(sum == doctest::Approx(delos::Ellipsoid::wgs84().area()).epsilon(1e-12));
}

TEST_CASE("SCRIP's layout is read, radians become degrees") {
  const TemporaryFolder folder;
  write_scrip(folder.file("s.nc"), 1, 2);
  const WeightFile read = delos::read_weights(folder.file("s.nc"));
  CHECK(read.column == delos::Array<delos::Index>{0, 1});
  CHECK(read.row == delos::Array<delos::Index>{0, 0});
  CHECK(read.value == delos::Array<double>{0.5, 0.5});
  CHECK(read.source.lat_deg[1] == doctest::Approx(0.25 * delos::kDegPerRad));
  CHECK(read.source.lon_deg[1] == 0.25);
  CHECK(read.source.corner_lon_deg.empty());
}

TEST_CASE("damaged and foreign weight files are refused by name") {
  const TemporaryFolder folder;
  write_scrip(folder.file("gradients.nc"), 3, 2);
  write_scrip(folder.file("outside.nc"), 1, 3);
  expect_error(ErrorKind::input, {"gradients.nc", "remap_matrix", "first-order"},
               [&] { delos::read_weights(folder.file("gradients.nc")); });
  expect_error(ErrorKind::input, {"outside.nc", "src_address", "names cell 3", "1..2"},
               [&] { delos::read_weights(folder.file("outside.nc")); });
  const delos::Grid grid = delos::samples::grid_of({}, delos::samples::tetrahedron({}));
  delos::netcdf::Writer other(folder.file("other.nc"), Format::cdf5);
  other.define_dimension("n", 1);
  other.end_definitions();
  other.close();
  expect_error(ErrorKind::input, {"other.nc", "remap_matrix"},
               [&] { delos::read_weights(folder.file("other.nc")); });
  WeightFile uneven = sample();
  uneven.row.pop_back();
  expect_error(ErrorKind::output, {"2 rows"},
               [&] { delos::write_weights(folder.file("w.nc"), uneven, {}); });
}
