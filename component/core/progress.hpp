// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a long computation owes its caller: progress, a way to stop it, a log, and phase times.
#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace delos {

/// State of the phase that runs now.
struct Progress {
  std::string phase;       ///< e.g. "refine"
  std::int64_t done = 0;   ///< items finished
  std::int64_t total = 0;  ///< items expected (an estimate; done may pass it), 0 = unknown
  double elapsed_s = 0.0;  ///< since the phase began
};
using ProgressCallback = std::function<void(const Progress&)>;

enum class LogLevel { debug, info, warning, error };
using LogCallback = std::function<void(LogLevel, const std::string&)>;

/// Times of one finished phase.
struct PhaseTime {
  std::string phase;
  double wall_s = 0.0;
  double cpu_s = 0.0;  ///< processor time of the whole process, all its threads together
  std::int64_t items = 0;
};

/// Collects progress from any thread and passes it on, at most ten times a second, one call at a
/// time. All callbacks are optional. Never prints.
class Monitor {
 public:
  Monitor() = default;
  Monitor(ProgressCallback on_progress, LogCallback on_log, const std::atomic<bool>* cancel)
      : on_progress_(std::move(on_progress)), on_log_(std::move(on_log)), cancel_(cancel) {}

  void begin(const std::string& phase, std::int64_t total);
  void advance(std::int64_t n);
  void end();
  /// Throws Error(cancelled) when the caller has asked to stop.
  void check_cancelled() const;
  void log(LogLevel level, const std::string& message) const;
  /// Phases ended so far, in order.
  const std::vector<PhaseTime>& phases() const { return phases_; }

 private:
  using Clock = std::chrono::steady_clock;
  void report();

  ProgressCallback on_progress_;
  LogCallback on_log_;
  const std::atomic<bool>* cancel_ = nullptr;
  std::string phase_;
  std::int64_t total_ = 0;
  std::atomic<std::int64_t> done_{0};
  Clock::time_point start_{};
  double start_cpu_s_ = 0.0;
  std::atomic<std::int64_t> next_report_ns_{0};
  std::mutex reporting_;
  std::vector<PhaseTime> phases_;
};

/// Begins a phase, ends it when the scope is left.
class Phase {
 public:
  Phase(Monitor& monitor, const std::string& phase, std::int64_t total) : monitor_(monitor) {
    monitor_.check_cancelled();
    monitor_.begin(phase, total);
  }
  ~Phase() { monitor_.end(); }
  Phase(const Phase&) = delete;
  Phase& operator=(const Phase&) = delete;

 private:
  Monitor& monitor_;
};

/// What every long function of the engine gets: threads and monitor.
struct Context {
  parallel::Executor& exec;
  Monitor& monitor;
};

}  // namespace delos
