// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A clock with alarms, with the semantics of ESMF's.
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "delos/export.hpp"
#include "delos/time.hpp"

namespace delos::api {

struct ClockAccess;
struct ClockImpl;

struct AlarmOptions {
  /// When it rings first; by default an interval after the clock's current time. One of ring_time
  /// and interval must be given.
  std::optional<Time> ring_time = {};
  /// From one ring time to the next, forward; without it the alarm rings once.
  std::optional<TimeInterval> interval = {};
  /// Rings until switched off; else for ring_duration.
  bool sticky = true;
  /// Zero is until the clock's next step. Only for alarms that are not sticky.
  TimeInterval ring_duration = {};
  bool enabled = true;
};

/// A handle of an alarm; it keeps its clock's alarms, and copies are the same alarm. Error(state)
/// when a restart file gave its clock fewer alarms.
class DELOS_API Alarm {
 public:
  /// In its clock, from 0.
  int id() const { return id_; }
  /// As of the clock's last step.
  bool is_ringing() const;
  /// Whether it rang right after the clock's last step but one.
  bool was_ringing() const;
  bool is_enabled() const;
  bool is_sticky() const;
  /// The next time to ring; of one that rings once its only one, past or not.
  Time ring_time() const;
  /// Zero when it rings once.
  TimeInterval interval() const;

  /// Rings again, from its next ring time on.
  void enable();
  /// Also stops the ringing; ring times go by unheard.
  void disable();
  /// Rings from the clock's current time on. Error(state) when it is disabled.
  void ringer_on();
  /// Until the next ring time.
  void ringer_off();

 private:
  friend class Clock;
  Alarm(std::shared_ptr<ClockImpl> clock, int id);
  std::shared_ptr<ClockImpl> clock_;
  int id_;
};

struct ClockOptions {
  Time start;
  /// Without it the clock is never done.
  std::optional<Time> stop = {};
  /// Forward; may have months.
  TimeInterval step = {};
};

/// A value: copies share nothing, not even alarms. What throws leaves it as it was.
class DELOS_API Clock {
 public:
  /// Error(config) for a step that is not forward, a stop not after start, or of another calendar.
  explicit Clock(const ClockOptions& options);
  Clock(const Clock& other);
  Clock(Clock&& other) noexcept;
  Clock& operator=(const Clock& other);
  Clock& operator=(Clock&& other) noexcept;
  ~Clock();

  Time start() const;
  std::optional<Time> stop() const;
  TimeInterval step() const;
  Time current() const;
  /// The current time before the last step; start before the first.
  Time previous() const;
  /// The current time after the next step.
  Time next() const;
  std::int64_t advance_count() const;
  /// Whether stop is reached or passed.
  bool is_done() const;

  /// After start and not before the current time, else Error(config); without a value the clock is
  /// never done.
  void set_stop(const std::optional<Time>& stop);
  /// Of all later steps; Error(config) when it is not forward.
  void set_step(const TimeInterval& step);
  /// One step; then all alarms are checked. Beyond stop, too. Error(config) beyond the range of
  /// years.
  void advance();

  /// Error(config) for options that contradict each other.
  Alarm add_alarm(const AlarmOptions& options);
  /// Alarms are never removed.
  int n_alarms() const;
  /// Error(state) for an unknown id.
  Alarm alarm(int id) const;
  /// Ids in ascending order.
  std::vector<int> ringing_alarms() const;

  /// All of it as plain integers, the alarms too: for other processes.
  std::vector<std::int64_t> state() const;
  /// Becomes the clock that gave this state(), exactly; handles of alarms follow by id.
  /// Error(input) for integers that no clock gives.
  void restore(const std::vector<std::int64_t>& state);

 private:
  friend struct ClockAccess;
  std::shared_ptr<ClockImpl> impl_;
};

}  // namespace delos::api

#ifndef DELOS_BUILDING_LIBRARY
namespace delos {
using api::Alarm;
using api::AlarmOptions;
using api::Clock;
using api::ClockOptions;
}  // namespace delos
#endif
