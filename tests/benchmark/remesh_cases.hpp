// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/progress.hpp"

namespace delos::benchmark {

/// One local remesh beside the fresh mesh for the same spacing, on one number of threads.
struct RemeshTiming {
  std::string name;
  int threads = 1;
  std::int64_t n_before = 0, n_after = 0;
  std::int64_t n_removed = 0, n_inserted = 0;
  double fresh_s = 0.0, remesh_s = 0.0;  ///< wall, least of the rounds: refine and relax
  std::vector<PhaseTime> phases;         ///< of the last remesh
  std::string digest;                    ///< of the remeshed mesh: the same for any threads
};

/// Meshes of about a million cells with a patch of half the spacing that moves ("crescents"),
/// appears ("patch"), or stands in for many small ones ("specks"): about 5 % of the cells change.
/// `names`: only these; all when empty.
std::vector<RemeshTiming> time_remesh(std::span<const int> threads, int rounds,
                                      std::span<const std::string> names);

}  // namespace delos::benchmark
