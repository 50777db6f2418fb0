// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The colour of the grid at a surface point: shared by globe and map.
#include <functional>
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
  int n_rings() const { return n_rings_; }
  /// Of a cell of the middle size.
  Colour ring_colour(int ring) const;
  /// Colour at the surface point p (scaled), found by walking from cell `hint` to ever nearer
  /// neighbours: a Voronoi cell holds what is nearest to it. `hint` becomes the cell of p; near
  /// points asked one after the other cost a few steps each.
  /// Where a grid with a border has no cell, the colour is that of land; beside a regional grid the
  /// sea is pale. Its rings are tinted, the more the farther out, and land covers its cells less.
  Colour colour(const Vec3& p, Index& hint) const;
  /// Whether cell `cell`, or the land that covers point p of it, is so dark that lines on it must
  /// be light.
  bool is_dark(Index cell, const Vec3& p) const;

 private:
  void walk(const Vec3& p, Index& hint) const;
  bool holds(Index cell, const Vec3& p) const;
  /// Whether a cell holds p; if so, `hint` becomes it.
  bool find(const Vec3& p, Index& hint) const;
  double land_cover() const;
  Colour tinted(const Colour& colour, int ring) const;

  const Grid& grid_;
  std::optional<NearestPoint> nearest_;  ///< of a grid with a border, where walks may end early
  const LandMask* land_;
  std::vector<double> sizes_km_;
  SizeScale scale_;
  std::vector<Colour> cell_colours_;
  int n_rings_ = 0;
};

/// What a picture shows at some point of the sheet.
struct Sample {
  Vec3 point;          ///< of the surface
  double light = 1.0;  ///< the colour is times this
};

/// The pixels of a box with corners on whole pixels, four samples each; clear where there is none.
Image painted(const CellPainter& painter, const Box& box,
              const std::function<std::optional<Sample>(const Point&)>& sample_at);

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
