// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/cases.hpp"

#include "benchmark/synthetic.hpp"
#include "core/error.hpp"

namespace delos::benchmark {
namespace {

constexpr char kWgs84[] = "surface: {shape: wgs84}\n";
constexpr char kTriaxial[] =
    "surface: {shape: ellipsoid, radii: [7645.464 km, 6371.22 km, 5096.976 km]}\n";
constexpr char kEddyFile[] = "eke.nc";

std::string uniform(const std::string& surface, const std::string& spacing_km) {
  return text(surface, "sizing: {sources: [{type: constant, spacing: ", spacing_km, " km}]}");
}

/// h = coarse - (coarse - fine) exp(-(d / 20 deg)^2), d the distance from 40 W 35 N; width = 20 deg
/// / sqrt(2). `more` are further keys of `sizing`.
std::string patch(double fine_km, double coarse_km, const std::string& more) {
  return text(
      "sizing:\n  resolution: 0.25 deg\n  sources:\n"
      "    - {type: disc, centre: [-40 deg, 35 deg], radius: 0 deg, spacing: ",
      fine_km, " km, outside: ", coarse_km,
      " km,\n       transition: gaussian, width: 14.142135623730951 deg}\n", more);
}

std::string rossby() {
  return "sizing:\n  resolution: 0.5 deg\n  sources:\n    - {type: latitude_profile, " +
         rossby_profile() + "}\n  clamp: {min: 30 km, max: 150 km}\n  gradient_limit: 0.15";
}

std::string eddies() {
  return text("sizing:\n  resolution: 0.25 deg\n  sources:\n    - {type: eke, file: ", kEddyFile,
              ", variable: eke, quiet: [0.05 m/s, 60 km], energetic: [0.45 m/s, 10 km],\n"
              "       fill_speed: 0.03 m/s, clamp: 0.5 m2/s2}\n"
              "  clamp: {min: 10 km, max: 60 km}\n  gradient_limit: 0.1");
}

std::string slope(const std::string& data_file) {
  return text(
      "sizing:\n  resolution: 0.25 deg\n"
      "  sources: [{type: slope, cells: 20, smooth: 30 km}]\n"
      "  clamp: {min: 15 km, max: 60 km}\n  land: {spacing: 60 km}\n  gradient_limit: 0.15\n"
      "bathymetry: {file: ",
      data_file, "}");
}

}  // namespace

std::vector<Case> all_cases() {
  const std::string sphere;
  const std::string bathymetry = "etopo5.cdf";
  std::vector<Case> cases = {
      {"U240", uniform(sphere, "240"), false, true},
      {"U120", uniform(sphere, "120"), false, true},
      {"U60", uniform(sphere, "60"), false, true},
      {"U30", uniform(sphere, "30"), false, true},
      {"U15", uniform(sphere, "15")},
      {"U7.5", uniform(sphere, "7.5"), true},
      {"E60", uniform(kWgs84, "60"), false, true},
      {"E30", uniform(kWgs84, "30")},
      {"T60", uniform(kTriaxial, "60"), false, true},
      {"T30", uniform(kTriaxial, "30")},
      {"V1", patch(15.0, 150.0, ""), false, true},
      {"V1fine", patch(3.75, 37.5, "")},
      {"Rossby", rossby(), false, true},
      {"EKE",
       eddies(),
       false,
       true,
       {},
       [](const std::string& folder) { write_eddies(folder + "/" + kEddyFile); }},
      {"Slope", slope(bathymetry), false, true, bathymetry},
  };
  for (const auto& [name, n] : {std::pair{"G100k", "100000"},
                                {"G300k", "300000"},
                                {"G1M", "1000000"},
                                {"G3M", "3000000"},
                                {"G10M", "10000000"}}) {
    cases.push_back({name, patch(15.0, 150.0, text("  cells: ", n)), std::string(name) == "G10M"});
  }
  return cases;
}

}  // namespace delos::benchmark
