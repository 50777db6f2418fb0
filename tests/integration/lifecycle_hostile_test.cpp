// SPDX-License-Identifier: BSD-3-Clause
// Spacings that no mesh can follow well, and smooth ones in awkward places: all must end with a
// valid mesh whose report says what it is worth, or with an error that says what to do.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "support/products.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using testing::checked;
using testing::made;

namespace {

void check_count(const Product& product, double tolerance) {
  const auto n = static_cast<double>(product.report.quality.n_vertices);
  CHECK(n == doctest::Approx(product.report.expected_vertices).epsilon(tolerance));
}

void check_certificate(const Quality& quality) {
  CHECK(quality.n_obtuse == 0);
  CHECK(quality.relative_edge_min.value >= 0.65);
  CHECK(quality.dual_ratio_min.value > 0.1);
}

/// How many triangles polish left below its target, as the report tells.
std::int64_t n_below_target(const Product& product) {
  for (const ReportSection& section : product.report.sections) {
    if (section.name != "relax") continue;
    for (const auto& [key, value] : section.values) {
      if (key == "n_below_target") return std::get<std::int64_t>(value);
    }
  }
  FAIL("the report has no relax.n_below_target");
  return -1;
}

std::string disc(const std::string& centre, const std::string& more) {
  return "    - {type: disc, centre: [" + centre + "], " + more + "}\n";
}

constexpr char kGaussian[] =
    "radius: 4 deg, spacing: 80 km, outside: 700 km, transition: gaussian, width: 12 deg";

/// Nodes of 300 km times a random number in 0.3 .. 3, a degree apart.
void write_noise(const testing::TemporaryFolder& folder) {
  testing::write_field(folder.file("noise.nc"), {"h", "km", 180}, [](std::uint64_t node, auto...) {
    return 300.0 * (0.3 + 2.7 * uniform01(11, node));
  });
}

ErrorKind kind_of_error(const std::string& yaml) {
  try {
    made(yaml, 2);
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find("gradient_limit") != std::string::npos);
    return error.kind();
  }
  return ErrorKind::internal;
}

}  // namespace

TEST_CASE("a contrast of 1 to 1000 is meshed where its gradient is limited") {
  const Product product = checked(
      "sizing:\n  resolution: 0.25 deg\n  gradient_limit: 0.15\n  sources:\n" +
      disc("30 deg, 10 deg",
           "radius: 0.5 deg, spacing: 1 km, outside: 1000 km, transition: linear, width: 0.3 deg"));
  check_count(product, 0.03);
  check_certificate(product.report.quality);
  CHECK(product.report.quality.spacing_max_m > 900.0 * product.report.quality.spacing_min_m);
}

TEST_CASE("a patch between coarse cells is refused, not overlooked, where nothing is limited") {
  CHECK(kind_of_error("sizing:\n  resolution: 0.25 deg\n  sources:\n" +
                      disc("30 deg, 10 deg",
                           "radius: 0.5 deg, spacing: 1 km, outside: 1000 km, transition: linear, "
                           "width: 0.3 deg")) == ErrorKind::input);
}

TEST_CASE("a step is meshed well with the limiter, and without it the report says how badly") {
  const std::string box =
      "sizing:\n  resolution: 1 deg\n  sources:\n"
      "    - {type: box, west: 0 deg, east: 60 deg, south: -20 deg, north: 30 deg,\n"
      "       spacing: 100 km, outside: 600 km, transition: linear, width: 0 deg}\n";
  const Product limited = checked(box + "  gradient_limit: 0.15\n");
  check_count(limited, 0.03);
  check_certificate(limited.report.quality);
  const Product free = checked(box);
  CHECK(free.report.quality.n_obtuse > 0);
  CHECK(n_below_target(free) > free.report.quality.n_obtuse);
  CHECK(free.report.quality.relative_edge_min.value < 0.65);
}

TEST_CASE("noise at the scale of the table is tamed by the limiter, or reported, or refused") {
  const testing::TemporaryFolder folder;
  write_noise(folder);
  const std::string raster =
      "sizing:\n  resolution: 1 deg\n  sources: [{type: raster, file: noise.nc, variable: h}]\n";
  const Product limited = checked(raster + "  gradient_limit: 0.1\n", folder.file(""));
  check_count(limited, 0.05);
  CHECK(limited.report.quality.relative_edge_min.value >= 0.5);
  try {
    const Product free = checked(raster, folder.file(""));
    CHECK(n_below_target(free) > 0);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::input);
    CHECK(std::string(error.what()).find("gradient_limit") != std::string::npos);
  }
}

TEST_CASE("poles and the date line inside the finest patch are places like any other") {
  for (const char* centre : {"0 deg, 90 deg", "77 deg, -90 deg", "180 deg, 12 deg"}) {
    const Product product =
        checked("sizing:\n  resolution: 1 deg\n  gradient_limit: 0.15\n  sources:\n" +
                disc(centre, kGaussian));
    check_count(product, 0.03);
    check_certificate(product.report.quality);
  }
}

TEST_CASE("very flat bodies with a patch at a tip keep all guarantees") {
  const Product product = checked(
      "surface: {shape: ellipsoid, radii: [6371.22 km, 4459.854 km, 2548.488 km]}\n"
      "sizing:\n  resolution: 1 deg\n  gradient_limit: 0.15\n  sources:\n" +
      disc("10 deg, 80 deg", kGaussian));
  check_count(product, 0.03);
  check_certificate(product.report.quality);
  const Product disc_like = checked(
      "surface: {shape: ellipsoid, radii: [6371.22 km, 6371.22 km, 1274.244 km]}\n"
      "sizing: {sources: [{type: constant, spacing: 250 km}]}\n");
  check_count(disc_like, 0.03);
  CHECK(disc_like.report.quality.n_obtuse == 0);
}

TEST_CASE("a spacing larger than a flat body's bends is refused with the place") {
  try {
    made(
        "surface: {shape: ellipsoid, radii: [6371.22 km, 6371.22 km, 637.122 km]}\n"
        "sizing: {sources: [{type: constant, spacing: 150 km}]}\n",
        2);
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::input);
    CHECK(std::string(error.what()).find("bends with a radius of 66.6") != std::string::npos);
  }
}

TEST_CASE("eddies and Rossby radii, as recipes combine them, give the same bits everywhere") {
  checked(
      "sizing:\n  resolution: 1 deg\n  gradient_limit: 0.1\n  combine: min\n  sources:\n"
      "    - {type: latitude_profile, latitude: [-90 deg, -60 deg, 0 deg, 60 deg, 90 deg],\n"
      "       spacing: [90 km, 120 km, 450 km, 120 km, 90 km], interpolation: cubic}\n" +
      disc("-65 deg, 38 deg", kGaussian) + disc("145 deg, 36 deg", kGaussian));
}
