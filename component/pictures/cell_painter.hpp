// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The colour of the grid at a surface point: shared by globe and map.
#include <optional>
#include <vector>

#include "dual/grid.hpp"
#include "pictures/coastline.hpp"
#include "pictures/colour_map.hpp"
#include "sizing/nearest.hpp"

namespace delos::pictures {

/// Distance between neighbours of the hexagon of the same area, in km, for every cell.
std::vector<double> cell_sizes_km(const Grid& grid);

class CellPainter {
 public:
  /// `land` may be null.
  CellPainter(const Grid& grid, const LandMask* land);

  const SizeScale& scale() const { return scale_; }
  const std::vector<double>& sizes_km() const { return sizes_km_; }
  /// Colour at the surface point p (scaled), found by walking from cell `hint` to ever nearer
  /// neighbours: a Voronoi cell holds what is nearest to it. `hint` becomes the cell of p; near
  /// points asked one after the other cost a few steps each.
  /// Where a grid with a border has no cell, the colour is that of land.
  Colour colour(const Vec3& p, Index& hint) const;
  /// Whether cell `cell`, or the land that covers point p of it, is so dark that lines on it must
  /// be light.
  bool is_dark(Index cell, const Vec3& p) const;

 private:
  void walk(const Vec3& p, Index& hint) const;
  bool holds(Index cell, const Vec3& p) const;
  /// Whether a cell holds p; if so, `hint` becomes it.
  bool find(const Vec3& p, Index& hint) const;

  const Grid& grid_;
  std::optional<NearestPoint> nearest_;  ///< of a grid with a border, where walks may end early
  const LandMask* land_;
  std::vector<double> sizes_km_;
  SizeScale scale_;
  std::vector<Colour> cell_colours_;
};

/// Segments of cell outlines, sorted into a few opacities: the larger the cell on the picture, the
/// clearer its outline; below kOutlineFrom_px there is none. Light on dark cells, dark on the rest.
class Outlines {
 public:
  struct Cell {
    double size_px = 0.0;  ///< on the picture
    bool is_dark = false;
  };
  void add(const Segment& segment, const Cell& cell);
  void draw(Canvas& canvas) const;
  static bool is_visible(double size_px) { return size_px > kOutlineFrom_px; }

 private:
  static constexpr double kOutlineFrom_px = 4.0;
  static constexpr double kOutlineFull_px = 14.0;
  static constexpr std::size_t kLevels = 5;
  std::array<std::vector<Segment>, kLevels> dark_, light_;
};

/// What a picture of the grid says beside the title: counts and the range of cell sizes.
std::vector<std::string> facts(const Grid& grid, const std::vector<double>& sizes_km);

/// The same in one line.
std::string summary(const Grid& grid, const std::vector<double>& sizes_km);

}  // namespace delos::pictures
