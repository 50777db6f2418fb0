// SPDX-License-Identifier: BSD-3-Clause
#include "remap/walk.hpp"

#include <algorithm>
#include <cmath>

namespace delos::remap {
namespace {

// A walk ends in the polygon whose sides p is left of, to rounding.
constexpr double kOutside = 1e-15;
constexpr std::int64_t kStarts = 512;

// The neighbour across a side that p is outside of; kNone when p is inside.
Index step_towards(const Tiling& tiling, Index polygon, const Vec3& p) {
  const auto corners = tiling.corners(polygon);
  const Vec3& centre = tiling.centres()[at(polygon)];
  Vec3 from = tiling.corner(corners.back());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3& to = tiling.corner(corners[k]);
    const Vec3 normal = from.cross(to - from);
    // A side that runs backwards is no border.
    if (normal.dot(p - from) < -kOutside * normal.cwiseAbs().sum() &&
        normal.dot(centre - from) > 0.0) {
      return tiling.neighbours(polygon)[k];
    }
    from = to;
  }
  return kNone;
}

Index nearest_centre(const Tiling& tiling, const Vec3& p, std::int64_t stride) {
  Index best = 0;
  double least = 16.0;
  for (std::int64_t i = 0; i < tiling.size(); i += stride) {
    const double square = (tiling.centres()[at(i)] - p).squaredNorm();
    if (square < least) {
      least = square;
      best = static_cast<Index>(i);
    }
  }
  return best;
}

// From neighbour to neighbour as long as centres come nearer to p: in a Voronoi diagram to the cell
// of p, elsewhere near it, at less cost than over the sides.
Index approach(const Tiling& tiling, const Vec3& p, Index start) {
  Index here = start;
  double least = (tiling.centres()[at(start)] - p).squaredNorm();
  for (Index from = kNone; from != here;) {
    from = here;
    for (const Index beside : tiling.neighbours(from)) {
      tiling.prefetch_place(beside);
      const double square = (tiling.centres()[at(beside)] - p).squaredNorm();
      here = square < least ? beside : here;
      least = std::min(least, square);
    }
  }
  return here;
}

}  // namespace

Index walk(const Tiling& tiling, const Vec3& p, Index start) {
  const std::int64_t longest = 1000 + 10 * static_cast<std::int64_t>(std::sqrt(tiling.size()));
  Index here = approach(tiling, p, start);
  for (std::int64_t step = 0; step < longest; ++step) {
    const Index next = step_towards(tiling, here, p);
    if (next == kNone) return here;
    here = next;
  }
  return nearest_centre(tiling, p, 1);
}

Index start_near(const Tiling& tiling, const Vec3& p) {
  return nearest_centre(tiling, p, std::max<std::int64_t>(1, tiling.size() / kStarts));
}

}  // namespace delos::remap
