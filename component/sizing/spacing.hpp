// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The wanted spacing h(x): the finished product of this layer, what refine and relax look up.
#include <memory>
#include <span>
#include <vector>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "core/types.hpp"
#include "geometry/ellipsoid.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// A scalar on the regular lat-lon nodes lat_j = -90 + 180 j / n_lat_cells (both poles included,
/// n_lat_cells + 1 rows) and lon_i = -180 + 360 i / n_lon (periodic, n_lon columns).
/// Row-major, values[j * n_lon + i].
struct LatLonField {
  Index n_lat_cells = 0;
  Index n_lon = 0;
  Array<double> values;

  Index n_rows() const { return n_lat_cells + 1; }
  double lat_rad(Index row) const { return kPi * (static_cast<double>(row) / n_lat_cells - 0.5); }
  double lon_rad(Index column) const { return kPi * (2.0 * column / n_lon - 1.0); }
  std::size_t at(Index row, Index column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(n_lon) +
           static_cast<std::size_t>(column);
  }
};

/// Spacing at any point of the surface: bilinear on a lat-lon table (Engwirda 2015, section 2.1),
/// or a constant. Immutable, cheap to copy, safe to share between threads. Only + - * / and sqrt,
/// so the same bits everywhere.
class SpacingField {
 public:
  /// Error(config) unless finite and > 0.
  static SpacingField constant(const Ellipsoid& surface, double spacing_m);
  /// Table in metres; the one place where metres become scaled units. Error(input) with lon/lat
  /// of the first value that is not finite and > 0.
  static SpacingField table(parallel::Executor& exec, const Ellipsoid& surface,
                            LatitudeKind latitude, const LatLonField& spacing_m);
  /// The same on the calling thread alone.
  static SpacingField table(const Ellipsoid& surface, LatitudeKind latitude,
                            const LatLonField& spacing_m);

  /// What scaled() gave, as the same field to the last bit. Error(input) as table().
  static SpacingField of_scaled(parallel::Executor& exec, const Ellipsoid& surface,
                                LatitudeKind latitude, const LatLonField& spacing);

  /// Scaled spacing at a scaled surface point.
  double at(double x, double y, double z) const;
  /// The same for many: vertices[i].spacing = at(vertices[i]); several times faster per point.
  void evaluate(std::span<Vertex> vertices) const;
  void evaluate(parallel::Executor& exec, std::span<Vertex> vertices) const;

  bool is_constant() const { return table_ == nullptr; }
  /// Least and greatest scaled spacing.
  double min() const { return min_; }
  double max() const { return max_; }
  /// The table back in metres, for files and pictures; of a constant, one of 1 degree.
  LatLonField to_table() const;
  /// All of it, scaled, for restart files: the table, or the one value of a constant (n_lon = 0).
  LatLonField scaled() const;
  LatitudeKind latitude() const;

 private:
  friend double expected_vertices(parallel::Executor&, const Ellipsoid&, const SpacingField&);
  struct Table;
  struct TableSource;
  void fill(parallel::Executor& exec, const TableSource& source);
  LatLonField nodes(double unit) const;

  std::shared_ptr<const Table> table_;
  double min_ = 0.0, max_ = 0.0;
  double scale_m_ = 1.0;
};

/// Expected number of vertices: the integral of 2 / (sqrt(3) h^2) over the surface (each vertex
/// owns two equilateral triangles of side h). The bilinear h is integrated exactly within each
/// cell of the table, the area element taken at the cell's centre; relative error below 1e-4 for
/// tables of 1 degree or finer, whatever the contrast of h.
double expected_vertices(parallel::Executor& exec, const Ellipsoid& surface,
                         const SpacingField& spacing);

}  // namespace delos
