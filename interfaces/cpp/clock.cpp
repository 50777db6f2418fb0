// SPDX-License-Identifier: BSD-3-Clause
#include "delos/clock.hpp"

#include <utility>

#include "clock_access.hpp"
#include "time/state.hpp"
#include "time_access.hpp"
#include "translate.hpp"

namespace delos::api {
namespace {

std::optional<delos::Time> inner(const std::optional<Time>& time) {
  if (!time) return std::nullopt;
  return TimeAccess::engine(*time);
}

std::shared_ptr<ClockImpl> made(const ClockOptions& options) {
  return translated([&] {
    return std::make_shared<ClockImpl>(
        ClockImpl{delos::Clock({.start = TimeAccess::engine(options.start),
                                .stop = inner(options.stop),
                                .step = TimeAccess::engine(options.step)})});
  });
}

/// A clock that was read from a restart file may have fewer alarms than handles know of.
delos::Alarm& alarm_of(ClockImpl& clock, int id) {
  return *translated([&] { return &clock.clock.alarm(id); });
}

}  // namespace

Alarm::Alarm(std::shared_ptr<ClockImpl> clock, int id) : clock_(std::move(clock)), id_(id) {}
bool Alarm::is_ringing() const { return alarm_of(*clock_, id_).is_ringing(); }
bool Alarm::was_ringing() const { return alarm_of(*clock_, id_).was_ringing(); }
bool Alarm::is_enabled() const { return alarm_of(*clock_, id_).is_enabled(); }
bool Alarm::is_sticky() const { return alarm_of(*clock_, id_).is_sticky(); }
Time Alarm::ring_time() const { return TimeAccess::made(alarm_of(*clock_, id_).ring_time()); }
TimeInterval Alarm::interval() const { return TimeAccess::made(alarm_of(*clock_, id_).interval()); }
void Alarm::enable() { alarm_of(*clock_, id_).enable(); }
void Alarm::disable() { alarm_of(*clock_, id_).disable(); }
void Alarm::ringer_on() {
  translated([&] { alarm_of(*clock_, id_).ringer_on(clock_->clock.current()); });
}
void Alarm::ringer_off() { alarm_of(*clock_, id_).ringer_off(); }

Clock::Clock(const ClockOptions& options) : impl_(made(options)) {}
Clock::Clock(const Clock& other) : impl_(std::make_shared<ClockImpl>(*other.impl_)) {}
Clock::Clock(Clock&& other) noexcept = default;
Clock& Clock::operator=(const Clock& other) { return *this = Clock(other); }
Clock& Clock::operator=(Clock&& other) noexcept = default;
Clock::~Clock() = default;

Time Clock::start() const { return TimeAccess::made(impl_->clock.start()); }
std::optional<Time> Clock::stop() const {
  if (!impl_->clock.stop()) return std::nullopt;
  return TimeAccess::made(*impl_->clock.stop());
}
TimeInterval Clock::step() const { return TimeAccess::made(impl_->clock.step()); }
Time Clock::current() const { return TimeAccess::made(impl_->clock.current()); }
Time Clock::previous() const { return TimeAccess::made(impl_->clock.previous()); }
Time Clock::next() const {
  return translated([&] { return TimeAccess::made(impl_->clock.next()); });
}
std::int64_t Clock::advance_count() const { return impl_->clock.advance_count(); }
bool Clock::is_done() const { return impl_->clock.is_done(); }

void Clock::set_stop(const std::optional<Time>& stop) {
  translated([&] { impl_->clock.set_stop(inner(stop)); });
}
void Clock::set_step(const TimeInterval& step) {
  translated([&] { impl_->clock.set_step(TimeAccess::engine(step)); });
}
void Clock::advance() {
  translated([&] { impl_->clock.advance(); });
}

Alarm Clock::add_alarm(const AlarmOptions& options) {
  return translated([&] {
    delos::AlarmOptions wanted{.ring_time = inner(options.ring_time),
                               .interval = std::nullopt,
                               .sticky = options.sticky,
                               .ring_duration = TimeAccess::engine(options.ring_duration),
                               .enabled = options.enabled};
    if (options.interval) wanted.interval = TimeAccess::engine(*options.interval);
    return Alarm(impl_, impl_->clock.add_alarm(wanted));
  });
}
int Clock::n_alarms() const { return impl_->clock.n_alarms(); }
Alarm Clock::alarm(int id) const {
  translated([&] { static_cast<void>(impl_->clock.alarm(id)); });
  return {impl_, id};
}
std::vector<int> Clock::ringing_alarms() const { return impl_->clock.ringing_alarms(); }

std::vector<std::int64_t> Clock::state() const { return integers_of(impl_->clock.state()); }
void Clock::restore(const std::vector<std::int64_t>& state) {
  translated([&] { impl_->clock = delos::Clock::restored(clock_state_of(state)); });
}

}  // namespace delos::api
