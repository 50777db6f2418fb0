// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The rules of check_grid, by topic, and how they are applied.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/progress.hpp"
#include "dual/validate.hpp"

namespace delos::dual {

/// Runs one rule after the other over a kind of element and keeps those that are broken.
class Rules {
 public:
  static constexpr std::int64_t kGrain = 4096;

  Rules(Context& context, std::vector<BrokenRule>& broken) : context_(context), broken_(broken) {}

  /// error(i) > limit (or NaN) breaks the rule at element i.
  template <class ErrorOf>
  void check(const char* rule, std::int64_t n, double limit, ErrorOf&& error) {
    context_.monitor.check_cancelled();
    BrokenRule found = parallel::reduce(
        context_.exec, n, kGrain, BrokenRule{},
        [&](std::int64_t begin, std::int64_t end) {
          BrokenRule part;
          for (std::int64_t i = begin; i < end; ++i) note(part, i, error(i), limit);
          return part;
        },
        [](BrokenRule total, const BrokenRule& more) {
          total.n_broken += more.n_broken;
          total.worst = std::max(total.worst, more.worst);
          for (const Index id : more.ids) {
            if (total.ids.size() < kIdsShown) total.ids.push_back(id);
          }
          return total;
        });
    if (found.n_broken == 0) return;
    found.rule = rule;
    broken_.push_back(std::move(found));
  }
  bool all_hold() const { return broken_.empty(); }

 private:
  static constexpr std::size_t kIdsShown = 8;

  static void note(BrokenRule& part, std::int64_t i, double error, double limit) {
    if (error <= limit) return;
    ++part.n_broken;
    part.worst = std::max(part.worst, std::isnan(error) ? 1e300 : error);
    if (part.ids.size() < kIdsShown) part.ids.push_back(static_cast<Index>(i));
  }

  Context& context_;
  std::vector<BrokenRule>& broken_;
};

/// The error of a yes-or-no rule.
inline double unless(bool holds) { return holds ? 0.0 : 1.0; }

/// The larger error; a NaN is the largest.
inline double worse(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

template <class Row>
bool is_complete(const Row& ids) {
  return std::find(ids.begin(), ids.end(), kNone) == ids.end();
}

/// Sizes of the arrays; the others may be asked for when they agree.
bool has_sizes(const Grid& grid);
/// Ids in their ranges; the others may be asked for when all are.
void check_ids(const Grid& grid, Rules& rules);
/// The lists around cells, edges and vertices agree.
void check_order(const Grid& grid, Rules& rules);
/// Positions, lengths and angles.
void check_geometry(const Grid& grid, double tolerance, Rules& rules);
void check_areas(Context& context, const Grid& grid, double tolerance, Rules& rules);
void check_weights(Context& context, const Grid& grid, double tolerance, Rules& rules);

}  // namespace delos::dual
