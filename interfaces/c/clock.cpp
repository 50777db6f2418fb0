// SPDX-License-Identifier: BSD-3-Clause
#include "handle.hpp"

using delos::c::call;
using delos::c::need;

namespace {

delos::Calendar calendar_of(const char* name) {
  return name == nullptr ? delos::Calendar::gregorian : delos::parse_calendar(name);
}

std::optional<delos::Time> time_of(const delos::Clock& clock, const char* text) {
  if (text == nullptr) return std::nullopt;
  return delos::Time::parse(text, clock.start().calendar());
}

std::optional<delos::TimeInterval> interval_of(const char* text) {
  if (text == nullptr) return std::nullopt;
  return delos::TimeInterval::parse(text);
}

/// The text that `made` gives, kept on the clock under the function's name.
template <class Made>
int text_call(const delos_clock* clock, const char* function, const char** text, Made&& made) {
  if (text != nullptr) *text = nullptr;
  return call(clock, function, [&] {
    need(text, "text");
    std::string& kept = clock->texts[function];
    kept = made(*clock->clock);
    *text = kept.c_str();
  });
}

template <class Flag>
int flag_call(const delos_clock* clock, const char* function, int* flag, Flag&& is) {
  return call(clock, function, [&] {
    need(flag, "flag");
    *flag = is(*clock->clock) ? 1 : 0;
  });
}

}  // namespace

int delos_clock_create(delos_context* context, const char* calendar, const char* start,
                       const char* step, delos_clock** clock) {
  if (clock != nullptr) *clock = nullptr;
  return call(context, __func__, [&] {
    need(start, "start");
    need(step, "step");
    need(clock, "clock");
    delos::Clock made({.start = delos::Time::parse(start, calendar_of(calendar)),
                       .stop = std::nullopt,
                       .step = delos::TimeInterval::parse(step)});
    *clock = context->clocks.keep(std::make_unique<delos_clock>(*context, std::move(made)));
  });
}

int delos_clock_destroy(delos_clock* clock) {
  if (clock == nullptr) return DELOS_SUCCESS;
  return call(clock, __func__, [&] {
    clock->clock.reset();
    clock->texts.clear();
    clock->context.clocks.retire(clock);
  });
}

int delos_clock_set_stop(delos_clock* clock, const char* stop) {
  return call(clock, __func__, [&] { clock->clock->set_stop(time_of(*clock->clock, stop)); });
}

int delos_clock_set_step(delos_clock* clock, const char* step) {
  return call(clock, __func__, [&] {
    need(step, "step");
    clock->clock->set_step(delos::TimeInterval::parse(step));
  });
}

int delos_clock_advance(delos_clock* clock) {
  return call(clock, __func__, [&] { clock->clock->advance(); });
}

int delos_clock_is_done(const delos_clock* clock, int* is_done) {
  return flag_call(clock, __func__, is_done, [](const delos::Clock& own) { return own.is_done(); });
}

int delos_clock_advance_count(const delos_clock* clock, int64_t* n_steps) {
  return call(clock, __func__, [&] {
    need(n_steps, "n_steps");
    *n_steps = clock->clock->advance_count();
  });
}

int delos_clock_n_alarms(const delos_clock* clock, int64_t* n) {
  return call(clock, __func__, [&] {
    need(n, "n");
    *n = clock->clock->n_alarms();
  });
}

#define DELOS_CLOCK_TEXT(name, value)                                               \
  int delos_clock_##name(const delos_clock* clock, const char** text) {             \
    return text_call(clock, __func__, text,                                         \
                     [](const delos::Clock& own) -> std::string { return value; }); \
  }
DELOS_CLOCK_TEXT(calendar, delos::to_string(own.start().calendar()))
DELOS_CLOCK_TEXT(start, own.start().text())
DELOS_CLOCK_TEXT(stop, own.stop() ? own.stop()->text() : "")
DELOS_CLOCK_TEXT(step, own.step().text())
DELOS_CLOCK_TEXT(current, own.current().text())
DELOS_CLOCK_TEXT(previous, own.previous().text())
DELOS_CLOCK_TEXT(next, own.next().text())
#undef DELOS_CLOCK_TEXT

int delos_clock_add_alarm(delos_clock* clock, const delos_alarm_options* options, int* id) {
  return call(clock, __func__, [&] {
    need(options, "options");
    const char* const duration = options->ring_duration;
    const delos::Alarm alarm = clock->clock->add_alarm(
        {.ring_time = time_of(*clock->clock, options->ring_time),
         .interval = interval_of(options->interval),
         .sticky = options->not_sticky == 0,
         .ring_duration = interval_of(duration).value_or(delos::TimeInterval()),
         .enabled = options->disabled == 0});
    if (id != nullptr) *id = alarm.id();
  });
}

#define DELOS_ALARM_FLAG(name)                                                       \
  int delos_alarm_##name(const delos_clock* clock, int id, int* flag) {              \
    return flag_call(clock, __func__, flag,                                          \
                     [&](const delos::Clock& own) { return own.alarm(id).name(); }); \
  }
DELOS_ALARM_FLAG(is_ringing)
DELOS_ALARM_FLAG(was_ringing)
DELOS_ALARM_FLAG(is_enabled)
DELOS_ALARM_FLAG(is_sticky)
#undef DELOS_ALARM_FLAG

#define DELOS_ALARM_TEXT(name)                                                              \
  int delos_alarm_##name(const delos_clock* clock, int id, const char** text) {             \
    return text_call(clock, __func__, text,                                                 \
                     [&](const delos::Clock& own) { return own.alarm(id).name().text(); }); \
  }
DELOS_ALARM_TEXT(ring_time)
DELOS_ALARM_TEXT(interval)
#undef DELOS_ALARM_TEXT

#define DELOS_ALARM_ACTION(name)                                           \
  int delos_alarm_##name(delos_clock* clock, int id) {                     \
    return call(clock, __func__, [&] { clock->clock->alarm(id).name(); }); \
  }
DELOS_ALARM_ACTION(enable)
DELOS_ALARM_ACTION(disable)
DELOS_ALARM_ACTION(ringer_on)
DELOS_ALARM_ACTION(ringer_off)
#undef DELOS_ALARM_ACTION
