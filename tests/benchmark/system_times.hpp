// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <utility>

#include "core/progress.hpp"

namespace delos::benchmark {

/// What the kernel did during each phase: mostly giving memory when it is first touched. Give
/// note() to a Monitor, whose progress tells begin and end of every phase.
class SystemTimes {
 public:
  void note(const Progress& progress);
  /// Of the phase's processor seconds the program's own. A phase below a tenth of a second is not
  /// divided: kernels count by ticks of some milliseconds.
  double user_s(const PhaseTime& phase) const;

 private:
  std::map<std::string, std::pair<double, double>> begin_and_end_s_;
};

}  // namespace delos::benchmark
