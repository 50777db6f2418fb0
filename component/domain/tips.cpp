// SPDX-License-Identifier: BSD-3-Clause
#include "domain/tips.hpp"

#include <algorithm>
#include <cmath>

namespace delos::domain {
namespace {

// What is left after so many takes turns.
constexpr int kTipRounds = 10;

// The longest run around a cell of neighbours of the other kind.
std::size_t longest_run(const Mask& sea, Index cell, const std::vector<Index>& around) {
  std::size_t longest = 0, run = 0;
  for (std::size_t i = 0; i < 2 * around.size(); ++i) {
    const Index other = around[i % around.size()];
    run = other != kNone && sea[at(other)] != sea[at(cell)] ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  return std::min(longest, around.size());
}

}  // namespace

std::int64_t clear_tips(const TipRule& rule, const NeighboursOf& neighbours_of, Mask& sea) {
  std::vector<Index> doubtful;
  for (std::size_t cell = 0; cell < sea.size(); ++cell) {
    if (std::abs(rule.wet_fraction[cell] - rule.least_wet) <= rule.margin) {
      doubtful.push_back(static_cast<Index>(cell));
    }
  }
  std::int64_t n_changed = 0;
  std::vector<Index> around;
  for (int round = 0; round < kTipRounds; ++round) {
    const Mask before = sea;
    const std::int64_t n_before = n_changed;
    for (const Index cell : doubtful) {
      neighbours_of(cell, around);
      const bool is_alone = std::all_of(around.begin(), around.end(), [&](Index other) {
        return other == kNone || sea[at(other)] == before[at(other)];
      });
      if (!is_alone || longest_run(before, cell, around) + 2 < around.size()) continue;
      sea[at(cell)] = sea[at(cell)] == 0 ? 1 : 0;
      ++n_changed;
    }
    if (n_changed == n_before) break;
  }
  return n_changed;
}

}  // namespace delos::domain
