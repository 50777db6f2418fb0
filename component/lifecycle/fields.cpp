// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/fields.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace delos {
namespace {

constexpr double kWholeTurn_deg = 360.0;
constexpr double kPole_deg = 90.0;

bool is_strictly_monotone(const std::vector<double>& axis) {
  const auto is_not_less = [](double a, double b) { return !(a < b); };
  const auto is_not_greater = [](double a, double b) { return !(a > b); };
  return std::adjacent_find(axis.begin(), axis.end(), is_not_less) == axis.end() ||
         std::adjacent_find(axis.begin(), axis.end(), is_not_greater) == axis.end();
}

void check_axis(const std::vector<double>& axis, const char* name) {
  DELOS_CHECK(axis.size() >= 2, ErrorKind::input, name, " has ", axis.size(),
              " values: give at least 2");
  const bool is_finite =
      std::all_of(axis.begin(), axis.end(), [](double value) { return std::isfinite(value); });
  DELOS_CHECK(is_finite && is_strictly_monotone(axis), ErrorKind::input, name,
              ": values must be finite and strictly rising or strictly falling");
}

void check_axes(const LatLonAxes& axes) {
  check_axis(axes.lon_deg, "lon_deg");
  check_axis(axes.lat_deg, "lat_deg");
  const double turn_deg = std::abs(axes.lon_deg.back() - axes.lon_deg.front());
  DELOS_CHECK(turn_deg < kWholeTurn_deg, ErrorKind::input, "lon_deg spans ", turn_deg,
              " degrees: must be less than one turn, the first meridian not repeated");
  for (const double lat_deg : {axes.lat_deg.front(), axes.lat_deg.back()}) {
    DELOS_CHECK(std::abs(lat_deg) <= kPole_deg, ErrorKind::input, "lat_deg holds ", lat_deg,
                ": must be within [-90, 90]");
  }
}

}  // namespace

const char* to_string(Location location) {
  switch (location) {
    case Location::cell:
      return "cell";
    case Location::edge:
      return "edge";
    case Location::vertex:
      return "vertex";
    case Location::lat_lon:
      return "lat_lon";
    case Location::grid:
      return "grid";
  }
  return "unknown";
}

const char* to_string(Intent intent) { return intent == Intent::imports ? "import" : "export"; }

Field::Field(FieldTraits traits, Intent intent) : traits_(std::move(traits)), intent_(intent) {}

std::string Field::label() const { return text(to_string(intent_), " field ", traits_.name); }

void Field::check_generation(std::int64_t taken) const {
  if (taken == generation_ || traits_.location == Location::lat_lon) return;
  const std::string now = generation_ == 0
                              ? "there is no grid now (generation 0, finalized)"
                              : text("the grid is of generation ", generation_, " now");
  throw Error(ErrorKind::state, text("this handle of ", label(), " was taken at generation ", taken,
                                     ", but ", now, ": take the field from its state again"));
}

std::span<const double> Field::data() const {
  if (has_data()) return values_;
  if (n_points_ == 0) {
    throw Error(ErrorKind::state,
                text(label(), " has no grid: initialize(realize) must come first"));
  }
  throw Error(ErrorKind::state, text(label(), " has no values: bind or store ", n_points_, " x ",
                                     traits_.n_components, " first"));
}

void Field::stamp(const Time& time) {
  time_stamp_ = time;
  updated_ = true;
}

void Field::place_on(LatLonAxes axes) {
  DELOS_CHECK(intent_ == Intent::imports, ErrorKind::state, label(),
              " belongs to the component: only imports can be placed");
  check_axes(axes);
  n_points_ = static_cast<std::int64_t>(axes.lon_deg.size() * axes.lat_deg.size());
  axes_ = std::move(axes);
  traits_.location = Location::lat_lon;
  generation_ = 0;
  values_ = {};
  owner_.reset();
  updated_ = false;
  time_stamp_.reset();
}

void Field::check_values(std::span<const double> values) const {
  DELOS_CHECK(intent_ == Intent::imports, ErrorKind::state, label(),
              " belongs to the component: only imports take values");
  DELOS_CHECK(n_points_ > 0, ErrorKind::state, label(),
              " has no place yet: initialize(realize), or place it on a lat-lon grid, first");
  const auto expected = n_points_ * traits_.n_components;
  DELOS_CHECK(static_cast<std::int64_t>(values.size()) == expected, ErrorKind::input, label(),
              ": got ", values.size(), " values, needs ", n_points_, " x ", traits_.n_components,
              " (", to_string(traits_.location), ", generation ", generation_, ")");
  DELOS_CHECK(values.data() != nullptr, ErrorKind::input, label(), ": the pointer is null");
}

void Field::bind(std::span<const double> values) {
  check_values(values);
  values_ = values;
  owner_.reset();
}

void Field::store(std::span<const double> values) {
  check_values(values);
  auto own = std::make_shared<const std::vector<double>>(values.begin(), values.end());
  values_ = *own;
  owner_ = std::move(own);
}

void Field::attach(const GridValues& grid) noexcept {
  if (traits_.location == Location::lat_lon) return;
  generation_ = grid.generation;
  n_points_ = grid.n_points;
  values_ = grid.values;
  owner_ = grid.owner;
  updated_ = !grid.values.empty();
  time_stamp_.reset();
}

void Field::release() noexcept {
  generation_ = 0;
  n_points_ = 0;
  values_ = {};
  owner_.reset();
  updated_ = false;
  time_stamp_.reset();
  axes_ = {};
  // Imports are on cells until their host says otherwise.
  if (traits_.location == Location::lat_lon) traits_.location = Location::cell;
}

void State::declare(const FieldTraits& traits) {
  DELOS_CHECK(!traits.name.empty(), ErrorKind::config, "a field of the ", to_string(intent_),
              " state has no name");
  DELOS_CHECK(!traits.units.empty(), ErrorKind::config, "field ", traits.name,
              " has no units: give \"1\" for a pure number");
  DELOS_CHECK(traits.n_components >= 1, ErrorKind::config, "field ", traits.name, " has ",
              traits.n_components, " components: must be at least 1");
  const bool is_taken = std::any_of(items_.begin(), items_.end(), [&](const auto& item) {
    return item->traits().name == traits.name;
  });
  DELOS_CHECK(!is_taken, ErrorKind::config, "the ", to_string(intent_),
              " state already has a field ", traits.name);
  items_.push_back(std::make_shared<Field>(traits, intent_));
}

std::shared_ptr<Field> State::find(const std::string& name) const {
  if (name.empty()) return nullptr;
  for (const auto& item : items_) {
    if (item->traits().name == name) return item;
  }
  std::shared_ptr<Field> found;
  for (const auto& item : items_) {
    if (item->traits().standard_name != name) continue;
    DELOS_CHECK(!found, ErrorKind::state, "the ", to_string(intent_),
                " state has several fields of standard name ", name, ": ask by name, e.g. ",
                item->traits().name);
    found = item;
  }
  return found;
}

std::shared_ptr<Field> State::item(const std::string& name) const {
  if (auto found = find(name)) return found;
  std::string names;
  for (const auto& item : items_) names += (names.empty() ? "" : ", ") + item->traits().name;
  throw Error(ErrorKind::state,
              text("the ", to_string(intent_), " state has no field \"", name, "\"; ",
                   items_.empty() ? "it is empty: initialize(advertise) must come first"
                                  : "it has " + names));
}

}  // namespace delos
