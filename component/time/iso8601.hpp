// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Times and intervals as text after ISO 8601, both ways and exact: parse(iso_text(x)) = x.
#include <string>
#include <string_view>

#include "time/interval.hpp"
#include "time/time.hpp"

namespace delos {

/// "2000-02-29T06:30:00". A fraction of a second is decimal where nine digits hold it, else a ratio
/// as ESMF writes it: "05.25", "05:1/3".
std::string iso_text(const Time& time);
/// "P1Y2M10DT2H30M0S", every unit, each part with its sign, as ESMF writes it.
std::string iso_text(const TimeInterval& interval);

/// A date, with or without "Thh:mm" or "Thh:mm:ss" and a fraction after point, comma or colon.
/// Error(config) that says what is wrong: the form, a time zone, a date that does not exist.
Time parse_time(Calendar calendar, std::string_view text);
/// "P1Y2M10DT2H30M", "P2W", "PT0.5S", "-P1D", "P1M-1D". The last part may have up to nine decimals,
/// unless it is years or months; a ratio may stand for them after T, "PT5:1/3S". Error(config) as
/// above.
TimeInterval parse_interval(std::string_view text);

}  // namespace delos
