// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/plane_area.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "core/hash.hpp"
#include "geometry/tangent_frame.hpp"

using namespace delos;

namespace {

using Point = std::array<double, 2>;

struct Plane {
  Vec3 origin, east, north;
  explicit Plane(const Vec3& at) : origin(at) {
    const TangentFrame frame(at.normalized());
    east = at.norm() * frame.right;
    north = at.norm() * frame.ahead;
  }
  Vec3 on(const Ellipsoid& surface, const Point& p) const {
    return surface.project(origin + p[0] * east + p[1] * north);
  }
};

Point difference(const Point& to, const Point& from) { return {to[0] - from[0], to[1] - from[1]}; }

}  // namespace

TEST_CASE("areas in a plane are those of the triangles on the body") {
  constexpr std::uint64_t kSeed = 7;
  for (const Ellipsoid& surface :
       {Ellipsoid::wgs84(), Ellipsoid(Vec3(1.2, 1.0, 0.8), Vec3(0, 0, 0)),
        Ellipsoid(Vec3(1.0, 1.0, 0.3), Vec3(0, 0, 0))}) {
    for (std::uint64_t round = 0; round < 300; ++round) {
      std::uint64_t n_drawn = 0;
      const auto draw = [&] { return 2.0 * uniform01(kSeed, round, n_drawn++) - 1.0; };
      const Plane plane(surface.project(Vec3(draw(), draw(), draw() + 1.5)));
      const PlaneArea areas(surface, plane.origin, plane.east, plane.north);
      const auto inside = [&] { return areas.reach() * draw(); };
      const Point a{inside(), inside()}, b{inside(), inside()}, c{inside(), inside()};
      const double found = areas.triangle(a, difference(b, a), difference(c, a));
      const double wanted =
          surface.triangle_area(plane.on(surface, a), plane.on(surface, b), plane.on(surface, c));
      // Of slender triangles the corners on the body are rounded.
      const double rounding = 3e-16 * areas.reach() * surface.radii().squaredNorm();
      CHECK(std::abs(found - wanted) < 1e-14 * std::abs(wanted) + rounding);
      CHECK(areas.triangle(a, difference(c, a), difference(b, a)) == doctest::Approx(-found));
    }
  }
}
