// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/synthetic.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "core/elementary.hpp"
#include "core/types.hpp"
#include "io/netcdf.hpp"

namespace delos::benchmark {
namespace {

constexpr double kRotation = 7.292e-5;  // of the Earth, radians a second
constexpr double kEarth_m = 6371220.0;

/// First baroclinic Rossby radius: min(c / |f|, sqrt(c / 2 beta)) with a wave speed c that falls
/// from 2.9 m/s at the equator to 0.4 m/s at the poles (about the zonal mean of Chelton et al.
/// 1998).
double rossby_radius_m(double lat_rad) {
  const double sine = elementary::sin(lat_rad), cosine = elementary::cos(lat_rad);
  const double speed = 0.4 + 2.5 * cosine * cosine;
  const double beta = 2.0 * kRotation * cosine / kEarth_m;
  const double f = 2.0 * kRotation * std::abs(sine);
  const double equatorial_m = beta > 0.0 ? std::sqrt(speed / (2.0 * beta)) : speed / f;
  return f > 0.0 ? std::min(speed / f, equatorial_m) : equatorial_m;
}

/// A place of strong eddies: a Gaussian of these half widths in degrees.
struct Jet {
  double lon_deg, lat_deg, width_lon_deg, width_lat_deg, eke_m2_per_s2;
};
constexpr double kZonal = 1e6;  // width of a jet that goes round the globe
constexpr Jet kJets[] = {
    {-60.0, 38.0, 16.0, 4.0, 0.22},    // Gulf Stream
    {150.0, 35.0, 16.0, 4.0, 0.22},    // Kuroshio
    {22.0, -38.0, 16.0, 4.0, 0.22},    // Agulhas
    {-52.0, -40.0, 8.0, 5.0, 0.15},    // Brazil-Malvinas
    {155.0, -33.0, 6.0, 6.0, 0.10},    // East Australian
    {-88.0, 25.0, 6.0, 3.0, 0.12},     // Loop Current
    {0.0, -52.0, kZonal, 5.0, 0.025},  // circumpolar
    {0.0, 4.0, kZonal, 3.0, 0.04},     // tropical instability
    {0.0, -4.0, kZonal, 3.0, 0.03},
};
constexpr double kQuietEke = 0.0025;  // m2 s-2 far from all jets
constexpr double kNoDataPoleward_deg = 72.0, kNoDataEquator_deg = 2.0;

/// Waves whose sum breaks the jets into eddies: whole wave numbers along the parallel.
struct Wave {
  double along, across, phase;
};
constexpr Wave kWaves[] = {
    {71.0, 53.0, 0.3}, {89.0, -67.0, 1.7}, {113.0, 31.0, 4.1}, {57.0, -97.0, 2.6}};

double eddies_at(double lon_deg, double lat_deg) {
  double sum = 0.0;
  for (const Wave& wave : kWaves) {
    sum +=
        elementary::sin((wave.along * lon_deg + wave.across * lat_deg) / kDegPerRad + wave.phase);
  }
  return sum / static_cast<double>(std::size(kWaves));
}

double eke_m2_per_s2(double lon_deg, double lat_deg) {
  double eke = kQuietEke;
  for (const Jet& jet : kJets) {
    const double away_deg = std::abs(lon_deg - jet.lon_deg);
    const double x = std::min(away_deg, 360.0 - away_deg) / jet.width_lon_deg;
    const double y = (lat_deg - jet.lat_deg) / jet.width_lat_deg;
    eke += jet.eke_m2_per_s2 * elementary::exp(-x * x - y * y);
  }
  return eke * (1.0 + 1.2 * eddies_at(lon_deg, lat_deg)) + 1e-4;
}

}  // namespace

std::string rossby_profile() {
  constexpr int kSteps = 72;
  std::string latitudes, spacings;
  for (int i = 0; i <= kSteps; ++i) {
    const double lat_deg = -90.0 + 180.0 * i / kSteps;
    char latitude[32], spacing[32];
    std::snprintf(latitude, sizeof latitude, "%s%.1f deg", i == 0 ? "" : ", ", lat_deg);
    std::snprintf(spacing, sizeof spacing, "%s%.2f km", i == 0 ? "" : ", ",
                  2e-3 * rossby_radius_m(lat_deg / kDegPerRad));
    latitudes += latitude;
    spacings += spacing;
  }
  return "latitude: [" + latitudes + "], spacing: [" + spacings + "], interpolation: cubic";
}

void write_eddies(const std::string& path) {
  constexpr std::size_t kLat = 720, kLon = 1440;
  std::vector<double> lat_deg, lon_deg;
  for (std::size_t j = 0; j < kLat; ++j) lat_deg.push_back(-89.875 + 0.25 * static_cast<double>(j));
  for (std::size_t i = 0; i < kLon; ++i) {
    lon_deg.push_back(-179.875 + 0.25 * static_cast<double>(i));
  }
  std::vector<float> eke;
  eke.reserve(kLat * kLon);
  for (const double lat : lat_deg) {
    const bool is_seen =
        std::abs(lat) <= kNoDataPoleward_deg && std::abs(lat) >= kNoDataEquator_deg;
    for (const double lon : lon_deg) {
      eke.push_back(is_seen ? static_cast<float>(std::max(eke_m2_per_s2(lon, lat), 0.0))
                            : std::numeric_limits<float>::quiet_NaN());
    }
  }
  netcdf::Writer file(path, netcdf::Format::cdf5);
  const auto rows = file.define_dimension("latitude", kLat);
  const auto columns = file.define_dimension("longitude", kLon);
  const auto lat = file.define_variable("latitude", netcdf::Type::float64, {rows});
  const auto lon = file.define_variable("longitude", netcdf::Type::float64, {columns});
  const auto field = file.define_variable("eke", netcdf::Type::float32, {rows, columns});
  file.attribute(lat, "units", "degrees_north");
  file.attribute(lon, "units", "degrees_east");
  file.attribute(field, "units", "m2 s-2");
  file.end_definitions();
  file.put(lat, std::span<const double>(lat_deg));
  file.put(lon, std::span<const double>(lon_deg));
  file.put(field, std::span<const float>(eke));
  file.close();
}

}  // namespace delos::benchmark
