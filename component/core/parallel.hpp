// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Parallel loops whose result does not depend on the number of threads. The only layer that
// knows oneTBB is parallel.cpp behind this header.
//
// Law: work is cut into blocks by `grain` alone, never by the thread count; a body writes only
// the slots of its own indices (lower_to is the exception); reductions combine block results in
// block order.
#include <atomic>
#include <cstdint>
#include <functional>
#include <iterator>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "core/types.hpp"

namespace delos::parallel {

/// Owns the arena that all loops of one instance run in; loops may be nested.
class Executor {
 public:
  /// n_threads <= 0: as many as the machine has.
  explicit Executor(int n_threads = 0);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  int n_threads() const;
  /// Slot of the calling thread in [0, n_threads()), for scratch memory that is reused.
  int thread_slot() const;
  /// Runs body(block) for block in [0, n_blocks), each once, in any order. The first exception
  /// that a body throws is rethrown here after the others have ended.
  void run_blocks(std::int64_t n_blocks, const std::function<void(std::int64_t)>& body);
  /// Runs make(i) in the order of `order`, a permutation of [0, n), several at once, and take(i)
  /// for i = 0, 1, ..., n - 1, one at a time, as soon as make(0) ... make(i) have ended: while some
  /// threads make, one takes. What the takes see depends on neither `order` nor the threads. The
  /// first exception is rethrown as by run_blocks.
  void run_pipeline(std::span<const std::int64_t> order,
                    const std::function<void(std::int64_t)>& make,
                    const std::function<void(std::int64_t)>& take);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// body(begin, end) over [0, n) in blocks of `grain` indices.
template <class Body>
void for_range(Executor& exec, std::int64_t n, std::int64_t grain, Body&& body) {
  const std::int64_t n_blocks = (n + grain - 1) / grain;
  exec.run_blocks(n_blocks, [&](std::int64_t block) {
    const std::int64_t begin = block * grain;
    body(begin, begin + grain < n ? begin + grain : n);
  });
}

/// body(i) for i in [0, n).
template <class Body>
void for_index(Executor& exec, std::int64_t n, std::int64_t grain, Body&& body) {
  for_range(exec, n, grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) body(i);
  });
}

/// Result of combine(...combine(identity, map(block 0))..., map(last block)), in block order:
/// the grain is part of the answer, the thread count is not. map(begin, end) -> T.
template <class T, class Map, class Combine>
// NOLINTNEXTLINE(readability-function-size): six things make a reduction, and T comes from one.
T reduce(Executor& exec, std::int64_t n, std::int64_t grain, T identity, Map&& map,
         Combine&& combine) {
  std::vector<T> partial(static_cast<std::size_t>((n + grain - 1) / grain), identity);
  for_range(exec, n, grain, [&](std::int64_t begin, std::int64_t end) {
    partial[static_cast<std::size_t>(begin / grain)] = map(begin, end);
  });
  T total = std::move(identity);
  for (T& value : partial) total = combine(std::move(total), std::move(value));
  return total;
}

/// Sum of term(i) for i in [0, n); see reduce.
template <class Term>
double sum(Executor& exec, std::int64_t n, std::int64_t grain, Term&& term) {
  return reduce(
      exec, n, grain, 0.0,
      [&](std::int64_t begin, std::int64_t end) {
        double partial = 0.0;
        for (std::int64_t i = begin; i < end; ++i) partial += term(i);
        return partial;
      },
      [](double a, double b) { return a + b; });
}

/// What body(begin, end, found) appends to `found`, block after block: for rare finds in long
/// lists.
template <class T, class Body>
std::vector<T> collect(Executor& exec, std::int64_t n, std::int64_t grain, Body&& body) {
  return reduce(
      exec, n, grain, std::vector<T>{},
      [&](std::int64_t begin, std::int64_t end) {
        std::vector<T> found;
        body(begin, end, found);
        return found;
      },
      [](std::vector<T> all, std::vector<T> more) {
        all.insert(all.end(), std::make_move_iterator(more.begin()),
                   std::make_move_iterator(more.end()));
        return all;
      });
}

/// counts[i] becomes counts[0] + ... + counts[i - 1] for i in [0, n]; n + 1 values, the last of
/// which need not be set before and is the total afterwards.
inline void scan_counts(Executor& exec, std::int64_t grain, std::span<std::int64_t> counts) {
  const auto n = static_cast<std::int64_t>(counts.size()) - 1;
  std::vector<std::int64_t> first(static_cast<std::size_t>((n + grain - 1) / grain) + 1, 0);
  for_range(exec, n, grain, [&](std::int64_t begin, std::int64_t end) {
    std::int64_t sum = 0;
    for (std::int64_t i = begin; i < end; ++i) sum += counts[static_cast<std::size_t>(i)];
    first[static_cast<std::size_t>(begin / grain) + 1] = sum;
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  for_range(exec, n, grain, [&](std::int64_t begin, std::int64_t end) {
    std::int64_t sum = first[static_cast<std::size_t>(begin / grain)];
    for (std::int64_t i = begin; i < end; ++i) {
      sum += std::exchange(counts[static_cast<std::size_t>(i)], sum);
    }
  });
  counts.back() = first.back();
}

/// offsets[i] = count(0) + ... + count(i - 1), n + 1 values; offsets[n] is the total.
template <class Count>
std::vector<std::int64_t> exclusive_scan(Executor& exec, std::int64_t n, std::int64_t grain,
                                         Count&& count) {
  std::vector<std::int64_t> offsets(static_cast<std::size_t>(n) + 1);
  for_index(exec, n, grain,
            [&](std::int64_t i) { offsets[static_cast<std::size_t>(i)] = count(i); });
  scan_counts(exec, grain, offsets);
  return offsets;
}

/// slot = min(slot, value), whichever thread comes first: the one way in which loops may share
/// slots, because the smallest does not depend on their order. kNone counts as the largest.
inline void lower_to(Index& slot, Index value) {
  const std::atomic_ref<Index> shared(slot);
  Index seen = shared.load(std::memory_order_relaxed);
  while (static_cast<std::uint32_t>(value) < static_cast<std::uint32_t>(seen) &&
         !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
  }
}

}  // namespace delos::parallel
