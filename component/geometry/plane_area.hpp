// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include "geometry/ellipsoid.hpp"

namespace delos {

/// Areas on an ellipsoid of small polygons that are given by their central projection onto a plane,
/// whose sides there are straight: no point is brought to the surface.
///
/// The cone over the element dx dy at y = origin + x east + y north has on the surface y.W y = 1
/// the area |W y| / (y.W y)^2 det(origin, east, north) dx dy. Both forms are quadratic in x and y.
class PlaneArea {
 public:
  /// Lengths in scaled units; `east` and `north` span the plane and have about the length of
  /// `origin`.
  PlaneArea(const Ellipsoid& surface, const Vec3& origin, const Vec3& east, const Vec3& north);

  /// How large |x| and |y| may be: the rule of degree 5 then leaves less than 1e-14 of an area.
  double reach() const { return reach_; }
  /// Of the triangle with corners a, a + u, a + v in the plane; positive when counter-clockwise.
  /// Scaled units squared.
  double triangle(const std::array<double, 2>& a, const std::array<double, 2>& u,
                  const std::array<double, 2>& v) const;

 private:
  /// c0 + cx x + cy y + cxx x^2 + cxy x y + cyy y^2.
  struct Quadratic {
    double c0, cx, cy, cxx, cxy, cyy;
    double operator()(double x, double y) const {
      return c0 + (x * (cx + cxx * x + cxy * y) + y * (cy + cyy * y));
    }
  };

  Quadratic slope_square_{}, square_{};  // |W y|^2, y.W y
  double half_det_ = 0.0, reach_ = 0.0;
};

}  // namespace delos
