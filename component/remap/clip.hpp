// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Intersection of two polygons on the surface, worked out in the plane that touches the first.
//
// Central projection onto that plane makes lines of planes through the centre, on the sphere and
// on an ellipsoid alike, so that the intersection of two polygons is that of flat ones. Coordinates
// are differences from the first polygon's centre: rounding is relative to the polygon, not to the
// body. Of two polygons the smaller is cut by the sides of the larger, of which few cross it.
// Points of a second polygon that is the larger stay homogeneous, so that it may reach round the
// body.
#include <optional>
#include <span>
#include <vector>

#include "geometry/ellipsoid.hpp"
#include "geometry/plane_area.hpp"
#include "remap/tiling.hpp"

namespace delos::remap {

/// Surface coordinates around a point.
class Frame {
 public:
  explicit Frame(const Vec3& origin);
  /// Homogeneous coordinates (x, y, height) of p; the plane is height = that of the origin.
  Vec3 local(const Vec3& p) const {
    const Vec3 d = p - origin_;
    return {d.dot(east_), d.dot(north_), height_ + d.dot(up_)};
  }
  /// The point of the plane, in space; its direction is what counts.
  Vec3 point(double x, double y) const { return origin_ + height_ * (x * east_ + y * north_); }
  /// Areas of what is given in the plane.
  PlaneArea areas_on(const Ellipsoid& surface) const {
    return {surface, origin_, height_ * east_, height_ * north_};
  }

 private:
  Vec3 origin_, up_, east_, north_;
  double height_;
};

struct Corner {
  double x, y;
  Index side;  ///< what the side from here on lies on: side k of the clipping polygon or, as ~k, of
               ///< the clipped one
};

/// Keeps its memory from one intersection to the next; one for each task.
class Clipper {
 public:
  /// Chooses the polygon to be clipped. False when it is wider than a hemisphere.
  bool begin(const Tiling& tiling, std::int64_t polygon);
  /// Intersection with another polygon: corners counter-clockwise, fewer than three when they have
  /// no area in common. Valid until the next call.
  std::span<const Corner> clip(const Tiling& tiling, std::int64_t polygon);
  /// Area in scaled units.
  double area(const Ellipsoid& surface, std::span<const Corner> corners) const;
  /// The area with what the sides of the last two polygons, of which `polygon` is the second, have
  /// beyond their straight lines: of each bow the part that a side of the intersection takes.
  double with_bows(double area, const Tiling& tiling, std::int64_t polygon,
                   std::span<const Corner> corners);
  /// Surface point in the middle of the corners' polygon.
  Vec3 middle(const Ellipsoid& surface, std::span<const Corner> corners) const;

 private:
  bool cut(const Vec3& line, double on_side, Index side);
  bool find_lines();
  bool flatten(const Vec3& centre);
  bool cut_by_subject();
  bool cut_subject(const Vec3& centre);
  void make_room(std::size_t n_clipping);

  // Of a side's bow belongs to a part of length l: l scale / whole.
  struct Side {
    double bow, scale, whole;
  };

  // A side of the subject as a line, and what bounds its values: sums of its coordinates' sizes.
  struct Line {
    Vec3 line;
    double slope, length;
  };

  Frame frame_{Vec3(0, 0, 1)};
  std::optional<PlaneArea> plane_area_;  // where the body is no sphere and the subject small
  std::vector<Corner> subject_, current_, next_;  // of the last two n_ count
  std::size_t n_ = 0;
  double reach_ = 0.0;                                     // no coordinate of the subject is larger
  double area_m2_ = 0.0;                                   // of the subject
  std::vector<Line> lines_;                                // of the subject's sides
  bool is_sound_ = true;                                   // none of them runs backwards
  double flat_x_ = 0.0, flat_y_ = 0.0, flat_reach_ = 0.0;  // around the polygon that is cut
  std::vector<Vec3> clipping_;                             // of it n_clipping_ count
  std::size_t n_clipping_ = 0;
  std::vector<double> distance_;
  std::vector<Side> sides_;  // those of the subject, then of the other
};

}  // namespace delos::remap
