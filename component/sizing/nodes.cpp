// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace delos {

void resize_like(const LatLonField& like, LatLonField& field) {
  field.n_lat_cells = like.n_lat_cells;
  field.n_lon = like.n_lon;
  field.values.resize(like.values.size());
}

void scale_into(parallel::Executor& exec, double scale, const LatLonField& from, LatLonField& to) {
  for_rows(exec, to, [&](Index row, double* values) {
    const double* source = from.values.data() + from.at(row, 0);
    for (Index i = 0; i < to.n_lon; ++i) values[i] = scale * source[i];
  });
}

std::size_t first_not_positive(parallel::Executor& exec, const LatLonField& field) {
  const std::size_t none = field.values.size();
  const auto find_in_rows = [&](std::int64_t begin, std::int64_t end) {
    const double* const values = field.values.data();
    const double* const last = values + field.at(static_cast<Index>(end), 0);
    const double* const found =
        std::find_if_not(values + field.at(static_cast<Index>(begin), 0), last,
                         [](double h) { return std::isfinite(h) && h > 0.0; });
    return found == last ? none : static_cast<std::size_t>(found - values);
  };
  return parallel::reduce(exec, field.n_rows(), kRowGrain, none, find_in_rows,
                          [](std::size_t a, std::size_t b) { return std::min(a, b); });
}

std::string place_of(const LatLonField& field, std::size_t node) {
  const auto n_lon = static_cast<std::size_t>(field.n_lon);
  return text("lon ", field.lon_rad(static_cast<Index>(node % n_lon)) * kDegPerRad, ", lat ",
              field.lat_rad(static_cast<Index>(node / n_lon)) * kDegPerRad, " deg");
}

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
  cosine.resize(n);
  const double scale = surface.scale_m(), half_step = kPi / field.n_lon;
  const NodeDirections nodes(field);
  std::vector<elementary::SinCos> west, east;  // half a step beside the nodes
  for (Index i = 0; i < field.n_lon; ++i) {
    west.push_back(elementary::sincos(field.lon_rad(i) - half_step));
    east.push_back(elementary::sincos(field.lon_rad(i) + half_step));
  }
  parallel::for_index(exec, field.n_rows(), kRowGrain, [&](std::int64_t row) {
    const auto j = static_cast<Index>(row);
    const Index south = std::max(j - 1, 0), north = std::min(j + 1, field.n_lat_cells);
    const bool is_pole = south == j || north == j;
    const auto lat = [&](Index k) { return nodes.lat[static_cast<std::size_t>(k)]; };
    for (Index i = 0; i < field.n_lon; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Vec3 along = scale * (surface.point(east[k], lat(j), latitude) -
                                  surface.point(west[k], lat(j), latitude));
      const Vec3 up = scale * (surface.point(nodes.lon[k], lat(north), latitude) -
                               surface.point(nodes.lon[k], lat(south), latitude));
      const std::size_t node = field.at(j, i);
      dx[node] = along.norm();
      dy[node] = up.norm() / (north - south);
      cosine[node] = is_pole ? 0.0 : along.dot(up) / (along.norm() * up.norm());
    }
  });
}

}  // namespace delos
