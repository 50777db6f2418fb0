// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane_area.hpp"

#include <cmath>

#include "geometry/triangle_rule.hpp"

namespace delos {

PlaneArea::PlaneArea(const Ellipsoid& surface, const Vec3& origin, const Vec3& east,
                     const Vec3& north) {
  const Vec3& w = surface.inverse_square();
  const Vec3 wo = origin.cwiseProduct(w), we = east.cwiseProduct(w), wn = north.cwiseProduct(w);
  square_ = {origin.dot(wo), 2 * origin.dot(we), 2 * origin.dot(wn),
             east.dot(we),   2 * east.dot(wn),   north.dot(wn)};
  slope_square_ = {wo.dot(wo), 2 * wo.dot(we), 2 * wo.dot(wn),
                   we.dot(we), 2 * we.dot(wn), wn.dot(wn)};
  half_det_ = 0.5 * origin.dot(east.cross(north));
  // On the sphere; a flatter body bends more within the same angle.
  constexpr double kReach = 0.01;
  reach_ = kReach * surface.radii().minCoeff() / surface.radii().maxCoeff();
}

double PlaneArea::triangle(const std::array<double, 2>& a, const std::array<double, 2>& u,
                           const std::array<double, 2>& v) const {
  constexpr auto& kRule = kDegree5;
  std::array<double, kRule.n_nodes> value;
  for (std::size_t i = 0; i < kRule.n_nodes; ++i) {
    const double s = kRule.coordinate[1][i], t = kRule.coordinate[2][i];
    const double x = a[0] + (s * u[0] + t * v[0]), y = a[1] + (s * u[1] + t * v[1]);
    const double square = square_(x, y);
    value[i] = kRule.weight[i] * (std::sqrt(slope_square_(x, y)) / (square * square));
  }
  double sum = 0;
  for (const double one : value) sum += one;
  return half_det_ * (u[0] * v[1] - u[1] * v[0]) * sum;
}

}  // namespace delos
