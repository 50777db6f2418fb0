// SPDX-License-Identifier: BSD-3-Clause
#include "remap/by_key.hpp"

#include <algorithm>
#include <vector>

namespace delos::remap {
namespace {

constexpr std::int64_t kEntryBlock = 65536;  // entries of a task, 0.2 ms
constexpr std::int64_t kRange = 16384;       // keys of a range: their counts fit the nearest cache
constexpr std::int64_t kScanGrain = 65536;

struct Keyed {
  Index key;
  std::uint32_t in_block;  // which of its block's entries
};

// Entries by ranges of keys, those of a range as they came; `first` [n_ranges * n_blocks + 1] says
// where those of a block begin.
Array<Keyed> sort_by_range(parallel::Executor& exec, std::span<const Index> keys,
                           std::int64_t n_ranges, std::vector<std::int64_t>& first) {
  const auto n = static_cast<std::int64_t>(keys.size());
  const std::int64_t n_blocks = (n + kEntryBlock - 1) / kEntryBlock;
  first.assign(at(n_ranges * n_blocks) + 1, 0);
  parallel::for_range(exec, n, kEntryBlock, [&](std::int64_t begin, std::int64_t end) {
    const std::int64_t block = begin / kEntryBlock;
    for (std::int64_t k = begin; k < end; ++k) {
      ++first[at(keys[at(k)] / kRange * n_blocks + block)];
    }
  });
  parallel::scan_counts(exec, kScanGrain, first);
  Array<Keyed> sorted(keys.size());
  parallel::for_range(exec, n, kEntryBlock, [&](std::int64_t begin, std::int64_t end) {
    std::vector<std::int64_t> next(at(n_ranges));
    for (std::int64_t range = 0; range < n_ranges; ++range) {
      next[at(range)] = first[at(range * n_blocks + begin / kEntryBlock)];
    }
    for (std::int64_t k = begin; k < end; ++k) {
      sorted[at(next[at(keys[at(k)] / kRange)]++)] = {keys[at(k)],
                                                      static_cast<std::uint32_t>(k - begin)};
    }
  });
  return sorted;
}

}  // namespace

ByKey sort_by_key(parallel::Executor& exec, std::span<const Index> keys, std::int64_t n_keys) {
  const std::int64_t n_ranges = (n_keys + kRange - 1) / kRange;
  std::vector<std::int64_t> first;
  const Array<Keyed> sorted = sort_by_range(exec, keys, n_ranges, first);
  const std::int64_t n_blocks =
      n_ranges == 0 ? 0 : (static_cast<std::int64_t>(first.size()) - 1) / n_ranges;
  ByKey result;
  result.offsets.resize(at(n_keys) + 1);
  result.offsets.back() = static_cast<std::int64_t>(keys.size());
  result.entry.resize(keys.size());
  parallel::for_range(exec, n_keys, kRange, [&](std::int64_t begin, std::int64_t end) {
    const std::int64_t range = begin / kRange;
    const std::int64_t from = first[at(range * n_blocks)], to = first[at((range + 1) * n_blocks)];
    std::vector<std::int64_t> next(at(end - begin) + 1, 0);
    for (std::int64_t k = from; k < to; ++k) ++next[at(sorted[at(k)].key - begin) + 1];
    next[0] = from;
    for (std::int64_t key = begin; key < end; ++key) {
      next[at(key - begin) + 1] += next[at(key - begin)];
      result.offsets[at(key)] = next[at(key - begin)];
    }
    for (std::int64_t block = 0; block < n_blocks; ++block) {
      const std::int64_t last = first[at(range * n_blocks + block + 1)];
      for (std::int64_t k = first[at(range * n_blocks + block)]; k < last; ++k) {
        const Keyed& one = sorted[at(k)];
        result.entry[at(next[at(one.key - begin)]++)] = block * kEntryBlock + one.in_block;
      }
    }
  });
  return result;
}

}  // namespace delos::remap
