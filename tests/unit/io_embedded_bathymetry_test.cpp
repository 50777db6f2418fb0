// SPDX-License-Identifier: BSD-3-Clause
#include "io/embedded_bathymetry.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>

#include "core/hash.hpp"
#include "core/types.hpp"
#include "io/data_files.hpp"
#include "io/rasters.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using testing::expect_error;
using testing::TemporaryFolder;

namespace {

constexpr std::size_t kNodesPerCell = 6;

/// The mean of a node field over one half-degree cell, by area: a node stands for the twelfth of
/// a degree around it.
double cell_mean(const Raster& nodes, std::size_t row, std::size_t column) {
  const double half_deg = 0.5 / 12.0;
  const double south = -90.0 + 0.5 * static_cast<double>(row);
  double sum = 0.0;
  double sum_weights = 0.0;
  for (std::size_t j = 0; j <= kNodesPerCell; ++j) {
    const std::size_t node_row = row * kNodesPerCell + j;
    const double lat = nodes.lat_deg[node_row];
    const double band = std::sin(std::min(lat + half_deg, south + 0.5) * kRadPerDeg) -
                        std::sin(std::max(lat - half_deg, south) * kRadPerDeg);
    for (std::size_t i = 0; i <= kNodesPerCell; ++i) {
      // The cells begin at -180, the nodes of ETOPO5 at 0.
      const std::size_t node = (column * kNodesPerCell + i + nodes.n_lon() / 2) % nodes.n_lon();
      const double weight = band * (i == 0 || i == kNodesPerCell ? 0.5 : 1.0);
      sum += weight * nodes.values[node_row * nodes.n_lon() + node];
      sum_weights += weight;
    }
  }
  return sum / sum_weights;
}

}  // namespace

TEST_CASE("the built-in sea floor has the area of the ocean and its depths") {
  const Raster raster = embedded_bathymetry();
  REQUIRE(raster.n_lat() == 360);
  REQUIRE(raster.n_lon() == 720);
  REQUIRE(raster.values.size() == 360 * 720);
  CHECK(raster.periodic);
  CHECK(raster.lat_deg.front() == -89.75);
  CHECK(raster.lat_deg.back() == 89.75);
  CHECK(raster.lon_deg.front() == -179.75);
  CHECK(raster.lon_deg.back() == 179.75);
  const double radius_km = 6371.22;
  double ocean_km2 = 0.0;
  double volume_km3 = 0.0;
  for (std::size_t row = 0; row < raster.n_lat(); ++row) {
    const double cell_km2 = radius_km * radius_km * 0.5 * kRadPerDeg *
                            (std::sin((raster.lat_deg[row] + 0.25) * kRadPerDeg) -
                             std::sin((raster.lat_deg[row] - 0.25) * kRadPerDeg));
    for (std::size_t column = 0; column < raster.n_lon(); ++column) {
      const double z_m = raster.values[row * raster.n_lon() + column];
      REQUIRE(z_m > -11000.0);
      REQUIRE(z_m < 8900.0);
      ocean_km2 += z_m < 0.0 ? cell_km2 : 0.0;
      volume_km3 += z_m < 0.0 ? -z_m * 1e-3 * cell_km2 : 0.0;
    }
  }
  CHECK(ocean_km2 == doctest::Approx(358.9e6).epsilon(0.01));
  CHECK(volume_km3 == doctest::Approx(1.335e9).epsilon(0.02));  // Charette & Smith 2010
  const auto at = [&](double lat, double lon) {
    return raster.values[static_cast<std::size_t>((lat + 90) * 2) * 720 +
                         static_cast<std::size_t>((lon + 180) * 2)];
  };
  CHECK(at(30.2, 90.2) > 4000.0);    // Tibet
  CHECK(at(-40.2, 90.2) < -3000.0);  // southern Indian Ocean
  CHECK(at(0.2, -150.2) < -4000.0);  // central Pacific
  CHECK(at(-80.2, 120.2) > 2000.0);  // Antarctica
}

TEST_CASE("the built-in sea floor is the mean of ETOPO5 over each cell") {
  if (!has_data_file("etopo5.cdf", kDefaultDataFolder, {})) {
    MESSAGE("skipped: ferret-datasets is not installed");
    return;
  }
  const Raster cells = embedded_bathymetry();
  const Raster nodes = read_raster(find_data_file("etopo5.cdf", kDefaultDataFolder, {}), {});
  REQUIRE(nodes.lon_deg[0] == 0.0);
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const std::size_t row = hash64(1, i) % 360;
    const std::size_t column = hash64(2, i) % 720;
    CAPTURE(row);
    CAPTURE(column);
    CHECK(std::abs(cells.values[row * 720 + column] - cell_mean(nodes, row, column)) < 1.0);
  }
}

TEST_CASE("a data file is found beside the settings first, then along the data path") {
  const TemporaryFolder here;
  const TemporaryFolder first;
  const TemporaryFolder second;
  const std::vector<std::string> path = {first.file(""), second.file("")};
  const auto find = [&](const std::string& name) {
    return std::filesystem::path(find_data_file(name, here.file(""), path)).lexically_normal();
  };
  second.write("h.nc", "");
  CHECK(find("h.nc") == second.file("h.nc"));
  first.write("h.nc", "");
  CHECK(find("h.nc") == first.file("h.nc"));
  here.write("h.nc", "");
  CHECK(find("h.nc") == here.file("h.nc"));
  CHECK(find(first.file("h.nc")) == first.file("h.nc"));
  std::filesystem::create_directory(here.file("sub"));
  here.write("sub/g.nc", "");
  CHECK(find("sub/g.nc") == here.file("sub/g.nc"));
  CHECK(find_data_file("g.nc", here.file(""), std::vector<std::string>{"sub"}).find("g.nc") !=
        std::string::npos);
  CHECK(has_data_file("h.nc", here.file(""), path));
  CHECK_FALSE(has_data_file("sub", here.file(""), path));
  CHECK_FALSE(has_data_file("", here.file(""), path));
}

TEST_CASE("a data file that is not found is answered with the places and the package") {
  const TemporaryFolder here;
  const std::vector<std::string> path = {"/nonexistent-data"};
  expect_error(ErrorKind::input,
               {"h.nc", "no such file", here.file("h.nc"), "/nonexistent-data/h.nc", "data_path"},
               [&] { find_data_file("h.nc", here.file(""), path); });
  expect_error(ErrorKind::input, {"etopo5.cdf", "ferret-datasets"},
               [&] { find_data_file("etopo5.cdf", here.file(""), path); });
  expect_error(ErrorKind::input, {"levitus_climatology.cdf", "ferret-datasets"},
               [&] { find_data_file("levitus_climatology.cdf", here.file(""), path); });
  std::filesystem::create_directory(here.file("f.nc"));
  expect_error(ErrorKind::input, {"f.nc is a folder. "},
               [&] { find_data_file("f.nc", here.file(""), path); });
  expect_error(ErrorKind::config, {"empty"}, [&] { find_data_file("", here.file(""), path); });
}
