// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Model time: from start in steps, with alarms. A value: copies share nothing.
#include <cstdint>
#include <optional>
#include <vector>

#include "time/alarm.hpp"
#include "time/state.hpp"
#include "time/time.hpp"

namespace delos {

struct ClockOptions {
  Time start;
  /// Without it the clock is never done.
  std::optional<Time> stop = {};
  /// Forward; may have months.
  TimeInterval step = {};
};

/// The semantics are those of ESMF's clock in its forward direction; README.md lists the
/// differences. What throws leaves the clock as it was.
class Clock {
 public:
  /// Error(config) for a step that is not forward, a stop not after start, or of another calendar.
  explicit Clock(const ClockOptions& options);
  /// Error(input) when no clock can have this state.
  static Clock restored(const ClockState& state);
  ClockState state() const;

  const Time& start() const { return start_; }
  const std::optional<Time>& stop() const { return stop_; }
  const TimeInterval& step() const { return step_; }
  const Time& current() const { return current_; }
  /// The current time before the last step; start before the first.
  const Time& previous() const { return previous_; }
  /// The current time after a step of this clock, or after another step.
  Time next() const { return current_ + step_; }
  Time next(const TimeInterval& step) const { return current_ + step; }
  std::int64_t advance_count() const { return advance_count_; }
  /// Whether stop is reached or passed.
  bool is_done() const { return stop_ && current_ >= *stop_; }

  /// After start and not before the current time; without a value the clock is never done.
  void set_stop(const std::optional<Time>& stop);
  void set_step(const TimeInterval& step);

  /// One step, of this clock's length or another; then all alarms are checked. Beyond stop, too.
  void advance() { advance(step_); }
  void advance(const TimeInterval& step);

  /// The alarm's id, from 0. A ring time that a clock not yet advanced has reached rings at once.
  int add_alarm(const AlarmOptions& options);
  int n_alarms() const { return static_cast<int>(alarms_.size()); }
  /// Error(state) for an unknown id. References hold until the next add_alarm.
  const Alarm& alarm(int id) const;
  Alarm& alarm(int id);
  /// Ids in ascending order.
  std::vector<int> ringing_alarms() const;
  /// Whether the alarm reaches its ring time with the next step, or with a step of this length.
  bool will_ring_next(int id) const { return will_ring_next(id, step_); }
  bool will_ring_next(int id, const TimeInterval& step) const;

 private:
  Time start_;
  Time current_;
  Time previous_;
  std::optional<Time> stop_;
  TimeInterval step_;
  std::int64_t advance_count_ = 0;
  std::vector<Alarm> alarms_;
};

}  // namespace delos
