// SPDX-License-Identifier: BSD-3-Clause
#include "core/parallel.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

namespace delos::parallel {

struct Executor::Impl {
  explicit Impl(int n) : n_threads(n), arena(n) {
    // More threads than processors, as tests ask for, need oneTBB's leave; otherwise the number of
    // its workers is none of ours.
    if (n > tbb::info::default_concurrency()) {
      oversubscription = std::make_unique<tbb::global_control>(
          tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(n));
    }
  }
  int n_threads;
  std::unique_ptr<tbb::global_control> oversubscription;
  tbb::task_arena arena;
};

Executor::Executor(int n_threads)
    : impl_(std::make_unique<Impl>(n_threads > 0 ? n_threads : tbb::info::default_concurrency())) {}

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
  // A context of its own, so that a host that cancels its tasks does not cut ours short, and all
  // threads round as this one does, not as the host's tasks around us. Made before a thread of the
  // arena may take over.
  tbb::task_group_context context(
      tbb::task_group_context::isolated,
      tbb::task_group_context::default_traits | tbb::task_group_context::fp_settings);
  impl_->arena.execute([&] {
    // So that a waiting thread does not pick up unrelated work of the host.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::int64_t>(0, n_blocks, 1),
          [&](const tbb::blocked_range<std::int64_t>& blocks) {
            for (std::int64_t block = blocks.begin(); block < blocks.end(); ++block) body(block);
          },
          tbb::simple_partitioner(), context);
    });
  });
}

}  // namespace delos::parallel
