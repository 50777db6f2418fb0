// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The surface: the axis-aligned triaxial ellipsoid sum(((x_i - c_i) / r_i)^2) = 1
// (Engwirda 2015, Eq. 1), with the sphere as its special case.
//
// All functions work in scaled coordinates: origin at the centre, largest radius 1. to_metres()
// and scale_m() are the way out.
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <span>

#include "core/elementary.hpp"
#include "core/types.hpp"

namespace delos {

/// Meaning of a latitude. On a sphere the three agree.
///   geodetic:   angle of the surface normal with the equatorial plane (what DEMs use);
///               longitude is that of the normal too, which matters on a triaxial body
///   geocentric: angle of the radius vector
///   parametric: x = r1 cos(lat) cos(lon), y = r2 cos(lat) sin(lon), z = r3 sin(lat)
enum class LatitudeKind { geodetic, geocentric, parametric };

struct LonLat {
  double lon_rad;  ///< in (-pi, pi]
  double lat_rad;  ///< in [-pi/2, pi/2]
};

class Ellipsoid {
 public:
  /// Unit sphere.
  Ellipsoid() : Ellipsoid(Vec3(1, 1, 1), Vec3(0, 0, 0)) {}
  /// Radii and centre in metres. Error(config) unless the radii are finite and > 0.
  Ellipsoid(const Vec3& radii_m, const Vec3& centre_m);
  static Ellipsoid sphere(double radius_m) {
    return {Vec3(radius_m, radius_m, radius_m), Vec3(0, 0, 0)};
  }
  /// WGS 84: a = 6378137 m, 1/f = 298.257223563.
  static Ellipsoid wgs84();

  bool is_sphere() const { return is_sphere_; }
  /// Scaled radii, the largest is 1.
  const Vec3& radii() const { return radii_; }
  /// Metres per scaled unit (the largest radius).
  double scale_m() const { return scale_m_; }
  const Vec3& centre_m() const { return centre_m_; }
  Vec3 to_metres(const Vec3& p) const { return centre_m_ + scale_m_ * p; }

  /// The surface point on the ray from the centre through p (p not 0).
  Vec3 project(const Vec3& p) const {
    return p / std::sqrt(p.cwiseProduct(inverse_square_).dot(p));
  }
  /// Unit outward normal at the surface point p.
  Vec3 normal(const Vec3& p) const { return p.cwiseProduct(inverse_square_).normalized(); }
  /// 1 / r_i^2, scaled.
  const Vec3& inverse_square() const { return inverse_square_; }

  LonLat lon_lat(const Vec3& p, LatitudeKind kind) const;
  /// The same bits for many points at once, faster. The spans have the same length.
  void lon_lat(std::span<const Vec3> points, LatitudeKind kind, std::span<LonLat> out) const;
  Vec3 point(const LonLat& lon_lat, LatitudeKind kind) const;
  /// The same from sines and cosines, for loops over the nodes of a table.
  Vec3 point(const elementary::SinCos& lon, const elementary::SinCos& lat, LatitudeKind kind) const;

  /// Centre of the surface Delaunay ball of three surface points (Engwirda 2015, section 2.4):
  /// where the line of points equidistant from them meets the surface on their side. a, b, c
  /// counter-clockwise seen from outside.
  Vec3 ball_centre(const Vec3& a, const Vec3& b, const Vec3& c) const {
    return is_sphere_ ? (b - a).cross(c - a).normalized() : ellipsoidal_ball_centre(a, b, c);
  }

  /// Length of the curve cut from the surface by the plane through a, b and the centre (on the
  /// sphere: the great-circle arc).
  double arc_length(const Vec3& a, const Vec3& b) const;
  /// Area of the surface triangle bounded by three such curves; negative when clockwise seen from
  /// outside. Additive to rounding: the parts of a split triangle sum to the whole.
  double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) const;
  /// triangle_area(centre, ring[k], ring[k + 1]) around a point, to rounding; faster.
  std::array<double, 6> fan_areas(const Vec3& centre, const std::array<Vec3, 6>& ring) const;
  /// Area of the whole surface.
  double area() const;

 private:
  /// A vector whose angles are the longitude and latitude of p.
  Vec3 direction(const Vec3& p, LatitudeKind kind) const;
  /// Triangles with no longer sides take the rule of degree 5.
  bool is_small(double side_square) const;
  Vec3 ellipsoidal_ball_centre(const Vec3& a, const Vec3& b, const Vec3& c) const;

  Vec3 radii_;
  Vec3 inverse_square_;
  Vec3 centre_m_;
  double scale_m_;
  bool is_sphere_;
};

}  // namespace delos
