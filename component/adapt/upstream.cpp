// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/upstream.hpp"

#include <algorithm>
#include <cmath>

#include "adapt/cell_raster.hpp"
#include "core/error.hpp"
#include "sizing/nodes.hpp"

namespace delos {
namespace {

/// Of a row: no node on the way is stepped over.
constexpr double kStep = 0.5;
/// Below it (m/s) a mean flow has no direction to speak of.
constexpr double kStill = 1.0e-3;

Index nearest(double place) { return static_cast<Index>(std::floor(place + 0.5)); }

/// The tables that paths are followed on.
class Paths {
 public:
  Paths(parallel::Executor& exec, const Raster& signal, const MeanFlow& flow, double radius_m)
      : signal_(unset_table(resolution_rad(signal))) {
    sample(exec, signal, signal_);
    resize_like(signal_, east_);
    resize_like(signal_, north_);
    sample(exec, flow.east, east_);
    sample(exec, flow.north, north_);
    directions_ = NodeDirections(signal_).lat;
    row_m_ = radius_m * kPi / signal_.n_lat_cells;
  }

  const LatLonField& nodes() const { return signal_; }

  double greatest_downstream(Index row, Index column, const UpstreamOptions& options) const {
    double greatest = signal_.values[signal_.at(row, column)];
    if (std::isnan(greatest)) return greatest;
    double x = column, y = row, way = 0.0;
    std::size_t node = signal_.at(row, column);
    // Half the way round is farther than any reach makes sense.
    for (int left = 2 * signal_.n_lat_cells; left > 0; --left) {
      const double u = east_.values[node], v = north_.values[node];
      const double speed = std::sqrt(u * u + v * v);
      if (!(speed >= kStill)) break;
      const auto j = nearest(y);
      if (j < 1 || j >= signal_.n_lat_cells) break;
      const double step_m = kStep * row_m_;
      way += options.length_m > 0.0 ? step_m / options.length_m : step_m / speed / options.time_s;
      if (way >= 1.0) break;
      // Columns are narrower by the cosine of the latitude, as many of them go round as two
      // times the rows.
      const double columns_per_row = signal_.n_lon / (2.0 * signal_.n_lat_cells);
      x += kStep * columns_per_row * u / (speed * directions_[static_cast<std::size_t>(j)].cos);
      y += kStep * v / speed;
      x -= signal_.n_lon * std::floor(x / signal_.n_lon);
      y = std::clamp(y, 0.0, static_cast<double>(signal_.n_lat_cells));
      node = signal_.at(nearest(y), nearest(x) % signal_.n_lon);
      const double there = signal_.values[node] * (1.0 - way);
      if (there > greatest) greatest = there;
    }
    return greatest;
  }

 private:
  LatLonField signal_, east_, north_;
  std::vector<elementary::SinCos> directions_;  ///< of the rows
  double row_m_ = 0.0;
};

}  // namespace

Raster spread_upstream(parallel::Executor& exec, const Raster& signal, const MeanFlow& flow,
                       const UpstreamOptions& options, double radius_m) {
  DELOS_CHECK((options.length_m > 0.0) != (options.time_s > 0.0), ErrorKind::config, signal.source,
              " is spread upstream by ", options.length_m, " m and ", options.time_s,
              " s: one of them must be > 0");
  const Paths paths(exec, signal, flow, radius_m);
  LatLonField out;
  resize_like(paths.nodes(), out);
  for_rows(exec, out, [&](Index row, double* values) {
    for (Index i = 0; i < out.n_lon; ++i) values[i] = paths.greatest_downstream(row, i, options);
  });
  return raster_of_nodes(std::move(out), signal.source);
}

}  // namespace delos
