// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "sizing/nearest.hpp"
#include "sizing/nodes.hpp"

namespace delos {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
/// A raster finer than this share of the table's step is averaged, not interpolated.
constexpr double kAverageBelow = 0.75;
/// Rows that a raster may stop short of a pole and still be continued to it.
constexpr double kRowsToPole = 2.0;

struct Weight {
  Index index;
  double weight;
};

/// What each target takes from the nodes of one axis of the raster.
struct AxisWeights {
  std::vector<std::size_t> offsets{0};
  std::vector<Weight> weights;

  void close_target() { offsets.push_back(weights.size()); }
  std::size_t n_targets() const { return offsets.size() - 1; }
};

/// One axis of the raster: nodes, and the borders of the cells around them.
struct Axis {
  std::vector<double> nodes;
  std::vector<double> borders;  ///< n + 1
  std::vector<Index> index;     ///< of each node in the raster (copies of a period repeat)
};

std::vector<double> cell_borders(const std::vector<double>& nodes) {
  const std::size_t n = nodes.size();
  std::vector<double> borders(n + 1);
  for (std::size_t k = 1; k < n; ++k) borders[k] = 0.5 * (nodes[k - 1] + nodes[k]);
  borders[0] = nodes[0] - 0.5 * (nodes[1] - nodes[0]);
  borders[n] = nodes[n - 1] + 0.5 * (nodes[n - 1] - nodes[n - 2]);
  return borders;
}

Axis longitude_axis(const Raster& raster) {
  Axis axis;
  const auto n = static_cast<Index>(raster.n_lon());
  // A periodic axis is laid out three times, so that no target needs a seam.
  const int reach = raster.periodic ? 1 : 0;
  for (int turn = -reach; turn <= reach; ++turn) {
    for (Index k = 0; k < n; ++k) {
      axis.nodes.push_back(raster.lon_deg[static_cast<std::size_t>(k)] + 360.0 * turn);
      axis.index.push_back(k);
    }
  }
  axis.borders = cell_borders(axis.nodes);
  return axis;
}

Axis latitude_axis(const Raster& raster) {
  Axis axis;
  axis.nodes = raster.lat_deg;
  for (std::size_t k = 0; k < raster.n_lat(); ++k) axis.index.push_back(static_cast<Index>(k));
  axis.borders = cell_borders(axis.nodes);
  const std::size_t n = axis.nodes.size();
  const double first = axis.nodes[1] - axis.nodes[0], last = axis.nodes[n - 1] - axis.nodes[n - 2];
  if (axis.nodes[0] + 90.0 < kRowsToPole * first) axis.borders[0] = -90.0;
  if (90.0 - axis.nodes[n - 1] < kRowsToPole * last) axis.borders[n] = 90.0;
  return axis;
}

void add_mean(const Axis& axis, double from, double to, AxisWeights& out) {
  auto k = static_cast<std::size_t>(
      std::upper_bound(axis.borders.begin(), axis.borders.end(), from) - axis.borders.begin());
  for (k = k > 0 ? k - 1 : 0; k < axis.nodes.size() && axis.borders[k] < to; ++k) {
    const double overlap = std::min(to, axis.borders[k + 1]) - std::max(from, axis.borders[k]);
    if (overlap > 0.0) out.weights.push_back({axis.index[k], overlap});
  }
}

void add_linear(const Axis& axis, double at, AxisWeights& out) {
  if (at < axis.borders.front() || at > axis.borders.back()) return;
  const std::size_t last = axis.nodes.size() - 1;
  if (at <= axis.nodes.front()) return out.weights.push_back({axis.index.front(), 1.0});
  if (at >= axis.nodes.back()) return out.weights.push_back({axis.index.back(), 1.0});
  auto k = static_cast<std::size_t>(std::upper_bound(axis.nodes.begin(), axis.nodes.end(), at) -
                                    axis.nodes.begin());
  k = std::min(k, last) - 1;
  const double t = (at - axis.nodes[k]) / (axis.nodes[k + 1] - axis.nodes[k]);
  if (t < 1.0) out.weights.push_back({axis.index[k], 1.0 - t});
  if (t > 0.0) out.weights.push_back({axis.index[k + 1], t});
}

AxisWeights axis_weights(const Axis& axis, const std::vector<double>& targets, double step) {
  const double source_step =
      (axis.nodes.back() - axis.nodes.front()) / static_cast<double>(axis.nodes.size() - 1);
  AxisWeights out;
  for (const double target : targets) {
    if (source_step < kAverageBelow * step) {
      const double from = std::max(target - 0.5 * step, axis.borders.front());
      const double to = std::min(target + 0.5 * step, axis.borders.back());
      if (target >= axis.borders.front() && target <= axis.borders.back()) {
        add_mean(axis, from, to, out);
      }
    } else {
      add_linear(axis, target, out);
    }
    out.close_target();
  }
  return out;
}

void check_raster(const Raster& raster) {
  DELOS_CHECK(raster.n_lat() >= 2 && raster.n_lon() >= 2 &&
                  raster.values.size() == raster.n_lat() * raster.n_lon(),
              ErrorKind::input, raster.source, " has ", raster.n_lat(), " x ", raster.n_lon(),
              " nodes and ", raster.values.size(),
              " values: at least 2 x 2 nodes with one value each are needed");
  const bool has_any = std::any_of(raster.values.begin(), raster.values.end(),
                                   [](double value) { return std::isfinite(value); });
  DELOS_CHECK(has_any, ErrorKind::input, raster.source,
              " holds no valid value: check its fill value and the variable's name");
}

std::vector<double> target_latitudes(const LatLonField& field) {
  std::vector<double> lat;
  lat.reserve(static_cast<std::size_t>(field.n_rows()));
  for (Index row = 0; row < field.n_rows(); ++row) {
    lat.push_back(180.0 * row / field.n_lat_cells - 90.0);
  }
  return lat;
}

/// Longitudes of the table, each turned into the range of the raster.
std::vector<double> target_longitudes(const LatLonField& field, const Raster& raster) {
  const double middle = 0.5 * (raster.lon_deg.front() + raster.lon_deg.back());
  std::vector<double> lon;
  for (Index column = 0; column < field.n_lon; ++column) {
    double at = 360.0 * column / field.n_lon - 180.0;
    at += 360.0 * std::floor((middle + 180.0 - at) / 360.0);
    lon.push_back(at);
  }
  return lon;
}

double weighted_mean(const Raster& raster, const AxisWeights& rows, std::size_t row,
                     const AxisWeights& columns, std::size_t column) {
  double sum = 0.0, valid = 0.0, total = 0.0;
  for (std::size_t r = rows.offsets[row]; r < rows.offsets[row + 1]; ++r) {
    const double* line =
        raster.values.data() + static_cast<std::size_t>(rows.weights[r].index) * raster.n_lon();
    for (std::size_t c = columns.offsets[column]; c < columns.offsets[column + 1]; ++c) {
      const double weight = rows.weights[r].weight * columns.weights[c].weight;
      const double value = line[columns.weights[c].index];
      const bool is_valid = std::isfinite(value);
      total += weight;
      valid += is_valid ? weight : 0.0;
      sum += is_valid ? weight * value : 0.0;
    }
  }
  return valid > 0.5 * total && total > 0.0 ? sum / valid : kNan;
}

struct BorderNode {
  Vec3 direction;
  double value;
};

/// The valid nodes of a row beside a missing one: only they can be the nearest of a missing one.
void add_border(const LatLonField& field, const NodeDirections& nodes, Index row,
                std::vector<BorderNode>& found) {
  const auto is_missing = [&](Index j, Index i) {
    return std::isnan(field.values[field.at(j, i)]);
  };
  const Index south = std::max(row - 1, 0), north = std::min(row + 1, field.n_lat_cells);
  for (Index i = 0; i < field.n_lon; ++i) {
    if (is_missing(row, i)) continue;
    const Index west = i == 0 ? field.n_lon - 1 : i - 1, east = i + 1 == field.n_lon ? 0 : i + 1;
    if (is_missing(row, west) || is_missing(row, east) || is_missing(south, i) ||
        is_missing(north, i)) {
      found.push_back({nodes.direction(row, i), field.values[field.at(row, i)]});
    }
  }
}

}  // namespace

LatLonField make_table(double resolution_rad) {
  LatLonField field = unset_table(resolution_rad);
  std::fill(field.values.begin(), field.values.end(), 0.0);
  return field;
}

LatLonField unset_table(double resolution_rad) {
  DELOS_CHECK(std::isfinite(resolution_rad) && resolution_rad > 0.0, ErrorKind::config,
              "resolution of the spacing table is ", resolution_rad, " rad: it must be > 0");
  // The slack keeps 1/12 degree, inexact in binary, at 2160 rows.
  const double rows = std::ceil(kPi / resolution_rad * (1.0 - 1e-12));
  DELOS_CHECK(2.0 * rows * (rows + 1.0) < 2147483648.0, ErrorKind::resource,
              "a spacing table of resolution ", resolution_rad * kDegPerRad, " deg needs ",
              2.0 * rows * (rows + 1.0), " nodes, more than 2^31: ask for a coarser resolution");
  LatLonField field;
  field.n_lat_cells = std::max<Index>(static_cast<Index>(rows), 2);
  field.n_lon = 2 * field.n_lat_cells;
  field.values.resize(static_cast<std::size_t>(field.n_rows()) *
                      static_cast<std::size_t>(field.n_lon));
  return field;
}

double resolution_rad(const Raster& raster) {
  DELOS_CHECK(raster.n_lat() >= 2 && raster.n_lon() >= 2, ErrorKind::input, raster.source,
              " has fewer than 2 x 2 nodes");
  const double lat = (raster.lat_deg.back() - raster.lat_deg.front()) /
                     (static_cast<double>(raster.n_lat()) - 1.0);
  const double lon = (raster.lon_deg.back() - raster.lon_deg.front()) /
                     (static_cast<double>(raster.n_lon()) - 1.0);
  return std::min(lat, lon) * kRadPerDeg;
}

void sample(parallel::Executor& exec, const Raster& raster, LatLonField& field) {
  check_raster(raster);
  const AxisWeights rows =
      axis_weights(latitude_axis(raster), target_latitudes(field), 180.0 / field.n_lat_cells);
  const AxisWeights columns =
      axis_weights(longitude_axis(raster), target_longitudes(field, raster), 360.0 / field.n_lon);
  for_rows(exec, field, [&](Index row, double* values) {
    for (Index i = 0; i < field.n_lon; ++i) {
      values[i] = weighted_mean(raster, rows, static_cast<std::size_t>(row), columns,
                                static_cast<std::size_t>(i));
    }
  });
  unify_poles(field);
}

void fill_value(parallel::Executor& exec, double value, LatLonField& field) {
  for_rows(exec, field, [&](Index, double* values) {
    for (Index i = 0; i < field.n_lon; ++i) values[i] = std::isnan(values[i]) ? value : values[i];
  });
}

void fill_nearest(parallel::Executor& exec, const std::string& source, LatLonField& field) {
  const std::vector<BorderNode> border = parallel::collect<BorderNode>(
      exec, field.n_rows(), kRowGrain,
      [&, nodes = NodeDirections(field)](std::int64_t begin, std::int64_t end, auto& found) {
        for (std::int64_t row = begin; row < end; ++row) {
          add_border(field, nodes, static_cast<Index>(row), found);
        }
      });
  // Without a border between valid and missing nodes all are of one kind.
  DELOS_CHECK(!border.empty() || !std::isnan(field.values[0]), ErrorKind::input, source,
              ": no valid value on the whole table: check the fill value and the region covered");
  std::vector<Vec3> points;
  points.reserve(border.size());
  for (const BorderNode& node : border) points.push_back(node.direction);
  const auto is_missing = [](double value) { return std::isnan(value); };
  NodeSearch search;
  search.is_wanted = [&](const TableTile& tile) {
    for (Index row = tile.row_begin; row < tile.row_end; ++row) {
      const double* values = field.values.data() + field.at(row, 0);
      if (std::any_of(values + tile.column_begin, values + tile.column_end, is_missing))
        return true;
    }
    return false;
  };
  search.take = [&](Index row, Index column, std::span<const NearestPoint::Hit> hits) {
    double* value = field.values.data() + field.at(row, column);
    for (const NearestPoint::Hit& hit : hits) {
      if (std::isnan(*value)) *value = border[static_cast<std::size_t>(hit.point)].value;
      ++value;
    }
  };
  if (!border.empty()) find_nearest(exec, NearestPoint(exec, points), field, search);
  unify_poles(field);
}

}  // namespace delos
