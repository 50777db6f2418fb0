// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/rossby.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "sizing/nodes.hpp"

namespace delos {
namespace {

constexpr double kEarthRotation = 7.292115e-5;  // rad/s
constexpr double kEarthRadius = 6371220.0;      // m, for beta = 2 Omega cos(lat) / R
constexpr double kGravity = 9.80665;            // m/s2
/// Sea pressure of a metre of water of 1025 kg/m3, dbar.
constexpr double kDbarPerMetre = 1025.0 * kGravity / 1.0e4;

/// Adiabatic lapse rate, degC/dbar (Bryden 1973). Check value: (40, 40, 10000) = 3.255976e-4.
double lapse_rate(double s, double t, double p) {
  const double ds = s - 35.0;
  return (((-2.1687e-16 * t + 1.8676e-14) * t - 4.6206e-13) * p +
          ((2.7759e-12 * t - 1.1351e-10) * ds +
           ((-5.4481e-14 * t + 8.733e-12) * t - 6.7795e-10) * t + 1.8741e-8)) *
             p +
         (-4.2393e-8 * t + 1.8932e-6) * ds + ((6.6228e-10 * t - 6.836e-8) * t + 8.5258e-6) * t +
         3.5803e-5;
}

/// Secant bulk modulus, bar (EOS-80); pressure in bar.
double bulk_modulus(double s, double t, double p) {
  const double root = s * std::sqrt(s);
  const double k0 = 19652.21 +
                    (148.4206 + (-2.327105 + (1.360477e-2 - 5.155288e-5 * t) * t) * t) * t +
                    (54.6746 + (-0.603459 + (1.09987e-2 - 6.1670e-5 * t) * t) * t) * s +
                    (7.944e-2 + (1.6483e-2 - 5.3009e-4 * t) * t) * root;
  const double a = 3.239908 + (1.43713e-3 + (1.16092e-4 - 5.77905e-7 * t) * t) * t +
                   (2.2838e-3 + (-1.0981e-5 - 1.6078e-6 * t) * t) * s + 1.91075e-4 * root;
  const double b = 8.50935e-5 + (-6.12293e-6 + 5.2787e-8 * t) * t +
                   (-9.9348e-7 + (2.0816e-8 + 9.1697e-10 * t) * t) * s;
  return k0 + (a + b * p) * p;
}

double surface_density(double s, double t) {
  const double water =
      999.842594 + (6.793952e-2 +
                    (-9.095290e-3 + (1.001685e-4 + (-1.120083e-6 + 6.536332e-9 * t) * t) * t) * t) *
                       t;
  const double linear =
      8.24493e-1 + (-4.0899e-3 + (7.6438e-5 + (-8.2467e-7 + 5.3875e-9 * t) * t) * t) * t;
  const double root = -5.72466e-3 + (1.0227e-4 - 1.6546e-6 * t) * t;
  return water + linear * s + root * s * std::sqrt(s) + 4.8314e-4 * s * s;
}

struct Water {
  double salinity, temperature, pressure;
};

double density_moved_to(const Water& water, double pressure) {
  const double moved =
      potential_temperature(water.salinity, water.temperature, water.pressure, pressure);
  return sea_water_density(water.salinity, moved, pressure);
}

/// N of the layer between two levels (1/s); 0 where it is unstable.
double buoyancy_frequency(const Water& upper, const Water& lower, double thickness_m) {
  const double middle = 0.5 * (upper.pressure + lower.pressure);
  const double above = density_moved_to(upper, middle), below = density_moved_to(lower, middle);
  const double square = kGravity * (below - above) / (0.5 * (above + below) * thickness_m);
  return square > 0.0 ? std::sqrt(square) : 0.0;
}

/// First-mode gravity-wave speed of the water column at a node (m/s); NaN with fewer than two
/// valid levels. The column ends at the first missing level; the sea bed is somewhere above that,
/// on average halfway, and the water down to there is taken as stratified as that just above.
double wave_speed(const RasterStack& temperature, const RasterStack& salinity, std::size_t node) {
  const std::vector<double>& depth = temperature.depth_m;
  double integral = 0.0, frequency = 0.0;
  Water upper{};
  std::size_t n_valid = 0;
  for (; n_valid < depth.size(); ++n_valid) {
    const std::size_t k = n_valid;
    const double t = temperature.levels[k].values[node], s = salinity.levels[k].values[node];
    if (!std::isfinite(t) || !std::isfinite(s) || s < 0.0) break;
    const Water water{s, t, kDbarPerMetre * depth[k]};
    if (k > 0) {
      frequency = buoyancy_frequency(upper, water, depth[k] - depth[k - 1]);
      integral += frequency * (depth[k] - depth[k - 1]);
    }
    upper = water;
  }
  if (n_valid < 2) return std::numeric_limits<double>::quiet_NaN();
  if (n_valid < depth.size()) {
    integral += 0.5 * frequency * (depth[n_valid] - depth[n_valid - 1]);
  }
  return integral / kPi;
}

void check_stacks(const RasterStack& a, const RasterStack& b) {
  bool same = a.depth_m == b.depth_m && a.levels.size() == a.depth_m.size() &&
              b.levels.size() == b.depth_m.size() && a.depth_m.size() >= 2;
  for (std::size_t k = 0; same && k < a.levels.size(); ++k) {
    same = a.levels[k].lat_deg == a.levels[0].lat_deg &&
           b.levels[k].lat_deg == a.levels[0].lat_deg &&
           a.levels[k].lon_deg == a.levels[0].lon_deg && b.levels[k].lon_deg == a.levels[0].lon_deg;
  }
  DELOS_CHECK(same, ErrorKind::input, a.levels.empty() ? "temperature" : a.levels[0].source,
              " and ", b.levels.empty() ? "salinity" : b.levels[0].source,
              " differ in their nodes or depths, or have fewer than 2 levels: take both from one "
              "climatology");
}

}  // namespace

double sea_water_density(double salinity_psu, double temperature_degc, double pressure_dbar) {
  const double bar = 0.1 * pressure_dbar;
  return surface_density(salinity_psu, temperature_degc) /
         (1.0 - bar / bulk_modulus(salinity_psu, temperature_degc, bar));
}

double potential_temperature(double salinity_psu, double temperature_degc, double pressure_dbar,
                             double reference_dbar) {
  // Runge-Kutta-Gill step over the whole way (Fofonoff 1977).
  const double s = salinity_psu, h = reference_dbar - pressure_dbar;
  double t = temperature_degc, p = pressure_dbar;
  double x = h * lapse_rate(s, t, p);
  t += 0.5 * x;
  double q = x;
  p += 0.5 * h;
  x = h * lapse_rate(s, t, p);
  t += 0.29289322 * (x - q);
  q = 0.58578644 * x + 0.121320344 * q;
  x = h * lapse_rate(s, t, p);
  t += 1.707106781 * (x - q);
  q = 3.414213562 * x - 4.121320344 * q;
  p += 0.5 * h;
  x = h * lapse_rate(s, t, p);
  return t + (x - 2.0 * q) / 6.0;
}

Raster rossby_radius(parallel::Executor& exec, const RasterStack& temperature_degc,
                     const RasterStack& salinity_psu) {
  check_stacks(temperature_degc, salinity_psu);
  Raster radius = temperature_degc.levels[0];
  radius.source = text("Rossby radius of ", temperature_degc.levels[0].source, " and ",
                       salinity_psu.levels[0].source);
  parallel::for_index(exec, static_cast<std::int64_t>(radius.n_lat()), 1, [&](std::int64_t row) {
    const auto j = static_cast<std::size_t>(row);
    const elementary::SinCos lat = elementary::sincos(radius.lat_deg[j] * kRadPerDeg);
    const double f = 2.0 * kEarthRotation * std::abs(lat.sin);
    const double beta = 2.0 * kEarthRotation * lat.cos / kEarthRadius;
    for (std::size_t i = 0; i < radius.n_lon(); ++i) {
      const std::size_t node = j * radius.n_lon() + i;
      const double c = wave_speed(temperature_degc, salinity_psu, node);
      // Both forms by division of c by the larger of |f| and sqrt(2 beta c).
      const double rotation = std::max(f, std::sqrt(2.0 * beta * c));
      radius.values[node] = c > 0.0 ? c / rotation : c;
    }
  });
  return radius;
}

void fill_rossby(parallel::Executor& exec, const RossbySource& source, LatLonField& field) {
  DELOS_CHECK(source.factor > 0.0 && source.min_radius_m > 0.0, ErrorKind::config,
              "Rossby criterion has factor ", source.factor, " and least radius ",
              source.min_radius_m, " m: both must be > 0");
  DELOS_CHECK(source.radius_m || (source.temperature_degc && source.salinity_psu),
              ErrorKind::config,
              "Rossby criterion has no radius and no climatology: give radius_file, or "
              "temperature and salinity");
  if (source.radius_m) {
    sample(exec, *source.radius_m, field);
  } else {
    sample(exec, rossby_radius(exec, *source.temperature_degc, *source.salinity_psu), field);
  }
  fill_nearest(exec, source.radius_m ? source.radius_m->source : "computed Rossby radius", field);
  for_rows(exec, field, [&](Index, double* values) {
    for (Index i = 0; i < field.n_lon; ++i) {
      values[i] = source.factor * std::max(values[i], source.min_radius_m);
    }
  });
}

}  // namespace delos
