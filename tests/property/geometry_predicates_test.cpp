// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/predicates.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/hash.hpp"
#include "geometry/expansion.hpp"
#include "triangulation/seeds.hpp"

using namespace delos;
using predicates::Site;

namespace {

__extension__ using Integer = __int128;

/// Points on integer grids: every determinant is exact in 128 bits.
Vec3 grid_point(std::uint64_t seed, std::uint64_t id, int range) {
  const auto coordinate = [&](std::uint64_t axis) {
    return std::floor(uniform01(seed, id, axis) * (2.0 * range + 1.0)) - range;
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

int sign(Integer value) { return value > 0 ? 1 : (value < 0 ? -1 : 0); }

Integer determinant(const Vec3& u, const Vec3& v, const Vec3& w) {
  const auto i = [](double x) { return static_cast<Integer>(static_cast<std::int64_t>(x)); };
  return i(u.x()) * (i(v.y()) * i(w.z()) - i(v.z()) * i(w.y())) +
         i(u.y()) * (i(v.z()) * i(w.x()) - i(v.x()) * i(w.z())) +
         i(u.z()) * (i(v.x()) * i(w.y()) - i(v.y()) * i(w.x()));
}

/// The even permutations of four, then the odd ones.
std::vector<std::array<std::size_t, 4>> permutations(bool even) {
  std::vector<std::array<std::size_t, 4>> out;
  std::array<std::size_t, 4> p = {0, 1, 2, 3};
  do {
    int inversions = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) inversions += p[i] > p[j] ? 1 : 0;
    }
    if ((inversions % 2 == 0) == even) out.push_back(p);
  } while (std::next_permutation(p.begin(), p.end()));
  return out;
}

Vec3 random_direction(std::uint64_t seed, std::uint64_t id) {
  const Vec3 p(uniform01(seed, id, 0) - 0.5, uniform01(seed, id, 1) - 0.5,
               uniform01(seed, id, 2) - 0.5);
  return p.normalized();
}

}  // namespace

TEST_CASE("orientations of integer points, many of them coplanar, have the sign of integer math") {
  for (const int range : {2, 50, 1 << 20}) {
    CAPTURE(range);
    int n_zero = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
      const Vec3 a = grid_point(1, i, range);
      const Vec3 b = grid_point(2, i, range);
      const Vec3 c = grid_point(3, i, range);
      // Every second point is in the plane of the others.
      const Vec3 d = i % 2 == 0 ? Vec3(a + 3 * (b - a) - 2 * (c - a)) : grid_point(4, i, range);
      const int want = sign(determinant(b - a, c - a, d - a));
      n_zero += want == 0 ? 1 : 0;
      REQUIRE(predicates::orient3d(a, b, c, d) == want);
      REQUIRE(predicates::orient3d_exact(a, b, c, d) == want);
      REQUIRE(predicates::orient_origin(a, b, c) == sign(determinant(a, b, c)));
      REQUIRE(predicates::orient_origin_exact(a, b, c) == sign(determinant(a, b, c)));
    }
    CHECK(n_zero >= 10000);
  }
}

TEST_CASE("the filter is never certain of a wrong sign next to a plane") {
  int n_uncertain = 0;
  for (std::uint64_t i = 0; i < 100000; ++i) {
    const double size = std::pow(10.0, -8 * uniform01(9, i));
    const Vec3 a = random_direction(5, i);
    const Vec3 b = (a + size * random_direction(6, i)).normalized();
    const Vec3 c = (a + size * random_direction(7, i)).normalized();
    Vec3 d = a + (b - a) * uniform01(8, i) + (c - a) * uniform01(8, i, 1);
    d *= 1 + (uniform01(8, i, 2) - 0.5) * 1e-15;
    const auto filtered = predicates::determinant(b - a, c - a, d - a);
    n_uncertain += filtered.is_certain() ? 0 : 1;
    const int exact = predicates::orient3d_exact(a, b, c, d);
    if (filtered.is_certain()) REQUIRE(exact == (filtered.det > 0 ? 1 : -1));
    REQUIRE(predicates::orient3d(a, b, c, d) == exact);
  }
  CHECK(n_uncertain > 1000);
}

TEST_CASE("double-double and expansions agree with a shift that integers make exact") {
  // d is moved off the plane by one unit in the last place of one coordinate; the determinant is
  // then an integer multiple of 2^-k, computed here in 128 bits.
  constexpr double kUnit = 0x1p-30;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Vec3 a = grid_point(11, i, 1 << 30);
    const Vec3 b = a + grid_point(12, i, 1000);
    const Vec3 c = a + grid_point(13, i, 1000);
    Vec3 d = a + 2 * (b - a) - (c - a);
    d[static_cast<int>(i % 3)] += i % 5 < 2 ? 1 : -1;
    const int want = sign(determinant(b - a, c - a, d - a));
    REQUIRE(predicates::orient3d(a * kUnit, b * kUnit, c * kUnit, d * kUnit) == want);
  }
}

TEST_CASE("swapping two points flips the orientation, cyclic shifts keep it") {
  const auto even = permutations(true);
  const auto odd = permutations(false);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    std::array<Vec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) {
      p[k] = i % 2 == 0 ? grid_point(20 + k, i, 3) : random_direction(20 + k, i);
    }
    const int want = predicates::orient3d(p[0], p[1], p[2], p[3]);
    for (const auto& e : even) {
      REQUIRE(predicates::orient3d(p[e[0]], p[e[1]], p[e[2]], p[e[3]]) == want);
    }
    for (const auto& o : odd) {
      REQUIRE(predicates::orient3d(p[o[0]], p[o[1]], p[o[2]], p[o[3]]) == -want);
    }
  }
}

TEST_CASE("in_circle answers consistently for every permutation of co-circular points") {
  // The corners of a cube and of its faces: exactly co-circular quadrilaterals.
  const std::vector<Vec3> grid = cubed_sphere_points(4);
  const auto even = permutations(true);
  const auto odd = permutations(false);
  int n_ties = 0;
  for (std::size_t i = 0; i < 60000; ++i) {
    std::array<Site, 4> s;
    std::array<Index, 4> id;
    for (std::size_t k = 0; k < 4; ++k) {
      id[k] = static_cast<Index>(hash64(31 + k, i) % grid.size());
      s[k] = {grid[static_cast<std::size_t>(id[k])], id[k]};
    }
    std::sort(id.begin(), id.end());
    if (std::adjacent_find(id.begin(), id.end()) != id.end()) continue;
    if (predicates::orient3d(s[0].position, s[1].position, s[2].position, s[3].position) == 0) {
      const bool degenerate =
          predicates::orient_origin(s[0].position, s[1].position, s[2].position) == 0 &&
          predicates::orient_origin(s[0].position, s[1].position, s[3].position) == 0;
      if (degenerate) continue;
      ++n_ties;
    }
    const bool want = predicates::in_circle(s[0], s[1], s[2], s[3]);
    REQUIRE(predicates::in_circle_exact(s[0], s[1], s[2], s[3]) == want);
    for (const auto& e : even) {
      REQUIRE(predicates::in_circle(s[e[0]], s[e[1]], s[e[2]], s[e[3]]) == want);
    }
    for (const auto& o : odd) {
      REQUIRE(predicates::in_circle(s[o[0]], s[o[1]], s[o[2]], s[o[3]]) != want);
    }
  }
  CHECK(n_ties > 100);
}

TEST_CASE("of the two diagonals of a co-circular quadrilateral exactly one is legal") {
  // Counter-clockwise square around the north pole, under every assignment of ids.
  const double z = 0.75;
  const std::array<Vec3, 4> ring = {
      {{0.5, 0.5, z}, {-0.5, 0.5, z}, {-0.5, -0.5, z}, {0.5, -0.5, z}}};
  std::array<Index, 4> id = {3, 8, 21, 40};
  do {
    std::array<Site, 4> s;
    for (std::size_t k = 0; k < 4; ++k) s[k] = {ring[k], id[k]};
    const bool flip_02 = predicates::in_circle(s[0], s[1], s[2], s[3]);
    CHECK(predicates::in_circle(s[0], s[2], s[3], s[1]) == flip_02);  // its other triangle
    const bool flip_13 = predicates::in_circle(s[0], s[1], s[3], s[2]);
    CHECK(predicates::in_circle(s[1], s[2], s[3], s[0]) == flip_13);
    CHECK(flip_02 != flip_13);
  } while (std::next_permutation(id.begin(), id.end()));
}

TEST_CASE("a tie is decided as if the point of lowest index were moved outward") {
  const double z = 0.75;
  const std::array<Vec3, 4> ring = {
      {{0.5, 0.5, z}, {-0.5, 0.5, z}, {-0.5, -0.5, z}, {0.5, -0.5, z}}};
  std::array<Index, 4> id = {1, 2, 3, 4};
  do {
    std::array<Site, 4> s;
    for (std::size_t k = 0; k < 4; ++k) s[k] = {ring[k], id[k]};
    auto moved = ring;
    const auto lowest =
        static_cast<std::size_t>(std::min_element(id.begin(), id.end()) - id.begin());
    moved[lowest] *= 1 + 0x1p-40;
    CHECK(predicates::in_circle(s[0], s[1], s[2], s[3]) ==
          (predicates::orient3d(moved[0], moved[1], moved[2], moved[3]) > 0));
  } while (std::next_permutation(id.begin(), id.end()));
}

TEST_CASE("points 1e-15 apart, at the poles and on the date line keep the laws") {
  const double e = 1e-15;
  const std::vector<Vec3> points = {{0, 0, 1},         {e, 0, 1},  {0, e, 1},       {-e, 0, 1},
                                    {0, 0, -1},        {-1, 0, 0}, {-1, e, 0},      {-1, -e, 0},
                                    {-1, 0, e},        {1, 0, 0},  {1, 4.9e-85, 0}, {0, 1, 0},
                                    {0.6, -0.8, 1e-80}};
  const auto odd = permutations(false);
  const auto n = points.size();
  for (std::size_t i = 0; i < n * n * n * n; ++i) {
    const std::array<std::size_t, 4> k = {i % n, i / n % n, i / n / n % n, i / n / n / n};
    const int want = predicates::orient3d(points[k[0]], points[k[1]], points[k[2]], points[k[3]]);
    const auto& o = odd[i % odd.size()];
    REQUIRE(predicates::orient3d(points[k[o[0]]], points[k[o[1]]], points[k[o[2]]],
                                 points[k[o[3]]]) == -want);
  }
}

TEST_CASE("two_product and two_sum lose nothing") {
  for (std::uint64_t i = 0; i < 10000; ++i) {
    const double a = static_cast<double>(hash64(1, i) >> 11);
    const double b = static_cast<double>(hash64(2, i) >> 11);
    const auto p = expansion::two_product(a, b);
    REQUIRE(static_cast<Integer>(a) * static_cast<Integer>(b) ==
            static_cast<Integer>(p.hi) + static_cast<Integer>(p.lo));
    const auto s = expansion::two_sum(a * 0x1p20, b);
    REQUIRE(static_cast<Integer>(a) * (1 << 20) + static_cast<Integer>(b) ==
            static_cast<Integer>(s.hi) + static_cast<Integer>(s.lo));
  }
}

TEST_CASE("prefers_flip is symmetric, agrees with in_circle and never wants both diagonals") {
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double size = i % 2 == 0 ? 0.3 : 1e-3;
    const Vec3 centre = random_direction(41, i);
    const Vec3 east = centre.unitOrthogonal();
    const Vec3 north = centre.cross(east);
    std::array<Vec3, 4> q;
    for (std::size_t k = 0; k < 4; ++k) {  // counter-clockwise, convex or not
      const double angle = (static_cast<double>(k) + 0.8 * uniform01(42, i, k)) * kPi / 2;
      const double r = size * (0.3 + uniform01(43, i, k));
      q[k] = (centre + r * (std::cos(angle) * east + std::sin(angle) * north)).normalized();
    }
    const bool flip = predicates::prefers_flip(q[0], q[2], q[1], q[3]);
    REQUIRE(predicates::prefers_flip(q[2], q[0], q[1], q[3]) == flip);
    REQUIRE(predicates::prefers_flip(q[0], q[2], q[3], q[1]) == flip);
    if (flip) REQUIRE_FALSE(predicates::prefers_flip(q[1], q[3], q[0], q[2]));
    const auto det = predicates::determinant(q[1] - q[0], q[2] - q[0], q[3] - q[0]);
    if (std::abs(det.det) > 1e-9 * size * size * size * size) {
      REQUIRE(flip == predicates::in_circle({q[0], 0}, {q[1], 1}, {q[2], 2}, {q[3], 3}));
    }
  }
  // An exact tie stays as it is.
  CHECK_FALSE(predicates::prefers_flip({1, 0, 2}, {-1, 0, 2}, {0, 1, 2}, {0, -1, 2}));
  CHECK_FALSE(predicates::prefers_flip({0, 1, 2}, {0, -1, 2}, {1, 0, 2}, {-1, 0, 2}));
}
