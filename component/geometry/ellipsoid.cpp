// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/ellipsoid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "geometry/expansion.hpp"
#include "geometry/triangle_rule.hpp"

namespace delos {
namespace {

/// Gauss-Legendre on [0, 1]: nodes 1/2 +- offset.
struct GaussNode {
  double offset, weight;
};
constexpr std::array<GaussNode, 2> kGauss4 = {{
    {0.16999052179242813140, 0.32607257743127307131},
    {0.43056815579702628761, 0.17392742256872692869},
}};
constexpr std::array<GaussNode, 4> kGauss8 = {{
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
  for (const GaussNode& node : kGauss8) {
    sum += node.weight * (f(middle - node.offset * width) + f(middle + node.offset * width));
  }
  return sum * width;
}

/// A vector by two quadratic forms, W = diag(1 / r^2).
struct Forms {
  double q;  ///< x.W x, 1 on the surface
  double p;  ///< |W x|^2
};

Forms forms_of(const Vec3& x, const Vec3& w) {
  const Vec3 wx = x.cwiseProduct(w);
  return {wx.dot(x), wx.dot(wx)};
}

/// 1 / (1 - s)^2: in general, and for |s| < 4e-5, where the terms left out are below 2e-17.
struct InverseSquare {
  double operator()(double s) const { return 1 / ((1 - s) * (1 - s)); }
};
struct SmallInverseSquare {
  double operator()(double s) const { return 1 + s * (2 + s * (3 + s * 4)); }
};

/// |W y| / (y.W y)^2, averaged over the flat triangle of three surface points: element of area over
/// element of the cone to the centre. On the triangle both forms are quadratic: the sum of the
/// corners' by the barycentric coordinates, less the sides' by their products.
template <class Inverse, std::size_t kNodes>
double mean_stretch(const TriangleRule<kNodes>& rule, const std::array<double, 3>& corner_p,
                    const std::array<Forms, 3>& side) {
  std::array<double, kNodes> value;
  const auto& [la, lb, lc] = rule.coordinate;
  const auto& [lbc, lca, lab] = rule.product;
  for (std::size_t i = 0; i < kNodes; ++i) {
    const double below = lbc[i] * side[0].q + lca[i] * side[1].q + lab[i] * side[2].q;
    const double p = (la[i] * corner_p[0] + lb[i] * corner_p[1] + lc[i] * corner_p[2]) -
                     (lbc[i] * side[0].p + lca[i] * side[1].p + lab[i] * side[2].p);
    value[i] = rule.weight[i] * (std::sqrt(p) * Inverse()(below));
  }
  double sum = 0;
  for (const double v : value) sum += v;
  return sum;
}

/// Six triangles around a point, as arrays over the triangles: their corners are the point, ring
/// point k and ring point k + 1. Spokes run from the point to the ring (the first once more behind
/// the last), rims along the ring.
struct Fan {
  std::array<double, 7> ring_p, spoke_q, spoke_p;
  std::array<double, 6> rim_q, rim_p, det;
  double centre_p, largest_square;
};

Fan fan_of(const Vec3& centre, const std::array<Vec3, 6>& ring, const Vec3& w) {
  Fan fan;
  fan.centre_p = forms_of(centre, w).p;
  fan.largest_square = 0;
  std::array<Vec3, 7> spoke;
  for (std::size_t k = 0; k < 7; ++k) {
    const Vec3& point = ring[k % 6];
    spoke[k] = point - centre;
    const Forms forms = forms_of(spoke[k], w);
    fan.spoke_q[k] = forms.q;
    fan.spoke_p[k] = forms.p;
    fan.ring_p[k] = forms_of(point, w).p;
    fan.largest_square = std::max(fan.largest_square, spoke[k].squaredNorm());
  }
  for (std::size_t k = 0; k < 6; ++k) {
    const Vec3 rim = ring[(k + 1) % 6] - ring[k];
    const Forms forms = forms_of(rim, w);
    fan.rim_q[k] = forms.q;
    fan.rim_p[k] = forms.p;
    fan.det[k] = centre.dot(spoke[k].cross(spoke[k + 1]));
    fan.largest_square = std::max(fan.largest_square, rim.squaredNorm());
  }
  return fan;
}

/// mean_stretch of every triangle of a small fan, times its cone.
std::array<double, 6> small_fan_areas(const Fan& fan) {
  std::array<double, 6> mean{};
  for (std::size_t i = 0; i < kDegree5.n_nodes; ++i) {
    const double la = kDegree5.coordinate[0][i], lb = kDegree5.coordinate[1][i],
                 lc = kDegree5.coordinate[2][i];
    const double lbc = kDegree5.product[0][i], lca = kDegree5.product[1][i],
                 lab = kDegree5.product[2][i];
    for (std::size_t k = 0; k < 6; ++k) {
      const double below = lbc * fan.rim_q[k] + lca * fan.spoke_q[k + 1] + lab * fan.spoke_q[k];
      const double p = (la * fan.centre_p + lb * fan.ring_p[k] + lc * fan.ring_p[k + 1]) -
                       (lbc * fan.rim_p[k] + lca * fan.spoke_p[k + 1] + lab * fan.spoke_p[k]);
      mean[k] += kDegree5.weight[i] * (std::sqrt(p) * SmallInverseSquare()(below));
    }
  }
  for (std::size_t k = 0; k < 6; ++k) mean[k] *= 0.5 * fan.det[k];
  return mean;
}

/// Length of the central section from a to b, surface points, by the Gauss rule on the chord. With
/// d = m + u t (m its middle, t = b - a, |u| <= 1/2) the point is d / sqrt(q), q = d.W d, and its
/// speed |t q - d (d.W t)| / q^(3/2), where d.W t = u t.W t because q is 1 at both ends.
template <std::size_t kPairs>
double central_section(const Vec3& a, const Vec3& b, const Vec3& w,
                       const std::array<GaussNode, kPairs>& rule) {
  const Vec3 t = b - a;
  const Vec3 m = 0.5 * (a + b);
  const double tt = t.squaredNorm(), mm = m.squaredNorm(), mt = m.dot(t);
  const double bend = forms_of(t, w).q;
  double sum = 0;
  for (const GaussNode& node : rule) {
    const double u = node.offset;
    const double q = 1 - bend * (0.25 - u * u);
    const double fall = bend * u;
    // |t q - fall d|^2, its part that is the same at u and -u and that which changes sign.
    const double even = tt * (q * q) - 2 * q * fall * (u * tt) + fall * fall * (mm + u * u * tt);
    const double odd = 2 * fall * mt * (fall * u - q);
    const double cube = 1 / (q * q * q);
    sum += node.weight * (std::sqrt((even + odd) * cube) + std::sqrt((even - odd) * cube));
  }
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

Vec3 Ellipsoid::direction(const Vec3& p, LatitudeKind kind) const {
  if (kind == LatitudeKind::geodetic) return p.cwiseProduct(inverse_square_);
  if (kind == LatitudeKind::parametric) return p.cwiseQuotient(radii_);
  return p;
}

LonLat Ellipsoid::lon_lat(const Vec3& p, LatitudeKind kind) const {
  const Vec3 q = direction(p, kind);
  return {elementary::atan2(q.y(), q.x()),
          elementary::atan2(q.z(), std::sqrt(q.x() * q.x() + q.y() * q.y()))};
}

void Ellipsoid::lon_lat(std::span<const Vec3> points, LatitudeKind kind,
                        std::span<LonLat> out) const {
  constexpr std::size_t kBatch = 128;
  std::array<double, kBatch> x, y, z, angle;
  for (std::size_t begin = 0; begin < points.size(); begin += kBatch) {
    const std::size_t n = std::min(kBatch, points.size() - begin);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 q = direction(points[begin + i], kind);
      x[i] = q.x();
      y[i] = q.y();
      z[i] = q.z();
    }
    elementary::atan2({y.data(), n}, {x.data(), n}, {angle.data(), n});
    for (std::size_t i = 0; i < n; ++i) out[begin + i].lon_rad = angle[i];
    for (std::size_t i = 0; i < n; ++i) x[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
    elementary::atan2({z.data(), n}, {x.data(), n}, {angle.data(), n});
    for (std::size_t i = 0; i < n; ++i) out[begin + i].lat_rad = angle[i];
  }
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

Vec3 Ellipsoid::ellipsoidal_ball_centre(const Vec3& a, const Vec3& b, const Vec3& c) const {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 n = u.cross(v);
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
    // 2 asin(chord / 2); of this series the terms left out are below 2^-55 of the chord.
    constexpr double kShortSquare = 0x1p-8;
    if (chord_square < kShortSquare) {
      const double tail =
          1.0 / 24 +
          chord_square * (3.0 / 640 + chord_square * (5.0 / 7168 + chord_square * (35.0 / 294912)));
      const double length = std::sqrt(chord_square);
      return length + length * chord_square * tail;
    }
    if (chord_square < 1) return 2 * elementary::asin(0.5 * std::sqrt(chord_square));
    return elementary::atan2(a.cross(b).norm(), a.dot(b));
  }
  // Longer arcs are halved until eight Gauss points leave less than rounding; four do for short
  // ones (error below 2e-16 of the arc on bodies down to 1 : 0.6).
  constexpr double kLongestChord = 0.25, kShortChord = 0.03;
  const double smallest = radii_.minCoeff();
  const double longest = kLongestChord * smallest, is_short = kShortChord * smallest;
  if (chord_square > longest * longest) {
    const Vec3 m = project(middle(a, b));
    return arc_length(a, m) + arc_length(m, b);
  }
  return chord_square < is_short * is_short ? central_section(a, b, inverse_square_, kGauss4)
                                            : central_section(a, b, inverse_square_, kGauss8);
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
  // Larger triangles are quartered until the rule of degree 8 leaves less than 1e-14 of them; that
  // of degree 5 leaves less than 1e-15 (1e-14 on a body of 1 : 0.3) of the small ones.
  constexpr double kLongestSide = 0.06;
  const double longest = kLongestSide * radii_.minCoeff();
  const Vec3 w = c - b;
  const double size = std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()});
  if (size > longest * longest) {
    const Vec3 ab = project(middle(a, b));
    const Vec3 bc = project(middle(b, c));
    const Vec3 ca = project(middle(c, a));
    return (triangle_area(a, ab, ca) + triangle_area(b, bc, ab)) +
           (triangle_area(c, ca, bc) + triangle_area(ab, bc, ca));
  }
  // Element of solid angle of the flat triangle: (N.y) / |y|^3 dS; surface over solid angle:
  // rho^2 / cos(normal, radius). With q = y.W y the product is |W y| / q^2 times N.y dS.
  const std::array<double, 3> corner_p = {forms_of(a, inverse_square_).p,
                                          forms_of(b, inverse_square_).p,
                                          forms_of(c, inverse_square_).p};
  const std::array<Forms, 3> side = {forms_of(w, inverse_square_), forms_of(v, inverse_square_),
                                     forms_of(u, inverse_square_)};
  const double mean = is_small(size) ? mean_stretch<SmallInverseSquare>(kDegree5, corner_p, side)
                                     : mean_stretch<InverseSquare>(kDegree8, corner_p, side);
  return 0.5 * det * mean;
}

bool Ellipsoid::is_small(double side_square) const {
  constexpr double kSmallSide = 0.01;
  const double longest = kSmallSide * radii_.minCoeff();
  return side_square < longest * longest;
}

std::array<double, 6> Ellipsoid::fan_areas(const Vec3& centre,
                                           const std::array<Vec3, 6>& ring) const {
  const Fan fan = fan_of(centre, ring, inverse_square_);
  if (!is_sphere_ && is_small(fan.largest_square)) return small_fan_areas(fan);
  std::array<double, 6> areas;
  for (std::size_t k = 0; k < 6; ++k) {
    areas[k] = triangle_area(centre, ring[k], ring[(k + 1) % 6]);
  }
  return areas;
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
