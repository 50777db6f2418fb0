// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/spacing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "sizing/nodes.hpp"

namespace delos {
namespace {

/// Points per batch: the scratch (4 arrays) stays in the first-level cache.
constexpr std::size_t kBatch = 256;
/// Places computed together: a multiple of every vector width, small for short spans.
constexpr std::size_t kLanes = 8;
/// Rows of table cells per block of the integral; part of the answer.
constexpr std::int64_t kIntegralGrain = 8;
/// Vertices per block of a parallel lookup: some batches.
constexpr std::int64_t kLookupGrain = 16 * kBatch;

/// Coefficients in u^2 of atan(u) / u, interpolated at Chebyshev nodes on |u| <= tan(pi/8);
/// |error| < 3e-13 rad.
constexpr double kAtan[8] = {0.9999999999992447,   -0.33333333276922494, 0.19999993053555815,
                             -0.14285386553752139, 0.11103456908947464,  -0.08992552906150911,
                             0.06974197686595264,  -0.03765510601291401};
constexpr double kTanPi8 = 0.41421356237309503;

/// atan(small / large) for 0 <= small <= large, without a branch: turned by pi/8, so that one
/// division serves and the argument of the polynomial stays below tan(pi/8).
inline double first_octant(double small, double large) {
  const double below = large + kTanPi8 * small;
  // At the poles both are 0: any longitude will do, a NaN will not.
  const double u = (small - kTanPi8 * large) / (below > 0.0 ? below : 1.0);
  // Estrin's order: a third of the latency of Horner's, which a single lookup waits for.
  const double v = u * u, v2 = v * v;
  const double low = (kAtan[0] + kAtan[1] * v) + (kAtan[2] + kAtan[3] * v) * v2;
  const double high = (kAtan[4] + kAtan[5] * v) + (kAtan[6] + kAtan[7] * v) * v2;
  return kPi / 8.0 + u * (low + high * (v2 * v2));
}

inline double quick_atan2(double y, double x) {
  const double ax = std::abs(x), ay = std::abs(y);
  double angle = first_octant(ax < ay ? ax : ay, ax < ay ? ay : ax);
  angle = ax < ay ? kPi / 2.0 - angle : angle;
  angle = x < 0.0 ? kPi - angle : angle;
  return y < 0.0 ? -angle : angle;
}

/// Table coordinates: whole part = cell, fraction = place in it.
struct Place {
  double column, row;
};

struct Lookup {
  Vec3 weight;  ///< direction whose lon/lat count = weight * position
  double columns_per_rad, rows_per_rad;
  double max_column, max_row;  ///< n_lon, n_lat_cells

  inline Place place(double x, double y, double z) const {
    x *= weight[0];
    y *= weight[1];
    z *= weight[2];
    const double lon = quick_atan2(y, x);
    const double lat = quick_atan2(z, std::sqrt(x * x + y * y));
    const double column = (lon + kPi) * columns_per_rad;
    const double row = (lat + 0.5 * kPi) * rows_per_rad;
    return {std::min(std::max(column, 0.0), max_column), std::min(std::max(row, 0.0), max_row)};
  }
};

Vec3 direction_weight(const Ellipsoid& surface, LatitudeKind latitude) {
  if (surface.is_sphere() || latitude == LatitudeKind::geocentric) return Vec3(1, 1, 1);
  if (latitude == LatitudeKind::geodetic) return surface.inverse_square();
  return surface.inverse_square().cwiseSqrt();
}

/// Surface area per solid angle of the table's direction u. Normal: 1 / Gaussian curvature in
/// terms of the support function; radius: ray over slant; parametric: cofactor of diag(r).
double area_per_solid_angle(const Ellipsoid& surface, LatitudeKind latitude, const Vec3& u) {
  const Vec3& r = surface.radii();
  const double product = r[0] * r[1] * r[2];
  if (latitude == LatitudeKind::geodetic) {
    const double support2 = r.cwiseProduct(u).squaredNorm();
    return product * product / (support2 * support2);
  }
  if (latitude == LatitudeKind::geocentric) {
    const double q = u.cwiseQuotient(r).squaredNorm();
    return u.cwiseProduct(surface.inverse_square()).norm() / (q * q);
  }
  return product * u.cwiseQuotient(r).norm();
}

/// Integral over the unit square of 1 / h^2 for bilinear h: along a row exactly 1 / (west east),
/// then of 1 / ((a0 + s da)(b0 + s db)) over s in [0, 1], which is log(q) / ((q - 1) a0 b1).
double inverse_square_mean(double a0, double b0, double a1, double b1) {
  const double q = (a1 * b0) / (a0 * b1);
  double log_ratio;  // log(q) / (q - 1)
  if (q > 0.5 && q < 2.0) {
    const double z = (q - 1.0) / (q + 1.0), z2 = z * z;
    double series = 1.0 / 13.0;
    for (int k = 11; k >= 1; k -= 2) series = series * z2 + 1.0 / k;
    log_ratio = 2.0 / (q + 1.0) * series;
  } else {
    log_ratio = elementary::log(q) / (q - 1.0);
  }
  return log_ratio / (a0 * b1);
}

}  // namespace

/// What a table is made of: nodes in `unit`.
struct SpacingField::TableSource {
  Vec3 weight;
  LatitudeKind latitude;
  const LatLonField& nodes;
  double unit;
};

struct SpacingField::Table {
  Lookup lookup;
  LatitudeKind latitude;
  Index n_rows, n_columns;  ///< n_columns = n_lon + 1: the first column again at the end
  Array<double> values;     ///< scaled

  inline double value(Place at) const {
    const Index row = std::min(static_cast<Index>(at.row), n_rows - 2);
    const Index column = std::min(static_cast<Index>(at.column), n_columns - 2);
    const double s = at.row - row, t = at.column - column;
    const double* south = values.data() + static_cast<std::size_t>(row) * n_columns + column;
    const double* north = south + n_columns;
    const double low = south[0] + t * (south[1] - south[0]);
    const double high = north[0] + t * (north[1] - north[0]);
    return low + s * (high - low);
  }
};

namespace {

void check_table(parallel::Executor& exec, const LatLonField& field, const char* unit) {
  DELOS_CHECK(field.n_lat_cells >= 1 && field.n_lon >= 1 &&
                  field.values.size() == static_cast<std::size_t>(field.n_rows()) *
                                             static_cast<std::size_t>(field.n_lon),
              ErrorKind::input, "spacing table of ", field.n_rows(), " x ", field.n_lon,
              " nodes holds ", field.values.size(), " values: give one value a node");
  const std::size_t node = first_not_positive(exec, field);
  DELOS_CHECK(node == field.values.size(), ErrorKind::input, "spacing is ", field.values[node],
              unit, " at ", place_of(field, node),
              ": it must be finite and > 0; clamp it or fill the missing values");
}

/// A row of the finished table, with the first column again at its end; the least and the greatest
/// of it.
std::pair<double, double> fill_row(const LatLonField& nodes, Index row, double unit, double* to) {
  const Index n = nodes.n_lon;
  const double* from = nodes.values.data() + nodes.at(row, 0);
  if (row == 0 || row == nodes.n_lat_cells) {
    // One point, one value: the finest of a pole's row counts for the pole.
    std::fill_n(to, n, *std::min_element(from, from + n) / unit);
  } else {
    for (Index i = 0; i < n; ++i) to[i] = from[i] / unit;
  }
  to[n] = to[0];
  std::pair<double, double> bounds{to[0], to[0]};
  for (Index i = 1; i < n; ++i) {
    bounds.first = std::min(bounds.first, to[i]);
    bounds.second = std::max(bounds.second, to[i]);
  }
  return bounds;
}

}  // namespace

SpacingField SpacingField::constant(const Ellipsoid& surface, double spacing_m) {
  DELOS_CHECK(std::isfinite(spacing_m) && spacing_m > 0.0, ErrorKind::config, "spacing is ",
              spacing_m, " m: it must be finite and > 0");
  SpacingField field;
  field.scale_m_ = surface.scale_m();
  field.min_ = field.max_ = spacing_m / surface.scale_m();
  return field;
}

SpacingField SpacingField::table(const Ellipsoid& surface, LatitudeKind latitude,
                                 const LatLonField& spacing_m) {
  parallel::Executor exec(1);
  return table(exec, surface, latitude, spacing_m);
}

SpacingField SpacingField::table(parallel::Executor& exec, const Ellipsoid& surface,
                                 LatitudeKind latitude, const LatLonField& spacing_m) {
  check_table(exec, spacing_m, " m");
  SpacingField field;
  field.scale_m_ = surface.scale_m();
  field.fill(exec, {direction_weight(surface, latitude), latitude, spacing_m, field.scale_m_});
  return field;
}

SpacingField SpacingField::of_scaled(parallel::Executor& exec, const Ellipsoid& surface,
                                     LatitudeKind latitude, const LatLonField& spacing) {
  SpacingField field;
  field.scale_m_ = surface.scale_m();
  if (spacing.n_lon > 0) {
    check_table(exec, spacing, " radii");
    field.fill(exec, {direction_weight(surface, latitude), latitude, spacing, 1.0});
    return field;
  }
  DELOS_CHECK(
      spacing.values.size() == 1 && std::isfinite(spacing.values[0]) && spacing.values[0] > 0.0,
      ErrorKind::input, "a constant spacing of ", spacing.values.size(),
      " values: give one, finite and > 0");
  field.min_ = field.max_ = spacing.values[0];
  return field;
}

void SpacingField::fill(parallel::Executor& exec, const TableSource& source) {
  const LatLonField& nodes = source.nodes;
  auto table = std::make_shared<Table>();
  const Index n_lon = nodes.n_lon;
  table->latitude = source.latitude;
  table->n_rows = nodes.n_rows();
  table->n_columns = n_lon + 1;
  table->lookup = {source.weight, n_lon / (2.0 * kPi), nodes.n_lat_cells / kPi,
                   static_cast<double>(n_lon), static_cast<double>(nodes.n_lat_cells)};
  table->values.resize(static_cast<std::size_t>(table->n_rows) *
                       static_cast<std::size_t>(table->n_columns));

  std::vector<std::pair<double, double>> bounds(static_cast<std::size_t>(table->n_rows));
  parallel::for_index(exec, table->n_rows, kRowGrain, [&](std::int64_t row) {
    bounds[static_cast<std::size_t>(row)] = fill_row(nodes, static_cast<Index>(row), source.unit,
                                                     table->values.data() + row * table->n_columns);
  });
  min_ = std::numeric_limits<double>::infinity();
  for (const auto& [least, greatest] : bounds) {
    min_ = std::min(min_, least);
    max_ = std::max(max_, greatest);
  }
  table_ = std::move(table);
}

double SpacingField::at(double x, double y, double z) const {
  if (!table_) return min_;
  return table_->value(table_->lookup.place(x, y, z));
}

void SpacingField::evaluate(std::span<Vertex> vertices) const {
  if (!table_) {
    for (Vertex& vertex : vertices) vertex.spacing = min_;
    return;
  }
  const Table& table = *table_;
  const Lookup lookup = table.lookup;
  // Arrays of one coordinate each and whole groups of lanes: the loop of places vectorises.
  double x[kBatch] = {}, y[kBatch] = {}, z[kBatch] = {}, column[kBatch], row[kBatch];
  for (std::size_t begin = 0; begin < vertices.size(); begin += kBatch) {
    const std::size_t n = std::min(kBatch, vertices.size() - begin);
    Vertex* batch = vertices.data() + begin;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] = batch[i].x;
      y[i] = batch[i].y;
      z[i] = batch[i].z;
    }
    for (std::size_t lane = 0; lane < n; lane += kLanes) {
      for (std::size_t i = lane; i < lane + kLanes; ++i) {
        const Place place = lookup.place(x[i], y[i], z[i]);
        column[i] = place.column;
        row[i] = place.row;
      }
    }
    for (std::size_t i = 0; i < n; ++i) batch[i].spacing = table.value({column[i], row[i]});
  }
}

void SpacingField::evaluate(parallel::Executor& exec, std::span<Vertex> vertices) const {
  parallel::for_range(exec, static_cast<std::int64_t>(vertices.size()), kLookupGrain,
                      [&](std::int64_t begin, std::int64_t end) {
                        evaluate(vertices.subspan(static_cast<std::size_t>(begin),
                                                  static_cast<std::size_t>(end - begin)));
                      });
}

LatitudeKind SpacingField::latitude() const {
  return table_ ? table_->latitude : LatitudeKind::geodetic;
}

LatLonField SpacingField::to_table() const {
  if (table_) return nodes(scale_m_);
  LatLonField field;
  field.n_lat_cells = 180;
  field.n_lon = 360;
  field.values.assign(
      static_cast<std::size_t>(field.n_rows()) * static_cast<std::size_t>(field.n_lon),
      min_ * scale_m_);
  return field;
}

LatLonField SpacingField::scaled() const {
  if (table_) return nodes(1.0);
  return {0, 0, {min_}};
}

LatLonField SpacingField::nodes(double unit) const {
  LatLonField field;
  field.n_lat_cells = table_->n_rows - 1;
  field.n_lon = table_->n_columns - 1;
  field.values.resize(static_cast<std::size_t>(field.n_rows()) *
                      static_cast<std::size_t>(field.n_lon));
  for (Index row = 0; row < field.n_rows(); ++row) {
    const double* from = table_->values.data() + static_cast<std::size_t>(row) * table_->n_columns;
    for (Index column = 0; column < field.n_lon; ++column) {
      field.values[field.at(row, column)] = from[column] * unit;
    }
  }
  return field;
}

double expected_vertices(parallel::Executor& exec, const Ellipsoid& surface,
                         const SpacingField& spacing) {
  const double per_area = 2.0 / std::sqrt(3.0);
  if (!spacing.table_) return per_area * surface.area() / (spacing.min_ * spacing.min_);
  const SpacingField::Table& table = *spacing.table_;
  const Index n_lon = table.n_columns - 1;
  const double lon_step = 2.0 * kPi / n_lon, lat_step = kPi / (table.n_rows - 1);
  std::vector<elementary::SinCos> lon(static_cast<std::size_t>(n_lon));
  for (Index i = 0; i < n_lon; ++i) {
    lon[static_cast<std::size_t>(i)] = elementary::sincos(lon_step * (i + 0.5) - kPi);
  }
  const bool is_sphere = surface.is_sphere();
  const double mass = parallel::sum(exec, table.n_rows - 1, kIntegralGrain, [&](std::int64_t row) {
    const elementary::SinCos lat = elementary::sincos(lat_step * (row + 0.5) - 0.5 * kPi);
    const double* south = table.values.data() + row * table.n_columns;
    const double* north = south + table.n_columns;
    double sum = 0.0;
    for (Index i = 0; i < n_lon; ++i) {
      double part = inverse_square_mean(south[i], south[i + 1], north[i], north[i + 1]);
      if (!is_sphere) {
        const elementary::SinCos& meridian = lon[static_cast<std::size_t>(i)];
        part *= area_per_solid_angle(surface, table.latitude,
                                     Vec3(lat.cos * meridian.cos, lat.cos * meridian.sin, lat.sin));
      }
      sum += part;
    }
    // Exact area of the band: integral of cos(lat) = 2 sin(step / 2) cos(middle).
    return sum * 2.0 * elementary::sin(0.5 * lat_step) * lat.cos * lon_step;
  });
  return per_area * mass;
}

}  // namespace delos
