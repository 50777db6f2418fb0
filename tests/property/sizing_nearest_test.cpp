// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/nearest.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/hash.hpp"
#include "sizing/nodes.hpp"
#include "sizing/raster.hpp"

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

/// Points anywhere, and clusters of equal ones: the lowest id must win.
std::vector<Vec3> mixed_points(std::uint64_t seed) {
  std::vector<Vec3> points;
  for (std::uint64_t id = 0; id < 700; ++id) points.push_back(random_direction(seed, id));
  for (std::uint64_t id = 0; id < 300; ++id) points.push_back(points[id % 7]);
  return points;
}

/// Every so many nodes of a table, the last first: nodes between two of them tie to the last bit.
std::vector<Vec3> nodes_of(const LatLonField& table, std::size_t every) {
  const NodeDirections nodes(table);
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < table.values.size(); k += every) {
    const auto columns = static_cast<std::size_t>(table.n_lon);
    points.push_back(
        nodes.direction(static_cast<Index>(k / columns), static_cast<Index>(k % columns)));
  }
  std::reverse(points.begin(), points.end());
  return points;
}

void check_nodes(parallel::Executor& exec, const std::vector<Vec3>& points,
                 const LatLonField& table, double below_chord2) {
  std::vector<NearestPoint::Hit> found(table.values.size(), {-1.0, kNone});
  NodeSearch search;
  search.below_chord2 = below_chord2;
  search.take = [&](Index row, Index column, std::span<const NearestPoint::Hit> hits) {
    std::copy(hits.begin(), hits.end(),
              found.begin() + static_cast<std::ptrdiff_t>(table.at(row, column)));
  };
  find_nearest(exec, NearestPoint(exec, points), table, search);
  const NodeDirections nodes(table);
  for (Index row = 0; row < table.n_rows(); ++row) {
    for (Index i = 0; i < table.n_lon; ++i) {
      CAPTURE(row);
      CAPTURE(i);
      const NearestPoint::Hit expected = by_scan(points, nodes.direction(row, i), below_chord2);
      REQUIRE(found[table.at(row, i)].point == expected.point);
      REQUIRE(found[table.at(row, i)].chord2 == expected.chord2);
    }
  }
}

}  // namespace

TEST_CASE("the nearest point is that of a full scan") {
  parallel::Executor exec(2);
  for (const std::uint64_t seed : {1u, 2u}) {
    CAPTURE(seed);
    const std::vector<Vec3> points = mixed_points(seed);
    const NearestPoint tree(exec, points);
    for (std::uint64_t id = 0; id < 500; ++id) {
      const Vec3 query = id % 5 == 0 ? points[id] : random_direction(seed + 10, id);
      for (const double below : {5.0, 1e-3}) {
        const NearestPoint::Hit expected = by_scan(points, query, below);
        const NearestPoint::Hit found = tree.find(query, below);
        REQUIRE(found.point == expected.point);
        REQUIRE(found.chord2 == expected.chord2);
      }
    }
  }
}

TEST_CASE("the nearest point of every node of a table is that of a full scan") {
  parallel::Executor exec(2);
  for (const std::uint64_t seed : {1u, 2u}) {
    CAPTURE(seed);
    // From tables smaller than a tile to some tiles with a rest, poles and date line in them.
    for (const double step_deg : {20.0, 2.0, 1.3}) {
      CAPTURE(step_deg);
      const LatLonField table = make_table(step_deg * kRadPerDeg);
      check_nodes(exec, mixed_points(seed), table, 5.0);
      check_nodes(exec, mixed_points(seed), table, 2e-3);
      check_nodes(exec, nodes_of(table, 7), table, 5.0);
      check_nodes(exec, {random_direction(seed, 0)}, table, 5.0);
    }
  }
}

TEST_CASE("nodes that nobody wants are not asked for") {
  parallel::Executor exec(2);
  const LatLonField table = make_table(1.0 * kRadPerDeg);
  const NearestPoint tree(exec, mixed_points(3));
  std::vector<char> is_taken(table.values.size(), 0);
  NodeSearch search;
  search.is_wanted = [](const TableTile& tile) {
    return tile.row_begin <= 100 && tile.row_end > 100;
  };
  search.take = [&](Index row, Index column, std::span<const NearestPoint::Hit> hits) {
    std::fill_n(is_taken.begin() + static_cast<std::ptrdiff_t>(table.at(row, column)), hits.size(),
                1);
  };
  find_nearest(exec, tree, table, search);
  for (Index i = 0; i < table.n_lon; ++i) {
    CHECK(is_taken[table.at(100, i)] == 1);
    CHECK(is_taken[table.at(20, i)] == 0);
  }
}

TEST_CASE("nothing is found beyond the cutoff or among no points") {
  parallel::Executor exec(1);
  CHECK(NearestPoint(exec, {Vec3(1, 0, 0)}).find(Vec3(0, 1, 0), 0.5).point == kNone);
  CHECK(NearestPoint(exec, {}).find(Vec3(0, 1, 0), 5.0).point == kNone);
  check_nodes(exec, {}, make_table(5.0 * kRadPerDeg), 5.0);
}
