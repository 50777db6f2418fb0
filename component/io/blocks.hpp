// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Long tables go to a file block after block: while one is written, which one thread alone may do,
// the others convert the next.
#include <array>
#include <cstdint>

#include "core/parallel.hpp"

namespace delos {

/// Rows per task of a conversion: a tenth of a millisecond.
inline constexpr std::int64_t kConvertGrain = 4096;

/// fill(block, k) makes block k and put(block, k) writes it, for k in [0, n_blocks). Each sees them
/// in order; put(k - 1) runs beside fill(k), and that one may hold parallel loops of its own. Two
/// blocks are kept. What either throws is rethrown.
template <class Block, class Fill, class Put>
void stream_blocks(parallel::Executor& exec, std::int64_t n_blocks, Fill&& fill, Put&& put) {
  std::array<Block, 2> blocks;
  const auto block = [&](std::int64_t k) -> Block& {
    return blocks[static_cast<std::size_t>(k % 2)];
  };
  for (std::int64_t k = 0; k <= n_blocks; ++k) {
    exec.run_blocks(2, [&](std::int64_t task) {
      if (task == 0 && k > 0) put(block(k - 1), k - 1);
      if (task == 1 && k < n_blocks) fill(block(k), k);
    });
  }
}

}  // namespace delos
