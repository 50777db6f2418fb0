// SPDX-License-Identifier: BSD-3-Clause
#include "time/alarm.hpp"

#include "core/error.hpp"
#include "time/iso8601.hpp"

namespace delos {
namespace {

Time first_ring_time(const AlarmOptions& options, const Time& now) {
  DELOS_CHECK(options.ring_time || options.interval, ErrorKind::config,
              "an alarm has neither a ring time nor an interval: it could never ring. Give one.");
  DELOS_CHECK(!options.interval || options.interval->is_positive(), ErrorKind::config,
              "an alarm has the interval ", options.interval ? iso_text(*options.interval) : "",
              ": must be longer than zero, with no part negative.");
  DELOS_CHECK(options.ring_duration.is_zero() || options.ring_duration.is_positive(),
              ErrorKind::config, "an alarm has the ring duration ", iso_text(options.ring_duration),
              ": no part may be negative. Zero means one step.");
  DELOS_CHECK(options.ring_duration.is_zero() || !options.sticky, ErrorKind::config,
              "a sticky alarm has the ring duration ", iso_text(options.ring_duration),
              ", but rings until it is switched off. Drop the duration, or make it not sticky.");
  return options.ring_time ? *options.ring_time : now + *options.interval;
}

}  // namespace

Alarm::Alarm(const AlarmOptions& options, const Time& now) : Alarm(first_ring_time(options, now)) {
  check_same_calendar(ring_time_, now);
  if (options.interval) interval_ = *options.interval;
  ring_duration_ = options.ring_duration;
  sticky_ = options.sticky;
  enabled_ = options.enabled;
}

Alarm Alarm::restored(const AlarmState& state, const Time& now) {
  Alarm alarm(time_of(now.calendar(), state.ring_time));
  alarm.ring_begin_ = time_of(now.calendar(), state.ring_begin);
  alarm.interval_ = interval_of(state.interval);
  alarm.ring_duration_ = interval_of(state.ring_duration);
  alarm.n_steps_ringing_ = state.n_steps_ringing;
  alarm.sticky_ = flag_of(state.sticky, "sticky");
  alarm.enabled_ = flag_of(state.enabled, "enabled");
  alarm.ringing_ = flag_of(state.ringing, "ringing");
  alarm.rang_ = flag_of(state.rang, "rang");
  alarm.rang_before_ = flag_of(state.rang_before, "rang_before");
  const auto can_be = [](const TimeInterval& x) { return x.is_zero() || x.is_positive(); };
  DELOS_CHECK(can_be(alarm.interval_) && can_be(alarm.ring_duration_) &&
                  (alarm.ring_duration_.is_zero() || !alarm.sticky_) &&
                  alarm.n_steps_ringing_ >= 0 && (alarm.enabled_ || !alarm.ringing_) &&
                  (alarm.interval_.is_zero() || alarm.ring_time_ > now),
              ErrorKind::input, "an alarm in the restart, to ring at ", iso_text(alarm.ring_time_),
              " with the interval ", iso_text(alarm.interval_),
              ", contradicts itself or its clock at ", iso_text(now),
              ". The file is damaged, take another one.");
  return alarm;
}

AlarmState Alarm::state() const {
  return {state_of(ring_time_),     state_of(ring_begin_), state_of(interval_),
          state_of(ring_duration_), n_steps_ringing_,      sticky_ ? 1 : 0,
          enabled_ ? 1 : 0,         ringing_ ? 1 : 0,      rang_ ? 1 : 0,
          rang_before_ ? 1 : 0};
}

void Alarm::disable() {
  enabled_ = false;
  ringer_off();
}

void Alarm::ringer_on(const Time& now) {
  check_same_calendar(ring_time_, now);
  DELOS_CHECK(enabled_, ErrorKind::state,
              "the ringer of a disabled alarm was switched on. Enable the alarm first.");
  ringing_ = true;
  ring_begin_ = now;
}

void Alarm::ringer_off() {
  ringing_ = false;
  n_steps_ringing_ = 0;
}

bool Alarm::starts_within(const Time& current, const Time& next) const {
  return enabled_ && current < ring_time_ && next >= ring_time_;
}

bool Alarm::is_over(const Time& now) const {
  if (ring_duration_.is_zero()) return n_steps_ringing_ >= 1;
  return ring_begin_ + ring_duration_ <= now;
}

void Alarm::check(const Tick& tick) {
  rang_before_ = rang_;
  const bool starts = tick.before_first_step ? enabled_ && tick.current >= ring_time_
                                             : starts_within(tick.previous, tick.current);
  if (starts) {
    ringing_ = true;
    ring_begin_ = tick.current;
  } else if (ringing_ && !sticky_ && is_over(tick.current)) {
    ringer_off();
  }
  if (ringing_) ++n_steps_ringing_;
  rang_ = ringing_;
  move_ring_time_beyond(tick.current);
}

void Alarm::move_ring_time_beyond(const Time& now) {
  if (interval_.is_zero() || ring_time_ > now) return;
  if (interval_.is_absolute()) {
    const ExactSeconds late = (now - ring_time_).seconds();
    ring_time_ = ring_time_ + interval_ * (floor_ratio(late, interval_.seconds()) + 1);
    return;
  }
  // One by one, as a clock steps: the day that a short month has clipped stays clipped.
  while (ring_time_ <= now) ring_time_ = ring_time_ + interval_;
}

}  // namespace delos
