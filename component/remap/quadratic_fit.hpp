// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Value of scattered data at a point, by a quadratic.
#include <Eigen/Cholesky>
#include <cmath>
#include <span>
#include <vector>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "core/types.hpp"
#include "geometry/point_order.hpp"
#include "geometry/tangent_frame.hpp"
#include "remap/walk.hpp"

namespace delos::remap {

/// Points nearer than this (radii) are the same one.
inline constexpr double kSamePoint = 1e-15;

inline bool is_same_point(const Vec3& a, const Vec3& b) {
  return (a - b).cwiseAbs().maxCoeff() <= kSamePoint;
}

/// Data [n] at surface points [n], scaled.
struct Scattered {
  std::span<const Vec3> places;
  std::span<const double> values;
};

/// Value at p of the quadratic in p's tangent plane that fits the data of `ids` best, near ones
/// most. `reference` is a value among them, so that constants come out to the last bit.
inline double quadratic_fit(const Scattered& data, std::span<const Index> ids, const Vec3& p,
                            double reference) {
  using Six = Eigen::Matrix<double, 6, 1>;
  const TangentFrame plane(p.normalized());
  double square = 0.0;
  for (const Index id : ids) square += (data.places[at(id)] - p).squaredNorm();
  square /= static_cast<double>(ids.size());
  const double scale = 1.0 / std::sqrt(square);
  Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
  Six right = Six::Zero();
  for (const Index id : ids) {
    const Vec3 d = data.places[at(id)] - p;
    const double x = scale * d.dot(plane.right), y = scale * d.dot(plane.ahead);
    const double weight = 1.0 / (0.1 + (x * x + y * y));
    Six row;
    row << 1.0, x, y, x * x, x * y, y * y;
    matrix += weight * row * row.transpose();
    right += weight * (data.values[at(id)] - reference) * row;
  }
  // Few points (the coarsest grids) leave the curvature open; then it is small.
  constexpr double kSmall = 1e-12;
  for (int k = 3; k < 6; ++k) matrix(k, k) += kSmall;
  return reference + matrix.ldlt().solve(right)[0];
}

/// Points along the curve a task: 1 ms of fits.
inline constexpr std::int64_t kFitBlock = 512;

/// value(cell, p, ids) at each of the surface points, in their order: `cell` holds p, `ids` is
/// scratch.
template <class Value>
Array<double> fit_at_points(parallel::Executor& exec, const Tiling& cells,
                            std::span<const Vec3> points, Value&& value) {
  const std::vector<Index> order = hilbert_order(exec, points);
  Array<double> result(points.size());
  const auto n = static_cast<std::int64_t>(points.size());
  parallel::for_range(exec, n, kFitBlock, [&](std::int64_t begin, std::int64_t end) {
    std::vector<Index> ids;
    Index here = start_near(cells, points[at(order[at(begin)])]);
    for (std::int64_t k = begin; k < end; ++k) {
      const Vec3& p = points[at(order[at(k)])];
      here = walk(cells, p, here);
      result[at(order[at(k)])] = value(here, p, ids);
    }
  });
  return result;
}

}  // namespace delos::remap
