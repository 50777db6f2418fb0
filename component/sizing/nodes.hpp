// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Small tools of this layer: loops over the rows of a table, directions of its nodes, poles.
#include <string>
#include <vector>

#include "core/elementary.hpp"
#include "core/parallel.hpp"
#include "core/types.hpp"
#include "geometry/ellipsoid.hpp"
#include "sizing/spacing.hpp"

namespace delos {

/// Rows a block: a row is at least some hundred nodes, and no result depends on the block.
inline constexpr std::int64_t kRowGrain = 4;

/// body(row, values of the row) for every row, in parallel.
template <class Body>
void for_rows(parallel::Executor& exec, LatLonField& field, Body&& body) {
  parallel::for_index(exec, field.n_rows(), kRowGrain, [&](std::int64_t row) {
    const auto j = static_cast<Index>(row);
    body(j, field.values.data() + field.at(j, 0));
  });
}

/// Takes the size of `like`; the values are left unset.
void resize_like(const LatLonField& like, LatLonField& field);

/// to = scale * from, node by node, on tables of one size (which may be the same).
void scale_into(parallel::Executor& exec, double scale, const LatLonField& from, LatLonField& to);

/// The first node in row-major order whose value is not finite and > 0; the number of nodes when
/// there is none.
std::size_t first_not_positive(parallel::Executor& exec, const LatLonField& field);
/// "lon 12.5, lat -30 deg" of a node, for messages.
std::string place_of(const LatLonField& field, std::size_t node);

/// Sine and cosine of every row and column; the unit vector of a node from two of them.
struct NodeDirections {
  explicit NodeDirections(const LatLonField& field);
  Vec3 direction(Index row, Index column) const {
    const elementary::SinCos& a = lat[static_cast<std::size_t>(row)];
    const elementary::SinCos& b = lon[static_cast<std::size_t>(column)];
    return {a.cos * b.cos, a.cos * b.sin, a.sin};
  }
  std::vector<elementary::SinCos> lat, lon;
};

inline Vec3 unit_vector(double lon_deg, double lat_deg) {
  const elementary::SinCos lon = elementary::sincos(lon_deg * kRadPerDeg);
  const elementary::SinCos lat = elementary::sincos(lat_deg * kRadPerDeg);
  return {lat.cos * lon.cos, lat.cos * lon.sin, lat.sin};
}

/// Great-circle angle of two unit vectors from their squared chord.
inline double angle_of_chord2(double chord2) {
  return 2.0 * elementary::asin(0.5 * std::sqrt(chord2));
}

/// Steps of the table in metres. On a body of revolution a row has one pair of steps; on a triaxial
/// one every node has its own, and its lon-lat lines need not be at right angles.
struct TableMetric {
  TableMetric(parallel::Executor& exec, const Ellipsoid& surface, LatitudeKind latitude,
              const LatLonField& field);
  /// Where the steps of a node stand in dx, dy and cosine.
  std::size_t at(const LatLonField& field, Index row, Index column) const {
    return is_triaxial ? field.at(row, column) : static_cast<std::size_t>(row);
  }
  bool is_triaxial;
  Array<double> dx, dy;
  Array<double> cosine;  ///< of the angle between the eastward and the northward step

 private:
  void measure_rows(const Ellipsoid& surface, LatitudeKind latitude, const LatLonField& field);
  void measure_nodes(parallel::Executor& exec, const Ellipsoid& surface, LatitudeKind latitude,
                     const LatLonField& field);
};

/// A pole is one point: its row gets the mean of its valid values (NaN when there is none).
void unify_pole(double* row, Index n_lon);
void unify_poles(LatLonField& field);
/// The same with the least value: what a bound on h asks for.
void unify_poles_to_min(LatLonField& field);

}  // namespace delos
