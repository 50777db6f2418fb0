// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a component and its host exchange: fields with a name, a unit and a place, in an import and
// an export state. No field copies what its owner keeps.
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "time/time.hpp"

namespace delos {

/// Where a field's values are; `grid` is one value for the whole grid.
enum class Location { cell, edge, vertex, lat_lon, grid };
const char* to_string(Location location);

/// Seen from the component: its host writes imports and reads exports.
enum class Intent { imports, exports };
const char* to_string(Intent intent);

/// What a phase "advertise" says of a field.
struct FieldTraits {
  std::string name;           ///< unique in its state
  std::string standard_name;  ///< CF's where CF has one; may be empty
  std::string units;          ///< UDUNITS, compared as strings
  std::string long_name;
  Location location = Location::cell;
  int n_components = 1;
};

/// Axes of values [n_lat, n_lon]: at least two of each, strictly rising or falling, longitudes
/// within one turn, latitudes within [-90, 90].
struct LatLonAxes {
  std::vector<double> lon_deg, lat_deg;
};

/// Where a field that the grid carries gets its values from.
struct GridValues {
  std::int64_t generation = 0;
  std::int64_t n_points = 0;
  std::span<const double> values;     ///< [n_points, n_components]; empty for imports
  std::shared_ptr<const void> owner;  ///< keeps the values
};

/// One item of a state. Everything that throws leaves it as it was.
class Field {
 public:
  Field(FieldTraits traits, Intent intent);

  const FieldTraits& traits() const { return traits_; }
  Intent intent() const { return intent_; }
  /// Of the grid that it belongs to; 0 while there is none, and for every lat-lon field.
  std::int64_t generation() const { return generation_; }
  /// Places with values; 0 while that is not known.
  std::int64_t n_points() const { return n_points_; }
  bool has_data() const { return !values_.empty(); }
  /// Error(state), naming both generations, when a handle taken at generation `taken` is out of
  /// date. Handles of lat-lon fields never are.
  void check_generation(std::int64_t taken) const;
  /// [n_points, n_components]; Error(state) that says what is missing.
  std::span<const double> data() const;
  const LatLonAxes& axes() const { return axes_; }

  bool is_updated() const { return updated_; }
  const std::optional<Time>& time_stamp() const { return time_stamp_; }
  /// The values are those of this time.
  void stamp(const Time& time);

  // --- the host, on imports; Error(state) on exports
  /// The values will come on a lat-lon grid, not on cells; forgets values bound before.
  /// Error(input) for axes that are none.
  void place_on(LatLonAxes axes);
  /// Refers to the host's values, which must live until the next bind or store, the next grid, or
  /// finalize. Error(input) for another size.
  void bind(std::span<const double> values);
  /// Copies the values into storage of the field's own.
  void store(std::span<const double> values);

  // --- the component
  void attach(const GridValues& grid) noexcept;
  /// The grid is gone, and all values with it.
  void release() noexcept;

 private:
  void check_values(std::span<const double> values) const;
  std::string label() const;

  FieldTraits traits_;
  Intent intent_;
  LatLonAxes axes_;
  std::int64_t generation_ = 0;
  std::int64_t n_points_ = 0;
  std::span<const double> values_;
  std::shared_ptr<const void> owner_;
  bool updated_ = false;
  std::optional<Time> time_stamp_;
};

/// Items by unique name. They stay the same objects from the first advertise to the component's
/// end, so a handle can tell when what it was taken for is gone.
class State {
 public:
  explicit State(Intent intent) : intent_(intent) {}

  Intent intent() const { return intent_; }
  /// In the order of their declaration.
  const std::vector<std::shared_ptr<Field>>& items() const { return items_; }
  /// Error(config) when the name is empty or taken, or a unit is missing.
  void declare(const FieldTraits& traits);
  /// By name, else by standard name; null when absent.
  std::shared_ptr<Field> find(const std::string& name) const;
  /// As find. Error(state) when absent, which lists what there is: ESMF's code for it is 41,
  /// ESMF_RC_NOT_FOUND. Error(state) for a standard name that several items have.
  std::shared_ptr<Field> item(const std::string& name) const;

 private:
  Intent intent_;
  std::vector<std::shared_ptr<Field>> items_;
};

}  // namespace delos
