// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/point_order.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/hash.hpp"

using namespace delos;

namespace {

std::vector<Vec3> random_points(std::size_t n) {
  std::vector<Vec3> points;
  for (std::uint64_t i = 0; points.size() < n; ++i) {
    const Vec3 p(2 * uniform01(1, i) - 1, 2 * uniform01(2, i) - 1, 2 * uniform01(3, i) - 1);
    if (p.squaredNorm() < 1 && p.squaredNorm() > 0.01) points.push_back(p.normalized());
  }
  return points;
}

}  // namespace

TEST_CASE("Hilbert order is a permutation sorted by key, then by index, for any thread count") {
  std::vector<Vec3> points = random_points(50000);
  points.insert(points.end(), points.begin(), points.begin() + 1000);  // equal keys
  parallel::Executor one(1);
  parallel::Executor many(5);
  const std::vector<Index> order = hilbert_order(one, points);
  CHECK(order == hilbert_order(many, points));
  std::vector<Index> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i) REQUIRE(sorted[i] == static_cast<Index>(i));
  for (std::size_t k = 1; k < order.size(); ++k) {
    const auto before = hilbert_key(points[static_cast<std::size_t>(order[k - 1])]);
    const auto after = hilbert_key(points[static_cast<std::size_t>(order[k])]);
    REQUIRE((before < after || (before == after && order[k - 1] < order[k])));
  }
}

TEST_CASE("neighbours in Hilbert order are neighbours on the sphere, across cube edges too") {
  const std::size_t n = 100000;
  const std::vector<Vec3> points = random_points(n);
  parallel::Executor exec(1);
  const std::vector<Index> order = hilbert_order(exec, points);
  const double spacing = std::sqrt(4 * kPi / static_cast<double>(n));
  double sum = 0;
  double longest = 0;
  for (std::size_t k = 1; k < n; ++k) {
    const double step = (points[static_cast<std::size_t>(order[k])] -
                         points[static_cast<std::size_t>(order[k - 1])])
                            .norm();
    sum += step;
    longest = std::max(longest, step);
  }
  CHECK(sum / static_cast<double>(n) < 1.2 * spacing);
  CHECK(longest < 12 * spacing);
}

TEST_CASE("keys fit 35 bits and exist for every direction") {
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      for (const double z : {-1.0, 0.0, 1.0}) {
        CHECK(hilbert_key({x, y, z}) < (std::uint64_t{6} << 32));
      }
    }
  }
}
