// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace delos::benchmark {

/// What one pair of grids costs on one number of threads.
struct RemapTiming {
  struct PhaseSeconds {
    std::string phase;
    double wall_s = 0.0;
    double user_s = 0.0;  ///< of the processor, without the kernel's
  };
  std::string name;
  int threads = 1;
  std::int64_t n_sources = 0, n_targets = 0, n_overlaps = 0;
  std::vector<PhaseSeconds> phases;  ///< the least of each over the rounds
  std::string digest;                ///< of overlaps, weights and fields: the same for any threads
};

/// Grids of 60 and 30 km, 160 000 and 650 000 cells: "coarsen" carries from the fine one to the
/// coarse one, "refine" the other way, "coarsen_wgs84" on WGS 84. Phases: `intersect` (with
/// balancing), `first` (its weights), `gradients` (what the second order needs), `second` (its
/// weights), `transpose` (of first order), `apply_first` and `apply_second` (one field by weights),
/// `apply_limited` (one field, second order with the limiter). `names`: only these; all when empty.
std::vector<RemapTiming> time_remap(std::span<const int> threads, int rounds,
                                    std::span<const std::string> names);

}  // namespace delos::benchmark
