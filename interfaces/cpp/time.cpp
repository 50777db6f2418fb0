// SPDX-License-Identifier: BSD-3-Clause
#include "delos/time.hpp"

#include "time/iso8601.hpp"
#include "time_access.hpp"
#include "translate.hpp"

namespace delos::api {
namespace {

delos::Time inner(const Time& time) { return TimeAccess::engine(time); }
delos::TimeInterval inner(const TimeInterval& interval) { return TimeAccess::engine(interval); }

/// function() as a public value, with public errors.
template <class Function>
auto outer(Function&& function) {
  return translated([&] { return TimeAccess::made(function()); });
}

}  // namespace

const char* to_string(Calendar calendar) {
  return delos::to_string(static_cast<delos::Calendar>(calendar));
}

Calendar parse_calendar(const std::string& name) {
  return translated([&] { return static_cast<Calendar>(delos::parse_calendar(name)); });
}

TimeInterval TimeInterval::parse(const std::string& text) {
  return outer([&] { return parse_interval(text); });
}
TimeInterval TimeInterval::of_years(std::int64_t n) {
  return outer([&] { return delos::TimeInterval::of_years(n); });
}
TimeInterval TimeInterval::of_months(std::int64_t n) {
  return outer([&] { return delos::TimeInterval::of_months(n); });
}
TimeInterval TimeInterval::of_days(std::int64_t n) {
  return outer([&] { return delos::TimeInterval::of_days(n); });
}
TimeInterval TimeInterval::of_hours(std::int64_t n) {
  return outer([&] { return delos::TimeInterval::of_hours(n); });
}
TimeInterval TimeInterval::of_minutes(std::int64_t n) {
  return outer([&] { return delos::TimeInterval::of_minutes(n); });
}
TimeInterval TimeInterval::of_seconds(std::int64_t n, std::int64_t numerator,
                                      std::int64_t denominator) {
  return outer([&] { return delos::TimeInterval::of_seconds(n, numerator, denominator); });
}

std::string TimeInterval::text() const {
  return translated([&] { return iso_text(inner(*this)); });
}
TimeInterval TimeInterval::operator+(const TimeInterval& other) const {
  return outer([&] { return inner(*this) + inner(other); });
}
TimeInterval TimeInterval::operator-(const TimeInterval& other) const {
  return outer([&] { return inner(*this) - inner(other); });
}
TimeInterval TimeInterval::operator-() const {
  return outer([&] { return -inner(*this); });
}
TimeInterval TimeInterval::operator*(std::int64_t factor) const {
  return outer([&] { return inner(*this) * factor; });
}
std::strong_ordering TimeInterval::operator<=>(const TimeInterval& other) const {
  return translated([&] { return inner(*this) <=> inner(other); });
}

Time Time::parse(const std::string& text, Calendar calendar) {
  return outer([&] { return parse_time(static_cast<delos::Calendar>(calendar), text); });
}
Time Time::of(const DateTime& when, Calendar calendar) {
  return outer([&] {
    return delos::Time(static_cast<delos::Calendar>(calendar),
                       {when.year, when.month, when.day, when.hour, when.minute, when.second,
                        when.numerator, when.denominator});
  });
}

DateTime Time::date_time() const {
  return translated([&]() -> DateTime {
    const delos::DateTime when = inner(*this).date_time();
    return {when.year,   when.month,  when.day,       when.hour,
            when.minute, when.second, when.numerator, when.denominator};
  });
}
int Time::day_of_year() const {
  return translated([&] { return inner(*this).day_of_year(); });
}
std::string Time::text() const {
  return translated([&] { return iso_text(inner(*this)); });
}
bool Time::operator==(const Time& other) const {
  return translated([&] { return inner(*this) == inner(other); });
}
std::strong_ordering Time::operator<=>(const Time& other) const {
  return translated([&] { return inner(*this) <=> inner(other); });
}
Time Time::operator+(const TimeInterval& interval) const {
  return outer([&] { return inner(*this) + inner(interval); });
}
Time Time::operator-(const TimeInterval& interval) const {
  return outer([&] { return inner(*this) - inner(interval); });
}
TimeInterval Time::operator-(const Time& earlier) const {
  return outer([&] { return inner(*this) - inner(earlier); });
}

}  // namespace delos::api
