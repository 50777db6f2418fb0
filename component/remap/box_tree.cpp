// SPDX-License-Identifier: BSD-3-Clause
#include "remap/box_tree.hpp"

#include <algorithm>

#include "geometry/point_order.hpp"

namespace delos::remap {
namespace {

constexpr std::size_t kChildren = 8;
constexpr std::int64_t kBoxGrain = 4096;  // about 0.2 ms

}  // namespace

Box box_of(const Tiling& tiling, std::int64_t polygon) {
  Box box;
  box.add(tiling.centres()[at(polygon)]);
  for (const Index id : tiling.corners(polygon)) box.add(tiling.corner(id));
  // The surface bulges out by an eighth of the square of the extent over the radius of curvature:
  // enough down to an eighth of the largest radius.
  const double extent = (box.high - box.low).maxCoeff();
  box.low.array() -= extent * extent;
  box.high.array() += extent * extent;
  return box;
}

BoxTree::BoxTree(parallel::Executor& exec, const Tiling& tiling)
    : order_(hilbert_order(exec, tiling.centres())) {
  std::vector<Box> leaves(order_.size());
  parallel::for_index(exec, tiling.size(), kBoxGrain,
                      [&](std::int64_t k) { leaves[at(k)] = box_of(tiling, order_[at(k)]); });
  levels_.push_back(std::move(leaves));
  while (levels_.back().size() > kChildren) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> level((below.size() + kChildren - 1) / kChildren);
    for (std::size_t k = 0; k < below.size(); ++k) {
      level[k / kChildren].add(below[k].low);
      level[k / kChildren].add(below[k].high);
    }
    levels_.push_back(std::move(level));
  }
}

void BoxTree::find(const Box& box, std::vector<Index>& ids) const {
  ids.clear();
  find(box, levels_.size() - 1, 0, ids);
}

void BoxTree::find(const Box& box, std::size_t level, std::size_t first,
                   std::vector<Index>& ids) const {
  const std::size_t end = std::min(first + kChildren, levels_[level].size());
  for (std::size_t k = first; k < end; ++k) {
    if (!levels_[level][k].meets(box)) continue;
    if (level == 0) {
      ids.push_back(order_[k]);
    } else {
      find(box, level - 1, k * kChildren, ids);
    }
  }
}

}  // namespace delos::remap
