// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace delos::benchmark {

/// One kernel of the sizing layer on one number of threads.
struct SizingTiming {
  std::string name;
  int threads = 1;
  double seconds = 0.0;  ///< least of the rounds, wall time
  std::int64_t nodes = 0;
  std::string digest;  ///< of what the kernel made: the same for any number of threads
};

/// Times the kernels of the sizing layer on a table of 5 minutes (2161 x 4320 nodes), the numbers
/// of threads in turns within every round. The elevation is the embedded half-degree one with made
/// up detail, so no file is needed. `names`: only these kernels; all when empty.
std::vector<SizingTiming> time_sizing(std::span<const int> threads, int rounds,
                                      std::span<const std::string> names);

}  // namespace delos::benchmark
