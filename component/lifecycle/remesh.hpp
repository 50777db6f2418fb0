// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A remesh of a running component: what is wanted now, the decision, the new grid.
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "adapt/policy.hpp"
#include "core/progress.hpp"
#include "lifecycle/generate.hpp"
#include "lifecycle/solution.hpp"

namespace delos {

/// What a component with a section `remesh` lives with beside its grid.
struct Remesh {
  explicit Remesh(const RemeshSettings& settings) : solution(settings) {}

  /// Keeps what is needed of the files from now on; they are not read again.
  void keep(Inputs read, const Settings& settings);

  Solution solution;
  PolicyState policy;
  std::optional<Inputs> inputs;  ///< none after a restart, before the first alarm
  /// What the exports tell of the last alarm: mismatch; 1 remeshed, 0 not, -1 failed.
  std::array<double, 2> told{};
};

/// How the attempt at an alarm ended.
struct RemeshOutcome {
  Decision decision;
  std::shared_ptr<const Product> product;  ///< the new one, or none: the old one stays
  std::optional<Solution> solution;        ///< on the new one's grid
  bool has_followed = false;               ///< the new grid is what was wanted, by the hysteresis
  std::string failure;                     ///< why a remesh that was wanted did not come about
};

/// At an alarm, `now`: the spacing that the statistics and (unless with_static is off) the sources
/// of `sizing` ask for, smoothed, limited and scaled as at the start; the mismatch; the decision,
/// which is logged and arms the policy again; and when it says so the new product, whose count
/// meets the budget within 1 % or the log has a warning, with the statistics carried over
/// conservatively. What goes wrong on the way (inputs that are gone, a budget that can't be met, a
/// certificate that is missed, a request to stop) is the `failure`, not thrown.
RemeshOutcome try_remesh(Context& context, const Product& old, const Time& now, Remesh& remesh);

}  // namespace delos
