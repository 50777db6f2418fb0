// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/conformal.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "geometry/tangent_frame.hpp"

namespace delos {
namespace {

// Radii that differ by less (of the largest) count as equal: far below what doubles resolve in
// the coordinates of a mesh.
constexpr double kEqualRadii = 1e-12;
// Nodes of a quarter period. The series below converge like exp(-2 n c / b) at worst, so that
// bodies down to about 1:0.02 are resolved to rounding.
constexpr int kNodes = 1024;
// Rounding leaves a floor of about 1e-17 in the sine coefficients: what is below this is noise.
constexpr double kNegligible = 1e-16;
// What the last coefficients may hold; above it the series is not resolved.
constexpr double kUnresolved = 1e-13;
constexpr std::int64_t kMapGrain = 4096;  // points a task: about a millisecond

double square(double x) { return x * x; }

/// Modulus of elliptic functions as its square and the square of its complement, both to full
/// relative accuracy (each may be tiny).
struct Modulus {
  double k2, kp2;
};

/// Complete integral of the first kind: pi / (2 agm(1, k')) (Gauss).
double complete_f(const Modulus& m) {
  double a = 1.0, b = std::sqrt(m.kp2);
  constexpr int kSteps = 12;  // the difference squares every step: enough for k' > 1e-300
  for (int i = 0; i < kSteps; ++i) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return 0.5 * kPi / a;
}

/// Incomplete integral of the first kind, 0 <= phi <= pi/2, as Carlson's R_F by duplication
/// (Carlson 1995, doi:10.1007/BF02198293, Eq. 2.2).
double incomplete_f(double sin_phi, double cos_phi, const Modulus& m) {
  double x = square(cos_phi), y = x + m.kp2 * square(sin_phi), z = 1.0;
  constexpr int kSteps = 30;  // the spread falls by 4 a step
  for (int i = 0; i < kSteps; ++i) {
    const double lambda =
        std::sqrt(x) * std::sqrt(y) + std::sqrt(y) * std::sqrt(z) + std::sqrt(z) * std::sqrt(x);
    x = 0.25 * (x + lambda);
    y = 0.25 * (y + lambda);
    z = 0.25 * (z + lambda);
  }
  return sin_phi / std::sqrt((x + y + z) / 3.0);
}

/// Amplitude: the phi with incomplete_f(phi) = u, by descending means (Abramowitz & Stegun 16.4).
double amplitude(double u, const Modulus& m) {
  constexpr int kSteps = 12;
  std::array<double, kSteps + 1> a{}, c{};
  a[0] = 1.0;
  c[0] = std::sqrt(m.k2);
  double b = std::sqrt(m.kp2);
  int n = 0;
  double power = 1.0;
  while (n < kSteps && c[static_cast<std::size_t>(n)] > 1e-17) {
    const auto i = static_cast<std::size_t>(n);
    a[i + 1] = 0.5 * (a[i] + b);
    // (a - b) / 2 without cancellation: c_next = c^2 / (4 a_next)
    c[i + 1] = square(c[i]) / (4.0 * a[i + 1]);
    b = std::sqrt(a[i] * b);
    power *= 2.0;
    ++n;
  }
  double phi = power * a[static_cast<std::size_t>(n)] * u;
  for (; n > 0; --n) {
    const auto i = static_cast<std::size_t>(n);
    phi = 0.5 * (phi + elementary::asin(c[i] / a[i] * elementary::sin(phi)));
  }
  return phi;
}

/// The modulus whose K(k) / K(k') is the given ratio, through the nome q = exp(-pi K'/K) and
/// theta functions (Abramowitz & Stegun 16.38); of k and k' that of the larger nome's partner.
Modulus modulus_of_ratio(double ratio) {
  const double q = elementary::exp(-kPi * std::max(ratio, 1.0 / ratio));  // <= exp(-pi)
  const double q2 = q * q, q4 = q2 * q2;
  const double theta3 = 1.0 + 2.0 * (q + q4 + q4 * q4 * q);
  const double theta4 = 1.0 - 2.0 * (q - q4 + q4 * q4 * q);
  const double theta2 = 2.0 * (1.0 + q2 + q4 * q2 + q4 * q4 * q4);  // without q^(1/4)
  const double small = q * square(square(theta2 / theta3));
  const double large = square(square(theta4 / theta3));
  return ratio > 1.0 ? Modulus{large, small} : Modulus{small, large};
}

/// sum of coefficient[n] sin((n + 1) x) from sin x and cos x (Clenshaw).
double sine_series(const std::vector<double>& coefficient, double sin_x, double cos_x) {
  double b1 = 0.0, b2 = 0.0;
  for (std::size_t n = coefficient.size(); n-- > 0;) {
    const double b0 = coefficient[n] + 2.0 * cos_x * b1 - b2;
    b2 = b1;
    b1 = b0;
  }
  return b1 * sin_x;
}

/// cos(pi i / kNodes) for any i, from one table.
class CosineTable {
 public:
  CosineTable() : value_(2 * kNodes) {
    for (int i = 0; i < 2 * kNodes; ++i) {
      value_[static_cast<std::size_t>(i)] = elementary::cos(kPi * i / kNodes);
    }
  }
  double cos(std::int64_t i) const { return value_[static_cast<std::size_t>(i % (2 * kNodes))]; }
  double sin(std::int64_t i) const { return cos(i + 2 * kNodes - kNodes / 2); }

 private:
  std::vector<double> value_;
};

/// One isothermal coordinate: the integral of sqrt(offset + slope sin^2 phi) / sqrt(1 - k^2 sin^2
/// phi), as a function of u = F(phi) / K in [0, 1]: total * (u + series sin(n pi u)).
struct Isothermal {
  Modulus modulus;
  double quarter = 0.0;  // K
  double total = 0.0;
  std::vector<double> series;
};

/// In u the integrand is smooth and periodic, so that the trapezoidal rule converges
/// exponentially even where phi crowds (k near 1).
Isothermal integrate(const Modulus& modulus, double offset, double slope,
                     const CosineTable& table) {
  Isothermal result{modulus, complete_f(modulus), 0.0, std::vector<double>(kNodes - 1)};
  std::vector<double> value(kNodes + 1);
  for (int i = 0; i <= kNodes; ++i) {
    const double phi = i == kNodes ? 0.5 * kPi : amplitude(result.quarter * i / kNodes, modulus);
    value[static_cast<std::size_t>(i)] = std::sqrt(offset + slope * square(elementary::sin(phi)));
  }
  const auto cosine_coefficient = [&](std::int64_t n) {
    double sum = 0.5 * (value[0] + value[kNodes] * table.cos(n * kNodes));
    for (std::int64_t i = 1; i < kNodes; ++i) {
      sum += value[static_cast<std::size_t>(i)] * table.cos(n * i);
    }
    return sum / kNodes;
  };
  const double mean = cosine_coefficient(0);
  for (int n = 1; n < kNodes; ++n) {
    result.series[static_cast<std::size_t>(n - 1)] = 2.0 * cosine_coefficient(n) / (mean * kPi * n);
  }
  result.total = mean * result.quarter;
  return result;
}

/// Coefficients of image(phi) - phi = sum c_n sin(2 n phi), where both have the same share of
/// their isothermal quarter. Branch points of the two sides fall together because the moduli
/// match, which is why the series converges fast whatever the moduli are.
std::vector<double> match(const Isothermal& from, const Modulus& to, const CosineTable& table) {
  const double to_quarter = complete_f(to);
  std::vector<double> shift(kNodes, 0.0);  // at phi = i pi / (2 kNodes); zero at both ends
  for (int i = 1; i < kNodes; ++i) {
    const double phi = 0.5 * kPi * i / kNodes;
    const elementary::SinCos p = elementary::sincos(phi);
    const double u = incomplete_f(p.sin, p.cos, from.modulus) / from.quarter;
    const elementary::SinCos x = elementary::sincos(kPi * u);
    const double share = u + sine_series(from.series, x.sin, x.cos);
    shift[static_cast<std::size_t>(i)] = amplitude(share * to_quarter, to) - phi;
  }
  std::vector<double> coefficient(kNodes - 1);
  double largest_of_last = 0.0;
  for (std::int64_t n = 1; n < kNodes; ++n) {
    double sum = 0.0;
    for (std::int64_t i = 1; i < kNodes; ++i) {
      sum += shift[static_cast<std::size_t>(i)] * table.sin(n * i);
    }
    coefficient[static_cast<std::size_t>(n - 1)] = 2.0 * sum / kNodes;
    if (n > kNodes - kNodes / 8) largest_of_last = std::max(largest_of_last, std::abs(sum));
  }
  DELOS_CHECK(2.0 * largest_of_last / kNodes < kUnresolved, ErrorKind::config,
              "the body is too flat for its conformal map to the sphere (remainder ",
              largest_of_last, "): formats that know only spheres can't hold it. Write UGRID.");
  while (!coefficient.empty() && std::abs(coefficient.back()) < kNegligible) {
    coefficient.pop_back();
  }
  return coefficient;
}

/// Turns the unit vector (cos, sin) of an angle into that of its image.
elementary::SinCos map_angle(const std::vector<double>& coefficient, double sin, double cos) {
  const double shift = sine_series(coefficient, 2.0 * sin * cos, (cos - sin) * (cos + sin));
  const elementary::SinCos turn = elementary::sincos(shift);
  return {sin * turn.cos + cos * turn.sin, cos * turn.cos - sin * turn.sin};
}

elementary::SinCos normalised(double sin, double cos) {
  const double length = std::sqrt(sin * sin + cos * cos);
  return {sin / length, cos / length};
}

}  // namespace

SphereMap::SphereMap(const Ellipsoid& surface, SphereMapKind kind)
    : surface_(surface), kind_(kind) {
  choose_method();
  if (method_ == Method::jacobi) prepare_jacobi();
}

void SphereMap::choose_method() {
  const Vec3& r = surface_.radii();
  const bool symmetric_around_z = std::abs(r[0] - r[1]) <= kEqualRadii;
  constexpr double kNearlySpherical = 0.01;
  if (kind_ == SphereMapKind::automatic) {
    const bool nearly = symmetric_around_z && std::abs(r[2] - r[0]) < kNearlySpherical * r[0];
    kind_ = nearly ? SphereMapKind::lon_lat : SphereMapKind::conformal;
  }
  std::stable_sort(axis_.begin(), axis_.end(), [&](int i, int j) { return r[i] > r[j]; });
  const double a = r[axis_[0]], b = r[axis_[1]], c = r[axis_[2]];
  if (kind_ == SphereMapKind::lon_lat) {
    DELOS_CHECK(symmetric_around_z, ErrorKind::config, "the body with radii ", r[0], ", ", r[1],
                ", ", r[2],
                " (of the largest) has no symmetry axis along z, so it can't be taken "
                "to a sphere by longitude and latitude. Use the conformal map.");
    method_ = surface_.is_sphere() ? Method::identity : Method::lon_lat;
  } else if (a - c <= kEqualRadii) {
    method_ = Method::identity;
  } else if (a - b <= kEqualRadii) {
    method_ = Method::conformal_latitude;
  } else if (b - c <= kEqualRadii) {
    std::swap(axis_[0], axis_[2]);
    method_ = Method::conformal_latitude;
  } else {
    method_ = Method::jacobi;
  }
}

void SphereMap::prepare_jacobi() {
  const Vec3& r = surface_.radii();
  const double a = r[axis_[0]], b = r[axis_[1]], c = r[axis_[2]];
  const double ab = (a - b) * (a + b), bc = (b - c) * (b + c), ac = (a - c) * (a + c);
  k2_ = bc / ac;
  kp2_ = ab / ac;
  const CosineTable table;
  const Isothermal beta = integrate({k2_, kp2_}, c * c, bc, table);
  const Isothermal omega = integrate({kp2_, k2_}, a * a, -ab, table);
  const Modulus sphere = modulus_of_ratio(beta.total / omega.total);
  sphere_k2_ = sphere.k2;
  sphere_kp2_ = sphere.kp2;
  beta_.coefficient = match(beta, sphere, table);
  omega_.coefficient = match(omega, {sphere.kp2, sphere.k2}, table);
}

Ellipsoid SphereMap::sphere() const {
  if (surface_.is_sphere()) return surface_;
  const double radius_m = surface_.scale_m() * std::sqrt(surface_.area() / (4.0 * kPi));
  return {Vec3(radius_m, radius_m, radius_m), surface_.centre_m()};
}

Vec3 SphereMap::operator()(const Vec3& p) const {
  switch (method_) {
    case Method::identity:
      return p.normalized();
    case Method::lon_lat:
      return surface_.normal(p);
    case Method::conformal_latitude:
      return map_conformal_latitude(p);
    case Method::jacobi:
      break;
  }
  return map_jacobi(p);
}

// Karney 2011, doi:10.1007/s00190-011-0445-3, Eq. 7: tan chi = tan phi sqrt(1 + s^2)
// - s / cos phi, times cos phi so that the poles are no special case.
Vec3 SphereMap::map_conformal_latitude(const Vec3& p) const {
  const Vec3& r = surface_.radii();
  const Vec3 normal = surface_.normal(p);
  const double x = normal[axis_[0]], y = normal[axis_[1]], sin_phi = normal[axis_[2]];
  const double e2 = 1.0 - square(r[axis_[2]] / r[axis_[0]]);
  const double e = std::sqrt(std::abs(e2));
  const double growth =  // exp(e artanh(e sin phi)); the prolate body has an imaginary e
      e2 > 0.0
          ? elementary::exp(0.5 * e * elementary::log((1.0 + e * sin_phi) / (1.0 - e * sin_phi)))
          : elementary::exp(-e * elementary::atan2(e * sin_phi, 1.0));
  const double s = 0.5 * (growth - 1.0 / growth);
  Vec3 image;
  image[axis_[0]] = x;
  image[axis_[1]] = y;
  image[axis_[2]] = sin_phi * std::sqrt(1.0 + s * s) - s;
  return image.normalized();
}

// Karney's form of the coordinates, with p / r on the unit sphere:
//   x = cos(omega) sqrt(1 - k^2 sin^2 beta), y = cos(beta) sin(omega),
//   z = sin(beta) sqrt(1 - k'^2 cos^2 omega)
// inverted in the first octant and without cancellation; the sphere's are the same with its own
// modulus.
Vec3 SphereMap::map_jacobi(const Vec3& p) const {
  const Vec3 u = p.cwiseQuotient(surface_.radii()).normalized();
  const double x = std::abs(u[axis_[0]]), y = std::abs(u[axis_[1]]), z = std::abs(u[axis_[2]]);
  const double g = k2_ * x * x + (k2_ - kp2_) * y * y - kp2_ * z * z;
  const double h = std::sqrt(g * g + 4.0 * k2_ * kp2_ * y * y);
  double cos_beta = 0.0, sin_omega = 0.0;  // at the umbilics
  if (g >= 0.0 && h > 0.0) {
    cos_beta = std::sqrt(0.5 * (h + g) / k2_);
    sin_omega = y / cos_beta;
  } else if (h > 0.0) {
    sin_omega = std::sqrt(0.5 * (h - g) / kp2_);
    cos_beta = y / sin_omega;
  }
  const double sin_beta = z / std::sqrt(k2_ + kp2_ * square(sin_omega));
  const double cos_omega = x / std::sqrt(kp2_ + k2_ * square(cos_beta));
  const elementary::SinCos beta = normalised(sin_beta, cos_beta);
  const elementary::SinCos omega = normalised(cos_omega, sin_omega);  // from 90 degrees
  const elementary::SinCos b = map_angle(beta_.coefficient, beta.sin, beta.cos);
  const elementary::SinCos w = map_angle(omega_.coefficient, omega.sin, omega.cos);
  Vec3 image;
  image[axis_[0]] =
      std::copysign(w.sin * std::sqrt(sphere_kp2_ + sphere_k2_ * square(b.cos)), u[axis_[0]]);
  image[axis_[1]] = std::copysign(b.cos * w.cos, u[axis_[1]]);
  image[axis_[2]] =
      std::copysign(b.sin * std::sqrt(sphere_k2_ + sphere_kp2_ * square(w.cos)), u[axis_[2]]);
  return image.normalized();
}

double SphereMap::stretch(const Vec3& p) const {
  if (method_ == Method::identity) return 1.0;
  constexpr double kStep = 1e-4;  // error: step squared
  const TangentFrame plane(surface_.normal(p));
  const auto derivative = [&](const Vec3& direction) -> Vec3 {
    const Vec3 ahead = surface_.project(p + kStep * direction);
    const Vec3 behind = surface_.project(p - kStep * direction);
    return ((*this)(ahead) - (*this)(behind)) / (2.0 * kStep);
  };
  return std::sqrt(derivative(plane.right).cross(derivative(plane.ahead)).norm());
}

std::vector<Vec3> map_to_sphere(parallel::Executor& exec, const SphereMap& map,
                                std::span<const Vec3> points) {
  std::vector<Vec3> image(points.size());
  parallel::for_index(exec, static_cast<std::int64_t>(points.size()), kMapGrain,
                      [&](std::int64_t i) {
                        const auto at = static_cast<std::size_t>(i);
                        image[at] = map(points[at]);
                      });
  return image;
}

}  // namespace delos
