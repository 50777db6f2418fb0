// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delos {

void unify_pole(double* row, Index n_lon) {
  double sum = 0.0;
  Index n = 0;
  for (Index i = 0; i < n_lon; ++i) {
    if (std::isnan(row[i])) continue;
    sum += row[i];
    ++n;
  }
  std::fill_n(row, n_lon, n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN());
}

void unify_poles(LatLonField& field) {
  unify_pole(field.values.data(), field.n_lon);
  unify_pole(field.values.data() + field.at(field.n_lat_cells, 0), field.n_lon);
}

void unify_poles_to_min(LatLonField& field) {
  for (const Index row : {0, field.n_lat_cells}) {
    double* values = field.values.data() + field.at(row, 0);
    std::fill_n(values, field.n_lon, *std::min_element(values, values + field.n_lon));
  }
}

NodeDirections::NodeDirections(const LatLonField& field) {
  for (Index row = 0; row < field.n_rows(); ++row) {
    lat.push_back(elementary::sincos(field.lat_rad(row)));
  }
  for (Index column = 0; column < field.n_lon; ++column) {
    lon.push_back(elementary::sincos(field.lon_rad(column)));
  }
}

TableMetric::TableMetric(parallel::Executor& exec, const Ellipsoid& surface, LatitudeKind latitude,
                         const LatLonField& field)
    : is_triaxial(surface.radii()[0] != surface.radii()[1]) {
  is_triaxial ? measure_nodes(exec, surface, latitude, field)
              : measure_rows(surface, latitude, field);
}

void TableMetric::measure_rows(const Ellipsoid& surface, LatitudeKind latitude,
                               const LatLonField& field) {
  std::vector<Vec3> meridian;
  meridian.reserve(static_cast<std::size_t>(field.n_rows()));
  for (Index j = 0; j < field.n_rows(); ++j) {
    meridian.push_back(surface.scale_m() * surface.point({0.0, field.lat_rad(j)}, latitude));
  }
  for (Index j = 0; j < field.n_rows(); ++j) {
    const Index south = std::max(j - 1, 0), north = std::min(j + 1, field.n_lat_cells);
    const Vec3 step =
        meridian[static_cast<std::size_t>(north)] - meridian[static_cast<std::size_t>(south)];
    dx.push_back(std::abs(meridian[static_cast<std::size_t>(j)][0]) * 2.0 * kPi / field.n_lon);
    dy.push_back(step.norm() / (north - south));
  }
  cosine.assign(dx.size(), 0.0);
}

void TableMetric::measure_nodes(parallel::Executor& exec, const Ellipsoid& surface,
                                LatitudeKind latitude, const LatLonField& field) {
  const std::size_t n = field.values.size();
  dx.resize(n);
  dy.resize(n);
  cosine.assign(n, 0.0);
  const double scale = surface.scale_m(), half_step = kPi / field.n_lon;
  parallel::for_index(exec, field.n_rows(), kRowGrain, [&](std::int64_t row) {
    const auto j = static_cast<Index>(row);
    const Index south = std::max(j - 1, 0), north = std::min(j + 1, field.n_lat_cells);
    const bool is_pole = south == j || north == j;
    for (Index i = 0; i < field.n_lon; ++i) {
      const double lon = field.lon_rad(i), lat = field.lat_rad(j);
      const Vec3 along = scale * (surface.point({lon + half_step, lat}, latitude) -
                                  surface.point({lon - half_step, lat}, latitude));
      const Vec3 up = scale * (surface.point({lon, field.lat_rad(north)}, latitude) -
                               surface.point({lon, field.lat_rad(south)}, latitude));
      const std::size_t node = field.at(j, i);
      dx[node] = along.norm();
      dy[node] = up.norm() / (north - south);
      if (!is_pole) cosine[node] = along.dot(up) / (along.norm() * up.norm());
    }
  });
}

}  // namespace delos
