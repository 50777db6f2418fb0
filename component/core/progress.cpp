// SPDX-License-Identifier: BSD-3-Clause
#include "core/progress.hpp"

#include <ctime>

namespace delos {
namespace {

constexpr std::int64_t kReportIntervalNs = 100'000'000;  // ten reports a second

/// Processor seconds of the process so far.
double processor_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

void Monitor::begin(const std::string& phase, std::int64_t total) {
  phase_ = phase;
  total_ = total;
  done_ = 0;
  start_ = Clock::now();
  start_cpu_s_ = processor_s();
  next_report_ns_ = 0;
  report();
}

void Monitor::advance(std::int64_t n) {
  done_.fetch_add(n, std::memory_order_relaxed);
  if (!on_progress_) return;
  const std::int64_t now_ns =
      std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start_).count();
  if (now_ns < next_report_ns_.load(std::memory_order_relaxed)) return;
  const std::unique_lock lock(reporting_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  next_report_ns_ = now_ns + kReportIntervalNs;
  report();
}

void Monitor::end() {
  const double wall_s = std::chrono::duration<double>(Clock::now() - start_).count();
  const double cpu_s = processor_s() - start_cpu_s_;
  report();
  phases_.push_back({phase_, wall_s, cpu_s, done_.load()});
}

void Monitor::check_cancelled() const {
  DELOS_CHECK(cancel_ == nullptr || !cancel_->load(std::memory_order_relaxed), ErrorKind::cancelled,
              "stopped on request during ", phase_.empty() ? "start-up" : phase_,
              "; nothing was written.");
}

void Monitor::log(LogLevel level, const std::string& message) const {
  if (on_log_) on_log_(level, message);
}

void Monitor::report() {
  if (!on_progress_) return;
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
  on_progress_({phase_, done_.load(), total_, elapsed_s});
}

}  // namespace delos
