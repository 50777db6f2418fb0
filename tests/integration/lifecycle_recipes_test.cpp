// SPDX-License-Identifier: BSD-3-Clause
// The recipes of ocean modellers on made up oceans: rough coasts at 5 minutes, radii and eddies
// with gaps on land and noise between neighbours, together and alone. All at the sizes of a test,
// all valid, all the same to the last bit on 1, 2, 5 and 8 threads.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/elementary.hpp"
#include "core/hash.hpp"
#include "support/products.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using testing::checked;

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// Metres: continents of some thousand km that cross the date line and the south pole.
double continents_m(double lat_deg, double lon_deg) {
  const double lat = lat_deg * kRadPerDeg, lon = lon_deg * kRadPerDeg;
  const double along = elementary::cos(3.0 * lon + 2.0 * elementary::sin(4.0 * lat));
  return 4000.0 * (elementary::cos(lat) * along - 0.9 * elementary::sin(lat)) - 1800.0;
}

/// The same with islands and lakes of single cells wherever the sea is shallow.
double rough_elevation_m(std::uint64_t node, double lat_deg, double lon_deg) {
  return continents_m(lat_deg, lon_deg) + 300.0 * (uniform01(3, node) - 0.5);
}

double rossby_radius_km(std::uint64_t node, double lat_deg, double lon_deg) {
  const double depth_m = -continents_m(lat_deg, lon_deg);
  if (depth_m <= 0.0) return kMissing;
  const double smooth =
      4.0 * std::sqrt(depth_m / 4000.0) / (0.02 + elementary::sin(std::abs(lat_deg) * kRadPerDeg));
  return std::min(smooth, 230.0) * (0.9 + 0.2 * uniform01(5, node));
}

/// m2/s2: two meandering jets over a quiet sea, rough from node to node.
double kinetic_energy(std::uint64_t node, double lat_deg, double lon_deg) {
  if (continents_m(lat_deg, lon_deg) >= 0.0) return kMissing;
  const double axis_deg = 40.0 + 5.0 * elementary::sin(4.0 * lon_deg * kRadPerDeg);
  const double off = (std::abs(lat_deg) - axis_deg) / 4.0;
  const double jet = 0.25 * elementary::exp(-0.5 * off * off);
  return (0.002 + jet) * (0.5 + uniform01(7, node));
}

const std::string kRossby =
    "    - {type: rossby, radius_file: rossby.nc, radius_variable: radius, factor: 10}\n";
const std::string kEddies =
    "    - {type: eke, file: eke.nc, variable: eke, form: linear, quiet: [0.05 m/s, 600 km],\n"
    "       energetic: [0.45 m/s, 100 km], fill_speed: 0.03 m/s, clamp: 0.5 m2/s2}\n";

struct Ocean {
  Ocean() {
    testing::write_field(folder.file("rossby.nc"), {"radius", "km", 180}, rossby_radius_km);
    testing::write_field(folder.file("eke.nc"), {"eke", "m2 s-2", 180}, kinetic_energy);
  }
  testing::TemporaryFolder folder;
};

void check_grid(const Product& product) {
  const Quality& quality = product.report.quality;
  CHECK(static_cast<double>(quality.n_vertices) ==
        doctest::Approx(product.report.expected_vertices).epsilon(0.03));
  CHECK(quality.n_obtuse == 0);
  CHECK(quality.relative_edge_min.value >= 0.65);
}

}  // namespace

TEST_CASE("the distance to a rough coast of 5 minutes gives a valid mesh") {
  const testing::TemporaryFolder folder;
  testing::write_field(folder.file("sea_floor.nc"), {"z", "m", 2160}, rough_elevation_m);
  check_grid(
      checked("bathymetry: {file: sea_floor.nc, variable: z, units: m}\n"
              "sizing:\n  resolution: 5 arcmin\n  gradient_limit: 0.15\n  sources:\n"
              "    - {type: coast, spacing: 120 km, rate: 0.2, max: 500 km}\n",
              folder.file("")));
}

TEST_CASE("Rossby radii and eddies with gaps and noise give a valid mesh, alone and together") {
  const Ocean ocean;
  for (const std::string& sources : {kRossby, kEddies, kRossby + kEddies}) {
    check_grid(
        checked("sizing:\n  resolution: 0.5 deg\n  clamp: {min: 100 km, max: 600 km}\n"
                "  gradient_limit: 0.15\n  combine: min\n  sources:\n" +
                    sources,
                ocean.folder.file("")));
  }
}
