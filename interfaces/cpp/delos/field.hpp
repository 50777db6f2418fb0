// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a component and its host exchange, item by item.
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "delos/export.hpp"
#include "delos/time.hpp"

namespace delos::api {

struct FieldAccess;
struct FieldImpl;

/// Where a field's values are; `grid` is one value for the whole grid.
enum class Location { cell, edge, vertex, lat_lon, grid };

/// "cell", "edge", "vertex", "lat_lon" or "grid".
DELOS_API const char* to_string(Location location);

/// A handle, taken from a State. Copies are the same field. A handle belongs to the generation of
/// the grid at which it was taken: when the component makes a new grid or gives its grid back,
/// data, bind, store and stamp throw Error(state), naming both generations. Handles of fields on a
/// lat-lon grid do not depend on the component's grid.
class DELOS_API Field {
 public:
  /// Unique in its state.
  const std::string& name() const;
  /// CF's, or empty.
  const std::string& standard_name() const;
  /// As UDUNITS reads them, e.g. "m2 s-2".
  const std::string& units() const;
  const std::string& long_name() const;
  Location location() const;
  /// Values of each place, which stand together.
  int n_components() const;
  /// At which this handle was taken; 0 before there was a grid.
  std::int64_t generation() const;
  /// Cells or other places; 0 before there is a grid.
  std::int64_t n_points() const;

  /// Of the handle's generation.
  bool has_data() const;
  /// [n_points, n_components], no copy. Valid until the next generation, or until the host binds
  /// or stores other values. Error(state) when there are none.
  std::span<const double> data() const;

  /// Whether the values are new: made by the component, or stamped.
  bool is_updated() const;
  /// The model time of the values, when somebody said so.
  std::optional<Time> time_stamp() const;

  // --- imports only; Error(state) for exports
  /// The values will come as [n_lat, n_lon] on this grid, not on cells: at least two of each,
  /// strictly rising or falling, less than one turn. Error(input) otherwise.
  void place_on_lat_lon(const std::vector<double>& lon_deg, const std::vector<double>& lat_deg);
  /// Refers to the host's values, which must live until the next bind or store, the next
  /// generation or finalize. Error(input) unless there are n_points * n_components of them.
  void bind(std::span<const double> values);
  /// As bind, but copies the values.
  void store(std::span<const double> values);
  /// The values are those of this time.
  void stamp(const Time& time);

 private:
  friend struct FieldAccess;
  explicit Field(std::shared_ptr<FieldImpl> impl);
  std::shared_ptr<FieldImpl> impl_;
};

}  // namespace delos::api

#ifndef DELOS_BUILDING_LIBRARY
namespace delos {
using api::Field;
using api::Location;
using api::to_string;
}  // namespace delos
#endif
