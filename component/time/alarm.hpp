// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What rings when its clock reaches a time, once or at an interval. An alarm lives in a Clock.
#include <cstdint>
#include <optional>

#include "time/state.hpp"
#include "time/time.hpp"

namespace delos {

struct AlarmOptions {
  /// When it rings first; by default an interval after the clock's current time. One of ring_time
  /// and interval must be given.
  std::optional<Time> ring_time = {};
  /// From one ring time to the next, forward; without it the alarm rings once.
  std::optional<TimeInterval> interval = {};
  /// Rings until switched off; else for ring_duration.
  bool sticky = true;
  /// Not backward; zero is until the clock's next step. Only for alarms that are not sticky.
  TimeInterval ring_duration = {};
  bool enabled = true;
};

class Alarm {
 public:
  /// Error(config) for options that contradict each other or the calendar of `now`.
  Alarm(const AlarmOptions& options, const Time& now);
  /// Error(input) when no alarm of a clock that stands at `now` can have this state.
  static Alarm restored(const AlarmState& state, const Time& now);
  AlarmState state() const;

  bool is_ringing() const { return ringing_; }
  /// Whether it rang right after the clock's last step but one, switched off since or not.
  bool was_ringing() const { return rang_before_; }
  bool is_enabled() const { return enabled_; }
  bool is_sticky() const { return sticky_; }
  /// The next time to ring; of an alarm without interval its only one, past or not.
  const Time& ring_time() const { return ring_time_; }
  /// Zero when it rings once.
  const TimeInterval& interval() const { return interval_; }

  void enable() { enabled_ = true; }
  /// Also stops the ringing. Ring times go by unheard.
  void disable();
  /// Rings from now, the clock's current time, on. Error(state) when the alarm is disabled.
  void ringer_on(const Time& now);
  void ringer_off();

 private:
  friend class Clock;

  // Where the clock stands after a step. Before the first one, ring times of the past count.
  struct Tick {
    Time previous, current;
    bool before_first_step;
  };

  explicit Alarm(const Time& ring_time) : ring_time_(ring_time), ring_begin_(ring_time) {}
  // After every step: starts or ends the ringing, finds the next ring time.
  void check(const Tick& tick);
  // Whether a step from one time to the other starts the ringing (a sticky alarm's going on is not
  // meant).
  bool starts_within(const Time& current, const Time& next) const;
  bool is_over(const Time& now) const;
  void move_ring_time_beyond(const Time& now);

  Time ring_time_;
  Time ring_begin_;  // the time of the step that made it ring
  TimeInterval interval_;
  TimeInterval ring_duration_;
  std::int64_t n_steps_ringing_ = 0;
  bool sticky_ = true;
  bool enabled_ = true;
  bool ringing_ = false;
  bool rang_ = false;         // right after the last step
  bool rang_before_ = false;  // right after the one before
};

}  // namespace delos
