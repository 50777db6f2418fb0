// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What transfer sees of a grid: convex polygons that tile the surface.
#include <span>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "core/prefetch.hpp"
#include "dual/grid.hpp"

namespace delos::remap {

/// The Voronoi cells of a grid or its triangles, as polygons whose sides lie in planes through the
/// centre. Corners counter-clockwise from outside; side k joins corner k - 1 to corner k, and
/// neighbour k is across it. A view: the grid must outlive it.
class Tiling {
 public:
  /// A grid with a border leaves part of the surface out: neighbour kNone.
  static Tiling cells(parallel::Executor& exec, const Grid& grid);
  /// Error(input) for a grid with a border, where triangles lack corners.
  static Tiling triangles(parallel::Executor& exec, const Grid& grid);

  std::int64_t size() const { return static_cast<std::int64_t>(area_m2_.size()); }
  /// Whether the polygons cover the surface.
  bool is_closed() const { return is_closed_; }
  const Ellipsoid& surface() const { return grid_->surface; }
  std::span<const Index> corners(std::int64_t i) const {
    return of_cells_ ? grid_->vertices_on_cell.row(i)
                     : std::span<const Index>(grid_->cells_on_vertex[static_cast<std::size_t>(i)]);
  }
  std::span<const Index> neighbours(std::int64_t i) const {
    return of_cells_ ? grid_->cells_on_cell.row(i)
                     : std::span<const Index>(beside_triangle_[static_cast<std::size_t>(i)]);
  }
  const Vec3& corner(Index id) const { return corner_position_[static_cast<std::size_t>(id)]; }
  /// Surface points inside the polygons, [size()].
  std::span<const Vec3> centres() const {
    return of_cells_ ? std::span<const Vec3>(grid_->cell_position) : own_centre_;
  }
  /// What polygon i has beyond its straight side k, scaled area: where rounding, relative to the
  /// square of the spacing, put the grid's edge off that side. Opposite in the neighbour.
  double bow(std::int64_t i, std::size_t k) const {
    return bow_.empty() ? 0.0 : bow_[at(grid_->edges_on_cell.offsets.begin_of(i)) + k];
  }
  /// As in the grid, [size()].
  std::span<const double> area_m2() const { return area_m2_; }

  /// Hints for a polygon that will be needed: where it is, some rounds later its lists, then what
  /// these name.
  void prefetch_place(std::int64_t i) const {
    prefetch(centres()[at(i)]);
    prefetch(area_m2_[at(i)]);
    if (of_cells_) prefetch(grid_->vertices_on_cell.offsets.positions()[at(i)]);
  }
  void prefetch_lists(std::int64_t i) const {
    const auto corner_ids = corners(i), beside = neighbours(i);
    prefetch(corner_ids.front());
    prefetch(corner_ids.back());
    prefetch(beside.front());
    prefetch(beside.back());
    if (bow_.empty()) return;
    const float* bow = &bow_[at(grid_->edges_on_cell.offsets.begin_of(i))];
    prefetch(bow[0]);
    prefetch(bow[corner_ids.size() - 1]);
  }
  void prefetch_corners(std::int64_t i) const {
    for (const Index id : corners(i)) {
      prefetch(corner(id).x());
      prefetch(corner(id).z());
    }
  }

 private:
  const Grid* grid_ = nullptr;
  bool of_cells_ = true;
  bool is_closed_ = true;
  std::span<const Vec3> corner_position_;
  std::span<const double> area_m2_;
  Array<float> bow_;                             // side by side; empty for triangles
  Array<std::array<Index, 3>> beside_triangle_;  // empty for cells
  Array<Vec3> own_centre_;                       // empty for cells
};

}  // namespace delos::remap
