// SPDX-License-Identifier: BSD-3-Clause
#include "remap/multigrid.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace delos::remap {
namespace {

// Nodes that see each other in a sweep; part of the answer.
constexpr std::int64_t kSweepBlock = 8192;
constexpr std::int64_t kGroupGrain = 4096;  // groups of some twenty joints, 0.1 ms
constexpr std::int64_t kFewNodes = 64;      // are swept until solved well enough
constexpr double kLeastGain = 0.8;          // a level that has more of the last one's nodes is none
constexpr int kLastSweeps = 8;
constexpr double kOvercorrection = 1.6;  // 37 rounds on 164 000 cells, as with 1.8; 1.3: 40, 1: 54
constexpr int kCycles = 2;               // W

// Pairs of nodes, each with the ungrouped neighbour that it is joined to most strongly; one that
// has none joins the group of its strongest neighbour, so that no hub of many leaves stays. Returns
// the number of groups.
Index pair_up(const Network& network, Array<Index>& group) {
  const std::int64_t n = network.size();
  group.assign(at(n), kNone);
  Index n_groups = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    if (group[at(i)] != kNone) continue;
    Index partner = kNone, neighbour = kNone;
    double strongest = 0.0, strongest_grouped = 0.0;
    for (auto k = network.offsets[at(i)]; k < network.offsets[at(i) + 1]; ++k) {
      const Index other = network.neighbour[at(k)];
      const bool is_grouped = group[at(other)] != kNone;
      double& most = is_grouped ? strongest_grouped : strongest;
      if (network.weight[at(k)] <= most) continue;
      most = network.weight[at(k)];
      (is_grouped ? neighbour : partner) = other;
    }
    if (partner == kNone && neighbour != kNone) {
      group[at(i)] = group[at(neighbour)];
      continue;
    }
    group[at(i)] = n_groups;
    if (partner != kNone) group[at(partner)] = n_groups;
    ++n_groups;
  }
  return n_groups;
}

// Members of each group, ascending.
struct Members {
  Array<std::int64_t> begin;
  Array<Index> node;
};

Members members_of(std::span<const Index> group, Index n_groups) {
  Members result;
  result.begin.assign(at(n_groups) + 1, 0);
  for (const Index g : group) ++result.begin[at(g) + 1];
  std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
  result.node.resize(group.size());
  std::vector<std::int64_t> next(result.begin.begin(), result.begin.end() - 1);
  for (std::size_t i = 0; i < group.size(); ++i) {
    result.node[at(next[at(group[i])]++)] = static_cast<Index>(i);
  }
  return result;
}

// The network of groups: joints between two groups become one with the sum of their weights.
Network merged(parallel::Executor& exec, const Network& fine, std::span<const Index> group,
               const Members& members) {
  const auto n = static_cast<std::int64_t>(members.begin.size()) - 1;
  return make_network(exec, n, [&](std::int64_t g, auto&& put) {
    std::vector<std::pair<Index, double>> joints;
    for (auto m = members.begin[at(g)]; m < members.begin[at(g) + 1]; ++m) {
      const std::size_t i = at(members.node[at(m)]);
      for (auto k = fine.offsets[i]; k < fine.offsets[i + 1]; ++k) {
        const Index other = group[at(fine.neighbour[at(k)])];
        if (other != g) joints.emplace_back(other, fine.weight[at(k)]);
      }
    }
    std::sort(joints.begin(), joints.end());
    for (std::size_t k = 0; k < joints.size();) {
      const Index other = joints[k].first;
      double sum = 0.0;
      for (; k < joints.size() && joints[k].first == other; ++k) sum += joints[k].second;
      put(other, sum);
    }
  });
}

// A Gauss-Seidel sweep: other nodes of a node's block as they are now, those beyond as they were.
struct Sweep {
  const Network& network;
  std::span<const double> inverse, right, old;
  std::span<double> x;

  void node(std::int64_t i, std::int64_t begin, std::int64_t end) const {
    double sum = right[at(i)];
    for (auto k = network.offsets[at(i)]; k < network.offsets[at(i) + 1]; ++k) {
      const Index other = network.neighbour[at(k)];
      const bool is_in_block = other >= begin && other < end;
      sum += network.weight[at(k)] * (is_in_block ? x[at(other)] : old[at(other)]);
    }
    x[at(i)] = sum * inverse[at(i)];
  }
  void forward(parallel::Executor& exec) const {
    parallel::for_range(exec, network.size(), kSweepBlock, [&](auto begin, auto end) {
      for (std::int64_t i = begin; i < end; ++i) node(i, begin, end);
    });
  }
  void backward(parallel::Executor& exec) const {
    parallel::for_range(exec, network.size(), kSweepBlock, [&](auto begin, auto end) {
      for (std::int64_t i = end - 1; i >= begin; --i) node(i, begin, end);
    });
  }
};

}  // namespace

Multigrid::Multigrid(parallel::Executor& exec, const Network& network)
    : exec_(exec), finest_(network), levels_(1) {
  while (add_coarser()) {
  }
}

// False when the last level has few nodes or none that are joined.
bool Multigrid::add_coarser() {
  Level& fine = levels_.back();
  const Network& network = network_of(levels_.size() - 1);
  fine.inverse = inverse_diagonal(exec_, network);
  fine.old.resize(at(network.size()));
  fine.residual.resize(at(network.size()));
  if (network.size() <= kFewNodes) return false;
  // Pairs of pairs.
  const Index n_pairs = pair_up(network, fine.group);
  const Network pairs = merged(exec_, network, fine.group, members_of(fine.group, n_pairs));
  Array<Index> of_pair;
  const Index n_groups = pair_up(pairs, of_pair);
  if (static_cast<double>(n_groups) > kLeastGain * static_cast<double>(network.size())) {
    fine.group.clear();
    return false;
  }
  for (Index& group : fine.group) group = of_pair[at(group)];
  Members members = members_of(fine.group, n_groups);
  Level coarse;
  coarse.own = merged(exec_, network, fine.group, members);
  fine.begin = std::move(members.begin);
  fine.member = std::move(members.node);
  coarse.right.resize(at(n_groups));
  coarse.x.resize(at(n_groups));
  levels_.push_back(std::move(coarse));
  return true;
}

void Multigrid::apply(std::span<const double> right, std::span<double> x) {
  parallel::for_index(exec_, finest_.size(), kSweepBlock, [&](std::int64_t i) { x[at(i)] = 0.0; });
  cycle(0, right, x);
}

// Improves x.
void Multigrid::cycle(std::size_t depth, std::span<const double> right, std::span<double> x) {
  Level& level = levels_[depth];
  const Network& network = network_of(depth);
  const Sweep sweep{network, level.inverse, right, level.old, x};
  const auto keep_old = [&] {
    parallel::for_index(exec_, network.size(), kSweepBlock,
                        [&](std::int64_t i) { level.old[at(i)] = x[at(i)]; });
  };
  const int n_sweeps = level.group.empty() ? kLastSweeps : 1;
  for (int k = 0; k < n_sweeps; ++k) {
    keep_old();
    sweep.forward(exec_);
  }
  if (!level.group.empty()) add_correction(depth, right, x);
  for (int k = 0; k < n_sweeps; ++k) {
    keep_old();
    sweep.backward(exec_);
  }
}

void Multigrid::add_correction(std::size_t depth, std::span<const double> right,
                               std::span<double> x) {
  Level &level = levels_[depth], &coarse = levels_[depth + 1];
  apply_laplace(exec_, network_of(depth), x, level.residual);
  parallel::for_index(exec_, coarse.own.size(), kGroupGrain, [&](std::int64_t g) {
    double sum = 0.0;
    for (auto m = level.begin[at(g)]; m < level.begin[at(g) + 1]; ++m) {
      const std::size_t i = at(level.member[at(m)]);
      sum += right[i] - level.residual[i];
    }
    coarse.right[at(g)] = sum;
  });
  std::fill(coarse.x.begin(), coarse.x.end(), 0.0);
  for (int k = 0; k < kCycles; ++k) cycle(depth + 1, coarse.right, coarse.x);
  parallel::for_index(exec_, network_of(depth).size(), kSweepBlock, [&](std::int64_t i) {
    x[at(i)] += kOvercorrection * coarse.x[at(level.group[at(i)])];
  });
}

}  // namespace delos::remap
