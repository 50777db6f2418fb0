// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/system_times.hpp"

#include <sys/resource.h>

#include <algorithm>

namespace delos::benchmark {
namespace {

constexpr double kShortestSplit_s = 0.1;

/// Seconds that the kernel has worked for this process so far.
double system_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_stime.tv_usec);
}

}  // namespace

void SystemTimes::note(const Progress& progress) {
  const double now_s = system_s();
  const auto [found, is_new] = begin_and_end_s_.try_emplace(progress.phase, now_s, now_s);
  if (!is_new) found->second.second = now_s;
}

double SystemTimes::user_s(const PhaseTime& phase) const {
  if (phase.cpu_s < kShortestSplit_s) return phase.cpu_s;
  const auto& [begin_s, end_s] = begin_and_end_s_.at(phase.phase);
  return std::max(phase.cpu_s - (end_s - begin_s), 0.0);
}

}  // namespace delos::benchmark
