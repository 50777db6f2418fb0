// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/ellipsoid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "geometry/expansion.hpp"

namespace delos {
namespace {

/// Gauss-Legendre on [0, 1], 8 points: nodes 1/2 +- offset.
struct GaussNode {
  double offset, weight;
};
constexpr std::array<GaussNode, 4> kGauss = {{
    {0.09171732124782490247, 0.18134189168918099148},
    {0.26276620495816449291, 0.15685332293894364367},
    {0.39833323870681336980, 0.11119051722668723527},
    {0.48014492824876811584, 0.050614268145188129576},
}};

/// Integral of f over [low, high].
template <class Function>
double gauss(double low, double high, Function&& f) {
  const double width = high - low;
  const double middle = low + 0.5 * width;
  double sum = 0;
  for (const GaussNode& node : kGauss) {
    sum += node.weight * (f(middle - node.offset * width) + f(middle + node.offset * width));
  }
  return sum * width;
}

/// Symmetric rule of degree 8 on the triangle with 16 points (Dunavant 1985,
/// doi:10.1002/nme.1620210612), the published digits polished to double precision.
struct TriangleNode {
  double weight, a, b;  ///< barycentric coordinates a, b, 1 - a - b in every order
};
constexpr double kCentroidWeight = 0.14431560767778716825;
constexpr std::array<TriangleNode, 3> kTriples = {{
    {0.095091634267284624794, 0.45929258829272315603, 0.45929258829272315603},
    {0.10321737053471825028, 0.17056930775176020662, 0.17056930775176020662},
    {0.032458497623198080311, 0.050547228317030975458, 0.050547228317030975458},
}};
constexpr TriangleNode kSextuple = {0.027230314174434994265, 0.26311282963463811342,
                                    0.72849239295540428124};

/// Mean of f over the flat triangle.
template <class Function>
double triangle_mean(const Vec3& a, const Vec3& b, const Vec3& c, Function&& f) {
  double sum = kCentroidWeight * f((a + b + c) / 3);
  for (const TriangleNode& node : kTriples) {
    const double rest = (1 - node.a) - node.b;
    sum += node.weight * (f(node.a * (a + b) + rest * c) + f(node.a * (b + c) + rest * a) +
                          f(node.a * (c + a) + rest * b));
  }
  const double p = kSextuple.a;
  const double q = kSextuple.b;
  const double r = (1 - p) - q;
  sum += kSextuple.weight *
         ((f(p * a + q * b + r * c) + f(p * b + q * c + r * a) + f(p * c + q * a + r * b)) +
          (f(p * a + q * c + r * b) + f(p * b + q * a + r * c) + f(p * c + q * b + r * a)));
  return sum;
}

/// A unit vector at right angles to p: for arcs between antipodes, which have no plane.
Vec3 any_perpendicular(const Vec3& p) {
  int smallest = 0;
  p.cwiseAbs().minCoeff(&smallest);
  return p.cross(Vec3(Vec3::Unit(smallest))).normalized();
}

/// Direction half way between a and b.
Vec3 middle(const Vec3& a, const Vec3& b) {
  const Vec3 sum = a + b;
  return sum.squaredNorm() > 1e-24 ? sum : any_perpendicular(a);
}

}  // namespace

Ellipsoid::Ellipsoid(const Vec3& radii_m, const Vec3& centre_m)
    : centre_m_(centre_m), scale_m_(radii_m.maxCoeff()) {
  for (int axis = 0; axis < 3; ++axis) {
    DELOS_CHECK(std::isfinite(radii_m[axis]) && radii_m[axis] > 0, ErrorKind::config,
                "surface radius ", axis + 1, " is ", radii_m[axis],
                " m: radii must be finite and > 0 m.");
    DELOS_CHECK(std::isfinite(centre_m[axis]), ErrorKind::config, "surface centre coordinate ",
                axis + 1, " is ", centre_m[axis], " m: it must be finite.");
  }
  radii_ = radii_m / scale_m_;
  for (int axis = 0; axis < 3; ++axis) inverse_square_[axis] = 1 / (radii_[axis] * radii_[axis]);
  is_sphere_ = radii_ == Vec3(1, 1, 1);
}

Ellipsoid Ellipsoid::wgs84() {
  constexpr double kSemiMajor = 6378137.0;
  constexpr double kSemiMinor = kSemiMajor * (1 - 1 / 298.257223563);
  return {Vec3(kSemiMajor, kSemiMajor, kSemiMinor), Vec3(0, 0, 0)};
}

LonLat Ellipsoid::lon_lat(const Vec3& p, LatitudeKind kind) const {
  Vec3 q = p;
  if (kind == LatitudeKind::geodetic) q = p.cwiseProduct(inverse_square_);
  if (kind == LatitudeKind::parametric) q = p.cwiseQuotient(radii_);
  return {elementary::atan2(q.y(), q.x()),
          elementary::atan2(q.z(), std::sqrt(q.x() * q.x() + q.y() * q.y()))};
}

Vec3 Ellipsoid::point(const LonLat& lon_lat, LatitudeKind kind) const {
  return point(elementary::sincos(lon_lat.lon_rad), elementary::sincos(lon_lat.lat_rad), kind);
}

Vec3 Ellipsoid::point(const elementary::SinCos& lon, const elementary::SinCos& lat,
                      LatitudeKind kind) const {
  const Vec3 direction(lat.cos * lon.cos, lat.cos * lon.sin, lat.sin);
  switch (kind) {
    case LatitudeKind::geodetic:
      return project(direction.cwiseQuotient(inverse_square_));
    case LatitudeKind::parametric:
      return project(direction.cwiseProduct(radii_));
    default:
      return project(direction);
  }
}

Vec3 Ellipsoid::ball_centre(const Vec3& a, const Vec3& b, const Vec3& c) const {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 n = u.cross(v);
  if (is_sphere_) return n.normalized();
  const double n_square = n.squaredNorm();
  const Vec3 circumcentre =
      a + (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2 * n_square);
  // Where circumcentre + t n meets the surface outside: the larger root of A t^2 + 2 B t + C = 0.
  const Vec3 axis = n / std::sqrt(n_square);
  const Vec3 weighted = axis.cwiseProduct(inverse_square_);
  const double qa = weighted.dot(axis);
  const double qb = weighted.dot(circumcentre);
  const double qc = circumcentre.cwiseProduct(inverse_square_).dot(circumcentre) - 1;
  const double discriminant = qb * qb - qa * qc;
  // A line that misses the surface belongs to a triangle as large as the body; its nearest
  // direction stands in.
  if (!(discriminant >= 0)) return project(n);
  const double root = std::sqrt(discriminant);
  const double t = qb > 0 ? -qc / (qb + root) : (root - qb) / qa;
  return project(circumcentre + t * axis);
}

double Ellipsoid::arc_length(const Vec3& a, const Vec3& b) const {
  const Vec3 chord = b - a;
  const double chord_square = chord.squaredNorm();
  if (is_sphere_) {
    if (chord_square < 1) return 2 * elementary::asin(0.5 * std::sqrt(chord_square));
    return elementary::atan2(a.cross(b).norm(), a.dot(b));
  }
  // Longer arcs are halved until eight Gauss points leave less than rounding.
  constexpr double kLongestChord = 0.25;
  const double smallest = radii_.minCoeff();
  const double longest = kLongestChord * smallest;
  if (chord_square > longest * longest) {
    const Vec3 m = project(middle(a, b));
    return arc_length(a, m) + arc_length(m, b);
  }
  // x(s) = d / sqrt(q) with d = a + s (b - a), q = d.W d, so |x'| = |(b - a) q - d (d.W (b - a))|
  // / q^(3/2).
  return gauss(0, 1, [&](double s) {
    const Vec3 d = a + s * chord;
    const Vec3 w = d.cwiseProduct(inverse_square_);
    const double q = w.dot(d);
    return (chord * q - d * w.dot(chord)).norm() / (q * std::sqrt(q));
  });
}

double Ellipsoid::triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) const {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const double det = a.dot(u.cross(v));
  if (is_sphere_) {
    // Van Oosterom & Strackee 1983, doi:10.1109/TBME.1983.325207; the determinant of differences
    // keeps its relative accuracy for small triangles.
    return 2 * elementary::atan2(det, 1 + (a.dot(b) + b.dot(c) + c.dot(a)));
  }
  // Larger triangles are quartered until the rule of degree 8 leaves less than 1e-14 of them.
  const double longest = 0.06 * radii_.minCoeff();
  const double longest_square = longest * longest;
  if (u.squaredNorm() > longest_square || v.squaredNorm() > longest_square ||
      (c - b).squaredNorm() > longest_square) {
    const Vec3 ab = project(middle(a, b));
    const Vec3 bc = project(middle(b, c));
    const Vec3 ca = project(middle(c, a));
    return (triangle_area(a, ab, ca) + triangle_area(b, bc, ab)) +
           (triangle_area(c, ca, bc) + triangle_area(ab, bc, ca));
  }
  // Element of solid angle of the flat triangle: (N.y) / |y|^3 dS; surface over solid angle:
  // rho^2 / cos(normal, radius). With q = y.W y the product is |W y| / q^2 times N.y dS.
  const double mean = triangle_mean(a, b, c, [&](const Vec3& y) {
    const Vec3 w = y.cwiseProduct(inverse_square_);
    const double q = w.dot(y);
    return w.norm() / (q * q);
  });
  return 0.5 * det * mean;
}

double Ellipsoid::area() const {
  if (is_sphere_) return 4 * kPi;
  // x = r1 c cos(l), y = r2 c sin(l), z = r3 s: dA = sqrt((r2 r3 c cos l)^2 + (r1 r3 c sin l)^2 +
  // (r1 r2 s)^2) ds dl with c^2 = 1 - s^2. The trapezoid rule in l converges geometrically; s
  // takes composite Gauss, for flat bodies. One octant, eight times.
  constexpr int kMeridians = 128;
  constexpr int kPanels = 64;
  const double x_square = radii_.y() * radii_.z() * radii_.y() * radii_.z();
  const double y_square = radii_.x() * radii_.z() * radii_.x() * radii_.z();
  const double z_square = radii_.x() * radii_.y() * radii_.x() * radii_.y();
  expansion::Two total{0, 0};
  for (int meridian = 0; meridian <= kMeridians; ++meridian) {
    const auto lon = elementary::sincos(0.5 * kPi * meridian / kMeridians);
    const double equator = x_square * lon.cos * lon.cos + y_square * lon.sin * lon.sin;
    const double weight = meridian == 0 || meridian == kMeridians ? 0.5 : 1.0;
    for (int panel = 0; panel < kPanels; ++panel) {
      const double strip =
          gauss(panel / double{kPanels}, (panel + 1) / double{kPanels},
                [&](double s) { return std::sqrt(equator * (1 - s * s) + z_square * s * s); });
      total = expansion::add(total, {weight * strip, 0});
    }
  }
  return 8 * total.hi * (0.5 * kPi / kMeridians);
}

}  // namespace delos
