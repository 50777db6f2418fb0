// SPDX-License-Identifier: BSD-3-Clause
#include "time/clock.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "time/iso8601.hpp"

namespace delos {
namespace {

void check_step(const TimeInterval& step) {
  DELOS_CHECK(step.is_positive(), ErrorKind::config, "the step of a clock is ", iso_text(step),
              ": must be longer than zero, with no part negative, e.g. PT1H.");
}

}  // namespace

Clock::Clock(const ClockOptions& options)
    : start_(options.start), current_(options.start), previous_(options.start) {
  set_stop(options.stop);
  set_step(options.step);
}

Clock Clock::restored(const ClockState& state) {
  const Calendar calendar = calendar_of(state.calendar);
  const TimeInterval step = interval_of(state.step);
  Clock clock({.start = time_of(calendar, state.start), .step = TimeInterval::of_seconds(1)});
  clock.step_ = step;
  clock.current_ = time_of(calendar, state.current);
  clock.previous_ = time_of(calendar, state.previous);
  clock.advance_count_ = state.advance_count;
  // Read even when it does not count, so that only one state is good.
  const Time stop = time_of(calendar, state.stop);
  const bool has_stop = flag_of(state.has_stop, "has_stop");
  if (has_stop) clock.stop_ = stop;
  const bool is_fresh = clock.current_ == clock.start_ && clock.previous_ == clock.start_;
  const bool has_moved = clock.previous_ >= clock.start_ && clock.current_ > clock.previous_;
  DELOS_CHECK(step.is_positive() && (state.advance_count == 0 ? is_fresh : has_moved) &&
                  state.advance_count >= 0 &&
                  (has_stop ? stop > clock.start_ : stop == clock.start_),
              ErrorKind::input, "the clock in the restart contradicts itself: from ",
              iso_text(clock.start_), " over ", iso_text(clock.previous_), " to ",
              iso_text(clock.current_), " in ", std::to_string(state.advance_count), " steps of ",
              iso_text(step), ". The file is damaged, take another one.");
  clock.alarms_.reserve(state.alarms.size());
  for (const AlarmState& alarm : state.alarms) {
    clock.alarms_.push_back(Alarm::restored(alarm, clock.current_));
  }
  return clock;
}

ClockState Clock::state() const {
  ClockState state{static_cast<std::int64_t>(start_.calendar()),
                   state_of(start_),
                   state_of(current_),
                   state_of(previous_),
                   stop_ ? 1 : 0,
                   state_of(stop_ ? *stop_ : start_),
                   state_of(step_),
                   advance_count_,
                   {}};
  state.alarms.reserve(alarms_.size());
  for (const Alarm& alarm : alarms_) state.alarms.push_back(alarm.state());
  return state;
}

void Clock::set_stop(const std::optional<Time>& stop) {
  if (stop) {
    DELOS_CHECK(*stop > start_, ErrorKind::config, "the stop of a clock is ", iso_text(*stop),
                ", its start ", iso_text(start_), ": the stop must be later.");
    DELOS_CHECK(*stop >= current_, ErrorKind::config, "the stop of a clock is set to ",
                iso_text(*stop), ", but it stands at ", iso_text(current_),
                " already. Give a later stop.");
  }
  stop_ = stop;
}

void Clock::set_step(const TimeInterval& step) {
  check_step(step);
  step_ = step;
}

void Clock::advance(const TimeInterval& step) {
  check_step(step);
  const Alarm::Tick tick{current_, next(step), false};
  // On a copy, for a ring time may leave the range of years; copied back, for references to stay.
  std::vector<Alarm> alarms = alarms_;
  for (Alarm& alarm : alarms) alarm.check(tick);
  std::copy(alarms.begin(), alarms.end(), alarms_.begin());
  previous_ = current_;
  current_ = tick.current;
  ++advance_count_;
}

int Clock::add_alarm(const AlarmOptions& options) {
  Alarm alarm(options, current_);
  alarm.check({previous_, current_, advance_count_ == 0});
  alarms_.push_back(alarm);
  return n_alarms() - 1;
}

const Alarm& Clock::alarm(int id) const {
  DELOS_CHECK(
      id >= 0 && id < n_alarms(), ErrorKind::state, "a clock has no alarm ", std::to_string(id),
      n_alarms() == 0
          ? ": add_alarm was not called."
          : ": ids are those that add_alarm gave, 0 to " + std::to_string(n_alarms() - 1) + ".");
  return alarms_[static_cast<std::size_t>(id)];
}

Alarm& Clock::alarm(int id) { return const_cast<Alarm&>(std::as_const(*this).alarm(id)); }

std::vector<int> Clock::ringing_alarms() const {
  std::vector<int> ids;
  for (int id = 0; id < n_alarms(); ++id) {
    if (alarm(id).is_ringing()) ids.push_back(id);
  }
  return ids;
}

bool Clock::will_ring_next(int id, const TimeInterval& step) const {
  check_step(step);
  return alarm(id).starts_within(current_, next(step));
}

}  // namespace delos
