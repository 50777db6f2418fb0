// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/bathymetry.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "sizing/nodes.hpp"
#include "sizing/raster.hpp"

namespace delos {
namespace {

/// Columns to each side of a difference along a row, so that its reach is about that along a
/// column: near a pole single columns differ by noise over metres.
Index column_reach(double dx, double dy, Index n_lon) {
  const double reach = std::floor(dy / std::max(dx, 1.0e-6 * dy) + 0.5);
  return std::clamp(static_cast<Index>(std::min(reach, 1.0e9)), Index{1},
                    std::max<Index>(n_lon / 8, 1));
}

/// |grad H| at a node from centred differences in the steps' metric.
double slope_at(const LatLonField& depth, const TableMetric& metric, Index row, Index column) {
  const Index j = std::clamp(row, Index{1}, depth.n_lat_cells - 1);
  const std::size_t at = metric.at(depth, j, column);
  const double dx = metric.dx[at], dy = metric.dy[at], cosine = metric.cosine[at];
  const Index n = depth.n_lon, reach = column_reach(dx, dy, n);
  const double along = (depth.values[depth.at(j, (column + reach) % n)] -
                        depth.values[depth.at(j, (column + n - reach) % n)]) /
                       (2.0 * reach * dx);
  const double up =
      (depth.values[depth.at(j + 1, column)] - depth.values[depth.at(j - 1, column)]) / (2.0 * dy);
  const double square = along * along + up * up - 2.0 * cosine * along * up;
  return std::sqrt(std::max(square, 0.0) / (1.0 - cosine * cosine));
}

void check_common(const char* what, double cells, double min_depth_m) {
  DELOS_CHECK(std::isfinite(cells) && cells > 0.0, ErrorKind::config, what, " criterion asks for ",
              cells, " cells: it must be > 0");
  DELOS_CHECK(std::isfinite(min_depth_m) && min_depth_m > 0.0, ErrorKind::config, what,
              " criterion has a least depth of ", min_depth_m, " m: it must be > 0");
}

void to_depth(parallel::Executor& exec, double min_depth_m, LatLonField& elevation) {
  for_rows(exec, elevation, [&](Index, double* values) {
    for (Index i = 0; i < elevation.n_lon; ++i) values[i] = std::max(-values[i], min_depth_m);
  });
}

}  // namespace

void fill_slope(parallel::Executor& exec, const Ellipsoid& surface, LatitudeKind latitude,
                const SlopeSource& source, LatLonField& field) {
  check_common("slope", source.cells, source.min_depth_m);
  DELOS_CHECK(source.max_m > 0.0, ErrorKind::config, "slope criterion has a largest spacing of ",
              source.max_m, " m: it must be > 0");
  to_depth(exec, source.min_depth_m, field);
  smooth(exec, source.smooth_rad, field);
  const LatLonField depth = std::move(field);
  resize_like(depth, field);
  const TableMetric metric(exec, surface, latitude, field);
  for_rows(exec, field, [&](Index row, double* values) {
    for (Index i = 0; i < field.n_lon; ++i) {
      const double slope = slope_at(depth, metric, row, i);
      const double wanted = 2.0 * kPi * depth.values[depth.at(row, i)];
      const double most = source.max_m * source.cells * slope;
      values[i] = wanted < most ? wanted / (source.cells * slope) : source.max_m;
    }
  });
  unify_poles_to_min(field);
}

void fill_tidal(parallel::Executor& exec, const TidalSource& source, LatLonField& field) {
  check_common("tidal", source.cells, source.min_depth_m);
  DELOS_CHECK(std::isfinite(source.period_s) && source.period_s > 0.0, ErrorKind::config,
              "tidal period is ", source.period_s, " s: it must be > 0");
  to_depth(exec, source.min_depth_m, field);
  for_rows(exec, field, [&](Index, double* values) {
    for (Index i = 0; i < field.n_lon; ++i) {
      values[i] = source.period_s * std::sqrt(kGravity * values[i]) / source.cells;
    }
  });
}

}  // namespace delos
