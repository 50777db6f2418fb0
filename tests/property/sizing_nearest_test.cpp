// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/nearest.hpp"

#include <doctest/doctest.h>

#include "core/hash.hpp"

using namespace delos;

namespace {

Vec3 random_direction(std::uint64_t seed, std::uint64_t id) {
  const Vec3 p(uniform01(seed, id, 0) - 0.5, uniform01(seed, id, 1) - 0.5,
               uniform01(seed, id, 2) - 0.5);
  return p.normalized();
}

NearestPoint::Hit by_scan(const std::vector<Vec3>& points, const Vec3& query, double below) {
  NearestPoint::Hit best{below, kNone};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double chord2 = (query - points[k]).squaredNorm();
    if (chord2 < best.chord2) best = {chord2, static_cast<Index>(k)};
  }
  return best;
}

}  // namespace

TEST_CASE("the nearest point is that of a full scan, whatever the hint") {
  for (const std::uint64_t seed : {1u, 2u}) {
    CAPTURE(seed);
    std::vector<Vec3> points;
    for (std::uint64_t id = 0; id < 700; ++id) points.push_back(random_direction(seed, id));
    // Clusters of equal points: the lowest id must win.
    for (std::uint64_t id = 0; id < 300; ++id) points.push_back(points[id % 7]);
    const NearestPoint tree(points);
    for (std::uint64_t id = 0; id < 500; ++id) {
      const Vec3 query = id % 5 == 0 ? points[id] : random_direction(seed + 10, id);
      const NearestPoint::Hit expected = by_scan(points, query, 5.0);
      const NearestPoint::Hit free = tree.find(query, {5.0, kNone});
      const NearestPoint::Hit hinted =
          tree.find(query, tree.distance_to(query, static_cast<Index>(id % points.size())));
      REQUIRE(free.point == expected.point);
      REQUIRE(free.chord2 == expected.chord2);
      REQUIRE(hinted.point == expected.point);
    }
  }
}

TEST_CASE("nothing is found beyond the cutoff or among no points") {
  const NearestPoint one({Vec3(1, 0, 0)});
  CHECK(one.find(Vec3(0, 1, 0), {0.5, kNone}).point == kNone);
  CHECK(NearestPoint(std::vector<Vec3>{}).find(Vec3(0, 1, 0), {5.0, kNone}).point == kNone);
}
