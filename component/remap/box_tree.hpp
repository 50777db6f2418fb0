// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which polygons of a tiling may meet a given one, where the tiling has a border that no walk over
// its sides can cross.
#include <limits>
#include <vector>

#include "remap/tiling.hpp"

namespace delos::remap {

/// Empty at first.
struct Box {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());
  void add(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  bool meets(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

/// Holds all of a polygon's piece of the surface.
Box box_of(const Tiling& tiling, std::int64_t polygon);

/// The polygons' boxes along a Hilbert curve, and the boxes of eight of them, of eight of those and
/// so on. The same for any number of threads.
class BoxTree {
 public:
  /// O(n log n) for the order, the rest linear.
  BoxTree(parallel::Executor& exec, const Tiling& tiling);
  /// Replaces `ids` by the polygons whose boxes meet the box.
  void find(const Box& box, std::vector<Index>& ids) const;

 private:
  void find(const Box& box, std::size_t level, std::size_t first, std::vector<Index>& ids) const;

  std::vector<Index> order_;
  std::vector<std::vector<Box>> levels_;  // those of the polygons first
};

}  // namespace delos::remap
