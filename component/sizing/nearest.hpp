// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Nearest of many points on the unit sphere: a k-d tree.
#include <cstdint>
#include <vector>

#include "core/types.hpp"

namespace delos {

class NearestPoint {
 public:
  struct Hit {
    double chord2 = 0.0;  ///< squared chord to the point
    Index point = kNone;  ///< id = place in the constructor's array; the lowest among equals
  };

  explicit NearestPoint(std::vector<Vec3> points);

  /// The nearest point whose squared chord is below `hint.chord2`, or `hint` itself. A hint from a
  /// neighbouring query makes the search short; it does not change the distance found.
  Hit find(const Vec3& query, Hit hint) const;
  /// The distance of a known point, for a hint.
  Hit distance_to(const Vec3& query, Index point) const;

 private:
  struct Node {
    double split;
    Index begin, end;  ///< of order_
    std::int8_t axis;  ///< -1 = leaf
    Index right;       ///< the left child follows its parent
  };
  Index build(Index begin, Index end);

  std::vector<Vec3> points_;
  std::vector<Index> order_;
  std::vector<Vec3> sorted_;  ///< points in tree order
  std::vector<Node> nodes_;
};

}  // namespace delos
