// SPDX-License-Identifier: BSD-3-Clause
#include "delos/field.hpp"

#include <utility>

#include "field_access.hpp"
#include "time_access.hpp"
#include "translate.hpp"

namespace delos::api {

static_assert(static_cast<int>(Location::cell) == static_cast<int>(delos::Location::cell));
static_assert(static_cast<int>(Location::edge) == static_cast<int>(delos::Location::edge));
static_assert(static_cast<int>(Location::vertex) == static_cast<int>(delos::Location::vertex));
static_assert(static_cast<int>(Location::lat_lon) == static_cast<int>(delos::Location::lat_lon));
static_assert(static_cast<int>(Location::grid) == static_cast<int>(delos::Location::grid));

const char* to_string(Location location) {
  return delos::to_string(static_cast<delos::Location>(location));
}

Field::Field(std::shared_ptr<FieldImpl> impl) : impl_(std::move(impl)) {}

const std::string& Field::name() const { return impl_->field->traits().name; }
const std::string& Field::standard_name() const { return impl_->field->traits().standard_name; }
const std::string& Field::units() const { return impl_->field->traits().units; }
const std::string& Field::long_name() const { return impl_->field->traits().long_name; }
Location Field::location() const { return static_cast<Location>(impl_->field->traits().location); }
int Field::n_components() const { return impl_->field->traits().n_components; }
std::int64_t Field::generation() const { return impl_->generation; }
std::int64_t Field::n_points() const { return impl_->field->n_points(); }

bool Field::has_data() const {
  const bool is_current = impl_->field->generation() == impl_->generation ||
                          impl_->field->traits().location == delos::Location::lat_lon;
  return is_current && impl_->field->has_data();
}

std::span<const double> Field::data() const {
  return translated([&] {
    impl_->field->check_generation(impl_->generation);
    return impl_->field->data();
  });
}

bool Field::is_updated() const { return impl_->field->is_updated(); }

std::optional<Time> Field::time_stamp() const {
  const auto& stamp = impl_->field->time_stamp();
  if (!stamp) return std::nullopt;
  return TimeAccess::made(*stamp);
}

void Field::place_on_lat_lon(const std::vector<double>& lon_deg,
                             const std::vector<double>& lat_deg) {
  translated([&] {
    impl_->field->check_generation(impl_->generation);
    impl_->field->place_on({lon_deg, lat_deg});
  });
}

void Field::bind(std::span<const double> values) {
  translated([&] {
    impl_->field->check_generation(impl_->generation);
    impl_->field->bind(values);
  });
}

void Field::store(std::span<const double> values) {
  translated([&] {
    impl_->field->check_generation(impl_->generation);
    impl_->field->store(values);
  });
}

void Field::stamp(const Time& time) {
  translated([&] {
    impl_->field->check_generation(impl_->generation);
    DELOS_CHECK(impl_->field->intent() == delos::Intent::imports, delos::ErrorKind::state,
                "export field ", name(), " belongs to the component: run stamps it");
    impl_->field->stamp(TimeAccess::engine(time));
  });
}

}  // namespace delos::api
