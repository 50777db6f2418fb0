// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From the ellipsoid to the sphere, for the formats and models that know only spheres.
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "geometry/ellipsoid.hpp"

namespace delos {

enum class SphereMapKind {
  /// lon_lat on a sphere and on a spheroid around z that is flattened by less than 1/100 (Earth,
  /// Mars), conformal on all else.
  automatic,
  /// Longitude and geodetic latitude stay what they are, so that data are found where they were.
  /// Angles change by at most 0.4 degrees on WGS 84. Spheroids around z only.
  lon_lat,
  /// Angles stay what they are: a well-centred triangulation stays well centred up to its
  /// curvature, O(spacing^2).
  conformal
};

/// A smooth one-to-one map of the surface onto the unit sphere. It takes octants to octants, the
/// symmetry planes and axes of the ellipsoid to themselves.
///
/// conformal, triaxial body: Jacobi's ellipsoidal coordinates (beta, omega) are isothermal: the
/// metric is (p(beta) + q(omega)) times a metric that separates (Jacobi 1839; Nyrtsov et al. 2014,
/// doi:10.1007/978-3-642-32618-9_17; Karney, GeographicLib "Jacobi's conformal projection"). So are
/// the sphero-conal coordinates of the sphere; their modulus is the one that gives a quarter of
/// the sphere the same ratio of isothermal sides. Equal isothermal coordinates, equal point.
/// Spheroid: the conformal latitude in closed form (Snyder 1987, Eq. 3-1). Sphere: identity.
class SphereMap {
 public:
  /// Error(config) when lon_lat is asked for on a body without a symmetry axis along z.
  explicit SphereMap(const Ellipsoid& surface, SphereMapKind kind = SphereMapKind::automatic);

  /// lon_lat or conformal.
  SphereMapKind kind() const { return kind_; }
  /// The sphere that has the area of the surface, in metres.
  Ellipsoid sphere() const;
  /// Image, of length 1, of the scaled surface point p.
  Vec3 operator()(const Vec3& p) const;
  /// Length on the unit sphere per scaled length on the surface at p: the mean (geometric) over
  /// directions; the wanted spacing goes along with it. Relative accuracy 1e-6.
  double stretch(const Vec3& p) const;

 private:
  enum class Method { identity, lon_lat, conformal_latitude, jacobi };

  /// angle -> angle + sum of coefficient[n] sin(2 (n + 1) angle).
  struct AngleMap {
    std::vector<double> coefficient;
  };
  void choose_method();
  void prepare_jacobi();
  Vec3 map_conformal_latitude(const Vec3& p) const;
  Vec3 map_jacobi(const Vec3& p) const;

  Ellipsoid surface_;
  SphereMapKind kind_;
  Method method_ = Method::identity;
  std::array<int, 3> axis_ = {0, 1, 2};  // longest to shortest; the axis of symmetry last
  double k2_ = 0.0, kp2_ = 0.0;          // squared modulus and complement, ellipsoid
  double sphere_k2_ = 0.0, sphere_kp2_ = 0.0;
  AngleMap beta_, omega_;  // omega measured from 90 degrees
};

/// map(p) for many points, in parallel; the same bits for any number of threads.
std::vector<Vec3> map_to_sphere(parallel::Executor& exec, const SphereMap& map,
                                std::span<const Vec3> points);

}  // namespace delos
