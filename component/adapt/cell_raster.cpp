// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/cell_raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "sizing/nodes.hpp"

namespace delos {
namespace {

constexpr double kFinest_rad = kRadPerDeg / 12.0, kCoarsest_rad = kRadPerDeg;
/// Rows a task: each is some hundred short walks at least.
constexpr std::int64_t kBoxRowGrain = 4;
constexpr double kTurn_deg = 360.0;
/// Of a column that repeats the first one, from rounding.
constexpr double kSame_deg = 1e-6;
/// The gap over the seam of columns that go round, in steps.
constexpr double kMaxSeamSteps = 1.5;

/// Area and area times value of the cells in each node's box; the boxes of a pole are one.
struct Boxes {
  Array<double> area, sum;
};

Boxes fill_boxes(const Grid& grid, std::span<const double> values, const LatLonField& table) {
  Boxes boxes;
  boxes.area.assign(table.values.size(), 0.0);
  boxes.sum.assign(table.values.size(), 0.0);
  const double rows_per_rad = table.n_lat_cells / kPi, columns_per_rad = 0.5 * table.n_lon / kPi;
  // In the order of the cells, so that sums do not depend on threads; a pass over memory.
  for (std::size_t cell = 0; cell < values.size(); ++cell) {
    if (std::isnan(values[cell])) continue;
    const LonLat place = grid.cell_lon_lat[cell];
    const double row = std::floor((place.lat_rad + 0.5 * kPi) * rows_per_rad + 0.5);
    const Index j = std::clamp(static_cast<Index>(row), 0, table.n_lat_cells);
    const bool is_pole = j == 0 || j == table.n_lat_cells;
    const auto column =
        static_cast<Index>(std::floor((place.lon_rad + kPi) * columns_per_rad + 0.5));
    const std::size_t node = table.at(j, is_pole ? 0 : column % table.n_lon);
    boxes.area[node] += grid.cell_area_m2[cell];
    boxes.sum[node] += grid.cell_area_m2[cell] * values[cell];
  }
  return boxes;
}

/// Positions of the axis in ascending order.
std::vector<std::size_t> ascending(std::span<const double> axis) {
  std::vector<std::size_t> order(axis.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  if (axis.size() > 1 && axis.back() < axis.front()) std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

Index nearest_cell(const Grid& grid, const Vec3& p, Index start) {
  Index cell = start;
  double least = (grid.cell_position[at(cell)] - p).squaredNorm();
  for (bool is_nearer = true; is_nearer;) {
    is_nearer = false;
    for (const Index next : grid.cells_on_cell.row(cell)) {
      const double distance = (grid.cell_position[at(next)] - p).squaredNorm();
      if (distance < least) {
        least = distance;
        cell = next;
        is_nearer = true;
      }
    }
  }
  return cell;
}

double cell_resolution_rad(const Grid& grid) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const double spacing_m : grid.cell_spacing_m) least_m = std::min(least_m, spacing_m);
  return std::clamp(least_m / grid.surface.scale_m(), kFinest_rad, kCoarsest_rad);
}

Raster raster_of_cells(parallel::Executor& exec, const Grid& grid, std::span<const double> values,
                       double resolution_rad, const std::string& name) {
  DELOS_CHECK(values.size() == at(grid.n_cells()), ErrorKind::input, name, " has ", values.size(),
              " values, the grid has ", grid.n_cells(), " cells");
  LatLonField table = unset_table(resolution_rad);
  const Boxes boxes = fill_boxes(grid, values, table);
  const NodeDirections nodes(table);
  parallel::for_index(exec, table.n_rows(), kBoxRowGrain, [&](std::int64_t row) {
    const auto j = static_cast<Index>(row);
    const bool is_pole = j == 0 || j == table.n_lat_cells;
    Index cell = 0;
    for (Index i = 0; i < table.n_lon; ++i) {
      const std::size_t box = table.at(j, is_pole ? 0 : i);
      double& value = table.values[table.at(j, i)];
      if (boxes.area[box] > 0.0) {
        value = boxes.sum[box] / boxes.area[box];
        continue;
      }
      if (!is_pole || i == 0) {
        cell = nearest_cell(
            grid, grid.surface.point(nodes.lon[at(i)], nodes.lat[at(j)], grid.latitude), cell);
      }
      value = values[at(cell)];
    }
  });
  return raster_of_nodes(std::move(table), name);
}

Raster raster_of_nodes(LatLonField table, const std::string& name) {
  Raster out;
  out.source = name;
  for (Index j = 0; j < table.n_rows(); ++j) {
    out.lat_deg.push_back(-90.0 + 180.0 * j / table.n_lat_cells);
  }
  for (Index i = 0; i < table.n_lon; ++i) out.lon_deg.push_back(-180.0 + 360.0 * i / table.n_lon);
  out.values = std::move(table.values);
  out.periodic = true;
  return out;
}

Raster raster_of_table(std::span<const double> lon_deg, std::span<const double> lat_deg,
                       std::span<const double> values, const std::string& name) {
  DELOS_CHECK(
      lon_deg.size() > 1 && lat_deg.size() > 1 && values.size() == lon_deg.size() * lat_deg.size(),
      ErrorKind::input, name, " has ", values.size(), " values on ", lat_deg.size(),
      " latitudes and ", lon_deg.size(), " longitudes");
  std::vector<std::size_t> columns = ascending(lon_deg);
  const std::vector<std::size_t> rows = ascending(lat_deg);
  const double first = lon_deg[columns.front()];
  if (lon_deg[columns.back()] - first > kTurn_deg - kSame_deg) columns.pop_back();
  // Begins in [-180, 180).
  const double turns = std::floor((first + 0.5 * kTurn_deg) / kTurn_deg) * kTurn_deg;
  Raster out;
  out.source = name;
  for (const std::size_t column : columns) out.lon_deg.push_back(lon_deg[column] - turns);
  for (const std::size_t row : rows) {
    out.lat_deg.push_back(lat_deg[row]);
    for (const std::size_t column : columns) {
      out.values.push_back(values[row * lon_deg.size() + column]);
    }
  }
  const double width = out.lon_deg.back() - out.lon_deg.front();
  const double step = width / static_cast<double>(columns.size() - 1);
  out.periodic = kTurn_deg - width <= kMaxSeamSteps * step;
  return out;
}

}  // namespace delos
