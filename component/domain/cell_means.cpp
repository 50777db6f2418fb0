// SPDX-License-Identifier: BSD-3-Clause
#include "domain/cell_means.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace delos::domain {
namespace {

constexpr std::int64_t kCellGrain = 256;  // about a millisecond
// Parts along a side of a cell's triangle: with two, every triangle has four samples, and what is
// linear over the cell has its exact mean.
constexpr int kLeastParts = 2;

// Sums over the samples of a triangle or a cell, each weighted.
struct Sums {
  double all = 0.0, valid = 0.0, wet = 0.0;  // weight
  double elevation = 0.0, depth = 0.0;       // weight x metres

  void add(const Sums& more, double factor) {
    all += factor * more.all;
    valid += factor * more.valid;
    wet += factor * more.wet;
    elevation += factor * more.elevation;
    depth += factor * more.depth;
  }
};

// The elevation between the nodes of a table.
class Lookup {
 public:
  Lookup(const LatLonField& field, double sea_level_m)
      : field_(field),
        sea_level_m_(sea_level_m),
        rows_per_rad_(field.n_lat_cells / kPi),
        columns_per_rad_(field.n_lon / (2.0 * kPi)) {}

  /// Angle between rows.
  double step_rad() const { return kPi / field_.n_lat_cells; }

  /// Bilinear; where a node is missing that of the nearest node. NaN when that is missing too.
  double elevation_m(const LonLat& place) const {
    const double y = std::clamp((place.lat_rad + 0.5 * kPi) * rows_per_rad_, 0.0,
                                static_cast<double>(field_.n_lat_cells));
    const double x = std::max((place.lon_rad + kPi) * columns_per_rad_, 0.0);
    const Index row = std::min(static_cast<Index>(y), field_.n_lat_cells - 1);
    const Index column = std::min(static_cast<Index>(x), field_.n_lon - 1);
    const Index east = column + 1 == field_.n_lon ? 0 : column + 1;
    const double s = y - row, t = x - column;
    const double* south = field_.values.data() + field_.at(row, 0);
    const double* north = south + field_.n_lon;
    const double low = south[column] + t * (south[east] - south[column]);
    const double high = north[column] + t * (north[east] - north[column]);
    const double between = low + s * (high - low);
    if (!std::isnan(between)) return between;
    return (s < 0.5 ? south : north)[t < 0.5 ? column : east];
  }

  void add(const LonLat& place, double weight, Sums& sums) const {
    const double elevation = elevation_m(place);
    sums.all += weight;
    if (std::isnan(elevation)) return;
    sums.valid += weight;
    sums.elevation += weight * elevation;
    if (elevation >= sea_level_m_) return;
    sums.wet += weight;
    sums.depth += weight * (sea_level_m_ - elevation);
  }

 private:
  const LatLonField& field_;
  double sea_level_m_, rows_per_rad_, columns_per_rad_;
};

// Cuts triangles into parts and sums over their middles; keeps its memory from one to the next.
class Sampler {
 public:
  Sampler(const Grid& grid, const Lookup& lookup) : grid_(grid), lookup_(lookup) {}

  Sums cell(std::int64_t cell) {
    Sums sums;
    const auto vertices = grid_.vertices_on_cell.row(cell);
    const Vec3& centre = grid_.cell_position[at(cell)];
    Index before = vertices.back();
    for (const Index vertex : vertices) {
      const Vec3 &a = grid_.vertex_position[at(before)], &b = grid_.vertex_position[at(vertex)];
      const Sums part = triangle(centre, a, b);
      sums.add(part, std::abs(grid_.surface.triangle_area(centre, a, b)) / part.all);
      before = vertex;
    }
    return sums;
  }

 private:
  Sums triangle(const Vec3& centre, const Vec3& a, const Vec3& b) {
    const Vec3 u = a - centre, v = b - centre;
    const double longest =
        std::sqrt(std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()}));
    const int n = std::max(kLeastParts, static_cast<int>(std::ceil(longest / lookup_.step_rad())));
    points_.clear();
    weights_.clear();
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n - i; ++j) {
        push(centre + (i + 1.0 / 3.0) / n * u + (j + 1.0 / 3.0) / n * v);
        if (j + 1 < n - i) push(centre + (i + 2.0 / 3.0) / n * u + (j + 2.0 / 3.0) / n * v);
      }
    }
    places_.resize(points_.size());
    grid_.surface.lon_lat(points_, grid_.latitude, places_);
    Sums sums;
    for (std::size_t k = 0; k < places_.size(); ++k) lookup_.add(places_[k], weights_[k], sums);
    return sums;
  }

  // Parts of one plane are seen from the centre under angles that go with 1 / distance^3.
  void push(const Vec3& p) {
    const double square = p.squaredNorm();
    points_.push_back(grid_.surface.project(p));
    weights_.push_back(1.0 / (square * std::sqrt(square)));
  }

  const Grid& grid_;
  const Lookup& lookup_;
  std::vector<Vec3> points_;
  std::vector<double> weights_;
  std::vector<LonLat> places_;
};

}  // namespace

CellMeans mean_over_cells(Context& context, const Grid& grid, const LatLonField& elevation_m,
                          double sea_level_m) {
  CellMeans means;
  for (Array<double>* values : {&means.wet_fraction, &means.wet_depth_m, &means.elevation_m}) {
    values->resize(at(grid.n_cells()));
  }
  const Lookup lookup(elevation_m, sea_level_m);
  parallel::for_range(context.exec, grid.n_cells(), kCellGrain, [&](auto begin, auto end) {
    Sampler sampler(grid, lookup);
    for (std::int64_t i = begin; i < end; ++i) {
      const Sums sums = sampler.cell(i);
      means.wet_fraction[at(i)] = std::min(sums.wet / sums.all, 1.0);
      means.wet_depth_m[at(i)] = sums.wet > 0.0 ? sums.depth / sums.wet : 0.0;
      means.elevation_m[at(i)] =
          sums.valid > 0.0 ? sums.elevation / sums.valid : std::numeric_limits<double>::quiet_NaN();
    }
    context.monitor.advance(end - begin);
  });
  context.monitor.check_cancelled();
  return means;
}

CellMeans mean_over_cells(Context& context, const Grid& grid, const Raster& elevation_m,
                          double sea_level_m) {
  return mean_over_cells(context, grid, table_of(context.exec, elevation_m), sea_level_m);
}

LatLonField table_of(parallel::Executor& exec, const Raster& elevation_m) {
  LatLonField table = unset_table(resolution_rad(elevation_m));
  sample(exec, elevation_m, table);
  return table;
}

}  // namespace delos::domain
