// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Nearest of many points on the unit sphere: a k-d tree with boxes.
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
    Vec3 low, high;    ///< box around the points below
    Index begin, end;  ///< of order_
    Index right;       ///< kNone = leaf; the left child follows its parent
    double gap2(const Vec3& query) const {
      return (low - query).cwiseMax(query - high).cwiseMax(0.0).squaredNorm();
    }
  };
  Index build(Index begin, Index end);

  std::vector<Vec3> points_;
  std::vector<Index> order_;
  std::vector<Vec3> sorted_;  ///< points in tree order
  std::vector<Node> nodes_;
};

}  // namespace delos
