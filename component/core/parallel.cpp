// SPDX-License-Identifier: BSD-3-Clause
#include "core/parallel.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>

namespace delos::parallel {

namespace {

/// A host may ask for any number. oneTBB starts as many, whatever the machine has: a thousand make
/// nothing faster, and it ends the process where the system refuses one.
int most_threads() {
  constexpr int kMostPerProcessor = 4, kAlwaysAllowed = 64;
  return std::max(kAlwaysAllowed, kMostPerProcessor * tbb::info::default_concurrency());
}

using Leave = std::unique_ptr<tbb::global_control>;

/// More threads than processors, as tests ask for, need oneTBB's leave; otherwise the number of its
/// workers is none of ours. The least of all leaves counts, and oneTBB prints when an arena is
/// larger than it, so all ask for the same.
Leave leave_for(int wanted) {
  if (wanted <= tbb::info::default_concurrency()) return nullptr;
  return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                               static_cast<std::size_t>(most_threads()));
}

/// What there is leave for: a host may allow fewer than there are processors.
int allowed_threads(int wanted) {
  if (wanted <= 0) wanted = tbb::info::default_concurrency();
  const auto allowed = static_cast<std::int64_t>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  return static_cast<int>(std::min<std::int64_t>({wanted, most_threads(), allowed}));
}

}  // namespace

struct Executor::Impl {
  explicit Impl(int wanted)
      : oversubscription(leave_for(wanted)), n_threads(allowed_threads(wanted)), arena(n_threads) {}
  /// run(context) by the threads of the arena.
  template <class Run>
  void execute(const Run& run) {
    // A context of its own, so that a host that cancels its tasks does not cut ours short, and all
    // threads round as this one does, not as the host's tasks around us. Made before a thread of
    // the arena may take over.
    tbb::task_group_context context(
        tbb::task_group_context::isolated,
        tbb::task_group_context::default_traits | tbb::task_group_context::fp_settings);
    // So that a waiting thread does not pick up unrelated work of the host.
    arena.execute([&] { tbb::this_task_arena::isolate([&] { run(context); }); });
  }
  Leave oversubscription;
  int n_threads;
  tbb::task_arena arena;
};

namespace {

// Takes things in ascending order that are made in any.
struct InOrder {
  InOrder(std::size_t n, const std::function<void(std::int64_t)>& take_one)
      : is_made(n, 0), take(take_one) {}
  void made(std::int64_t i) {
    is_made[static_cast<std::size_t>(i)] = 1;
    for (; next < is_made.size() && is_made[next] != 0; ++next) {
      take(static_cast<std::int64_t>(next));
    }
  }
  std::vector<char> is_made;
  const std::function<void(std::int64_t)>& take;
  std::size_t next = 0;
};

}  // namespace

Executor::Executor(int n_threads) : impl_(std::make_unique<Impl>(n_threads)) {}

Executor::~Executor() = default;

int Executor::n_threads() const { return impl_->n_threads; }

int Executor::thread_slot() const {
  const int slot = tbb::this_task_arena::current_thread_index();
  return slot >= 0 && slot < impl_->n_threads ? slot : 0;
}

void Executor::run_blocks(std::int64_t n_blocks, const std::function<void(std::int64_t)>& body) {
  if (n_blocks <= 0) return;
  if (n_blocks == 1 || impl_->n_threads == 1) {
    for (std::int64_t block = 0; block < n_blocks; ++block) body(block);
    return;
  }
  impl_->execute([&](tbb::task_group_context& context) {
    tbb::parallel_for(
        tbb::blocked_range<std::int64_t>(0, n_blocks, 1),
        [&](const tbb::blocked_range<std::int64_t>& blocks) {
          for (std::int64_t block = blocks.begin(); block < blocks.end(); ++block) body(block);
        },
        tbb::simple_partitioner(), context);
  });
}

void Executor::run_pipeline(std::span<const std::int64_t> order,
                            const std::function<void(std::int64_t)>& make,
                            const std::function<void(std::int64_t)>& take) {
  InOrder in_order(order.size(), take);
  if (order.size() <= 1 || impl_->n_threads == 1) {
    for (const std::int64_t i : order) {
      make(i);
      in_order.made(i);
    }
    return;
  }
  constexpr std::size_t kTokensPerThread = 2;  // one that is made, one that waits to be taken
  std::size_t n_begun = 0;
  const auto begin = tbb::make_filter<void, std::int64_t>(
      tbb::filter_mode::serial_in_order, [&](tbb::flow_control& flow) -> std::int64_t {
        if (n_begun < order.size()) return order[n_begun++];
        flow.stop();
        return 0;
      });
  const auto make_one =
      tbb::make_filter<std::int64_t, std::int64_t>(tbb::filter_mode::parallel, [&](std::int64_t i) {
        make(i);
        return i;
      });
  const auto end = tbb::make_filter<std::int64_t, void>(tbb::filter_mode::serial_out_of_order,
                                                        [&](std::int64_t i) { in_order.made(i); });
  impl_->execute([&](tbb::task_group_context& context) {
    tbb::parallel_pipeline(kTokensPerThread * static_cast<std::size_t>(impl_->n_threads),
                           begin & make_one & end, context);
  });
}

}  // namespace delos::parallel
