// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/nearest.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace delos {
namespace {

/// Points of a leaf: a short scan is cheaper than more levels.
constexpr Index kLeafSize = 12;
/// Deeper than any tree of 2^31 points halved at each level.
constexpr std::size_t kMaxDepth = 64;

bool is_nearer(const NearestPoint::Hit& a, const NearestPoint::Hit& b) {
  return a.chord2 < b.chord2 || (a.chord2 == b.chord2 && a.point < b.point);
}

}  // namespace

NearestPoint::NearestPoint(std::vector<Vec3> points)
    : points_(std::move(points)), order_(points_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!points_.empty()) build(0, static_cast<Index>(points_.size()));
  sorted_.reserve(points_.size());
  for (const Index id : order_) sorted_.push_back(points_[static_cast<std::size_t>(id)]);
}

Index NearestPoint::build(Index begin, Index end) {
  const Index self = static_cast<Index>(nodes_.size());
  Vec3 low = points_[static_cast<std::size_t>(order_[static_cast<std::size_t>(begin)])];
  Vec3 high = low;
  for (Index i = begin; i < end; ++i) {
    const Vec3& p = points_[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  nodes_.push_back({low, high, begin, end, kNone});
  if (end - begin <= kLeafSize) return self;
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const Index middle = begin + (end - begin) / 2;
  const auto key = [&](Index id) { return points_[static_cast<std::size_t>(id)][axis]; };
  std::nth_element(
      order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
      [&](Index a, Index b) { return key(a) < key(b) || (key(a) == key(b) && a < b); });
  build(begin, middle);
  const Index right = build(middle, end);
  nodes_[static_cast<std::size_t>(self)].right = right;
  return self;
}

NearestPoint::Hit NearestPoint::distance_to(const Vec3& query, Index point) const {
  return {(query - points_[static_cast<std::size_t>(point)]).squaredNorm(), point};
}

NearestPoint::Hit NearestPoint::find(const Vec3& query, Hit best) const {
  struct Visit {
    Index node;
    double gap2;  ///< no point below the node is nearer than this
  };
  std::array<Visit, kMaxDepth> stack;
  std::size_t depth = 0;
  if (!nodes_.empty()) stack[depth++] = {0, nodes_[0].gap2(query)};
  while (depth > 0) {
    const Visit visit = stack[--depth];
    if (visit.gap2 > best.chord2) continue;
    const Node& node = nodes_[static_cast<std::size_t>(visit.node)];
    if (node.right == kNone) {
      for (Index i = node.begin; i < node.end; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Hit hit{(query - sorted_[k]).squaredNorm(), order_[k]};
        if (is_nearer(hit, best)) best = hit;
      }
      continue;
    }
    const Visit left{visit.node + 1, nodes_[static_cast<std::size_t>(visit.node) + 1].gap2(query)};
    const Visit right{node.right, nodes_[static_cast<std::size_t>(node.right)].gap2(query)};
    const bool left_first = left.gap2 <= right.gap2;
    stack[depth++] = left_first ? right : left;
    stack[depth++] = left_first ? left : right;
  }
  return best;
}

}  // namespace delos
