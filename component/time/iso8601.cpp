// SPDX-License-Identifier: BSD-3-Clause
#include "time/iso8601.hpp"

#include <array>
#include <charconv>
#include <optional>

#include "core/error.hpp"
#include "time/integers.hpp"

namespace delos {
namespace {

// Nine decimals of a second are written and read: 10^9 is the largest power of ten that is a
// denominator.
constexpr std::int64_t kNano = 1000000000;
constexpr int kMaxDecimals = 9;

// What is left to read. The readers take nothing and say so when the text goes on differently.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : rest_(text) {}
  bool at_end() const { return rest_.empty(); }
  char peek() const { return rest_.empty() ? '\0' : rest_.front(); }

  bool take(char wanted) {
    if (peek() != wanted || rest_.empty()) return false;
    rest_.remove_prefix(1);
    return true;
  }

  // -1 or +1.
  int take_sign() {
    if (take('-')) return -1;
    take('+');
    return 1;
  }

  // An unsigned number of `least` to `most` digits that fits 64 bits.
  std::optional<std::int64_t> take_number(std::size_t least, std::size_t most) {
    std::size_t n = 0;
    while (n < rest_.size() && rest_[n] >= '0' && rest_[n] <= '9') ++n;
    std::int64_t value = 0;
    if (n < least || n > most) return std::nullopt;
    const auto status = std::from_chars(rest_.data(), rest_.data() + n, value);
    if (status.ec != std::errc()) return std::nullopt;
    rest_.remove_prefix(n);
    return value;
  }

  // Decimals after the sign of decimals: ".25" is 25 / 100.
  std::optional<ExactSeconds> take_decimals() {
    const std::size_t before = rest_.size();
    const auto value = take_number(1, kMaxDecimals);
    if (!value) return std::nullopt;
    std::int64_t denominator = 1;
    for (std::size_t n = before - rest_.size(); n > 0; --n) denominator *= 10;
    return ExactSeconds(0, *value, denominator);
  }

  // A proper ratio: "1/3".
  std::optional<ExactSeconds> take_ratio() {
    const auto numerator = take_number(1, 10);
    if (!numerator || !take('/')) return std::nullopt;
    const auto denominator = take_number(1, 10);
    if (!denominator || *numerator >= *denominator || *denominator > kMaxDenominator) {
      return std::nullopt;
    }
    return ExactSeconds(0, *numerator, *denominator);
  }

  // The fraction of a second or of another unit, none is zero.
  std::optional<ExactSeconds> take_fraction(bool with_ratio) {
    if (take('.') || take(',')) return take_decimals();
    if (with_ratio && take(':')) return take_ratio();
    return ExactSeconds();
  }

 private:
  std::string_view rest_;
};

std::string fraction_text(std::int64_t numerator, std::int64_t denominator) {
  if (numerator == 0) return "";
  if (kNano % denominator != 0) {
    return ":" + std::to_string(numerator) + "/" + std::to_string(denominator);
  }
  std::string decimals = digits(numerator * (kNano / denominator), kMaxDecimals);
  decimals.erase(decimals.find_last_not_of('0') + 1);
  return "." + decimals;
}

// --- times

bool take_date(Cursor& cursor, DateTime& when) {
  const bool is_signed = cursor.peek() == '-' || cursor.peek() == '+';
  const int sign = is_signed ? cursor.take_sign() : 1;
  const auto year = cursor.take_number(4, is_signed ? 10 : 4);
  if (!year || !cursor.take('-')) return false;
  const auto month = cursor.take_number(2, 2);
  if (!month || !cursor.take('-')) return false;
  const auto day = cursor.take_number(2, 2);
  if (!day) return false;
  when.year = sign * *year;
  when.month = static_cast<int>(*month);
  when.day = static_cast<int>(*day);
  return true;
}

bool take_time_of_day(Cursor& cursor, DateTime& when) {
  const auto hour = cursor.take_number(2, 2);
  if (!hour || !cursor.take(':')) return false;
  const auto minute = cursor.take_number(2, 2);
  if (!minute) return false;
  when.hour = static_cast<int>(*hour);
  when.minute = static_cast<int>(*minute);
  if (!cursor.take(':')) return true;
  const auto second = cursor.take_number(2, 2);
  if (!second) return false;
  const auto fraction = cursor.take_fraction(true);
  if (!fraction) return false;
  when.second = static_cast<int>(*second);
  when.numerator = fraction->numerator();
  when.denominator = fraction->denominator();
  return true;
}

// --- intervals

struct Unit {
  char letter;
  bool of_day;          // stands after 'T'
  std::int64_t months;  // its length: months or seconds
  std::int64_t seconds;
};

// In the order in which they must come.
constexpr std::array kUnits = {
    Unit{'Y', false, kMonthsPerYear, 0},
    Unit{'M', false, 1, 0},
    Unit{'W', false, 0, 7 * kSecondsPerDay},
    Unit{'D', false, 0, kSecondsPerDay},
    Unit{'H', true, 0, kSecondsPerHour},
    Unit{'M', true, 0, kSecondsPerMinute},
    Unit{'S', true, 0, 1},
};

// Reads part by part, "-2.5H": the amount, then its unit, which must come after those already used.
class IntervalReader {
 public:
  explicit IntervalReader(std::string_view text) : cursor_(text) {}

  std::optional<TimeInterval> read() {
    const int sign = cursor_.take_sign();
    if (!cursor_.take('P')) return std::nullopt;
    do {
      if (!of_day_ && cursor_.take('T')) of_day_ = true;
      if (has_fraction_ || !take_part()) return std::nullopt;
    } while (!cursor_.at_end());
    return sum_ * sign;
  }

 private:
  bool take_part() {
    const int sign = cursor_.take_sign();
    const auto whole = cursor_.take_number(1, 19);
    if (!whole) return false;
    const auto fraction = cursor_.take_fraction(of_day_);
    if (!fraction) return false;
    has_fraction_ = !fraction->is_zero();
    const Unit* const unit = take_unit();
    if (unit == nullptr) return false;
    if (unit->months != 0) {
      if (has_fraction_) return false;
      sum_ = sum_ + TimeInterval::of_months(unit->months) * (sign * *whole);
    } else {
      const ExactSeconds amount = (ExactSeconds(*whole) + *fraction) * unit->seconds;
      sum_ = sum_ + TimeInterval(0, amount) * sign;
    }
    return true;
  }

  const Unit* take_unit() {
    for (; next_ < kUnits.size(); ++next_) {
      const Unit& unit = kUnits[next_];
      if (unit.of_day == of_day_ && cursor_.take(unit.letter)) {
        ++next_;
        return &unit;
      }
    }
    return nullptr;
  }

  Cursor cursor_;
  TimeInterval sum_;
  std::size_t next_ = 0;
  bool of_day_ = false;
  bool has_fraction_ = false;
};

}  // namespace

std::string iso_text(const Time& time) {
  const DateTime when = time.date_time();
  return date_text({when.year, when.month, when.day}) + "T" + digits(when.hour, 2) + ":" +
         digits(when.minute, 2) + ":" + digits(when.second, 2) +
         fraction_text(when.numerator, when.denominator);
}

std::string iso_text(const TimeInterval& interval) {
  const IntervalParts p = parts(interval);
  const bool negative = p.seconds < 0 || p.numerator < 0;
  return "P" + std::to_string(p.years) + "Y" + std::to_string(p.months) + "M" +
         std::to_string(p.days) + "DT" + std::to_string(p.hours) + "H" + std::to_string(p.minutes) +
         "M" + (negative ? "-" : "") + std::to_string(negative ? -p.seconds : p.seconds) +
         fraction_text(negative ? -p.numerator : p.numerator, p.denominator) + "S";
}

Time parse_time(Calendar calendar, std::string_view text) {
  Cursor cursor(text);
  DateTime when;
  bool good = take_date(cursor, when);
  if (good && (cursor.take('T') || cursor.take(' '))) good = take_time_of_day(cursor, when);
  const char next = cursor.peek();
  DELOS_CHECK(!good || (next != 'Z' && next != 'z' && next != '+' && next != '-'),
              ErrorKind::config, "the time '", text,
              "' has a time zone: model times have none. Leave the zone away.");
  DELOS_CHECK(good && cursor.at_end(), ErrorKind::config, "'", text,
              "' is not a time. Write YYYY-MM-DD or YYYY-MM-DDThh:mm:ss, e.g. "
              "2000-01-31T06:30:00.25, with up to nine decimals.");
  return {calendar, when};
}

TimeInterval parse_interval(std::string_view text) {
  const auto interval = IntervalReader(text).read();
  DELOS_CHECK(interval.has_value(), ErrorKind::config, "'", text,
              "' is not an interval. Write it as in P1Y2M10DT2H30M or PT0.5S: units in this order, "
              "a fraction of up to nine decimals in the last one only, not of a year or a month.");
  return *interval;
}

}  // namespace delos
