// SPDX-License-Identifier: BSD-3-Clause
#include <span>

#include "handle.hpp"

using delos::c::call;
using delos::c::need;
using delos::c::Refusal;

namespace {

/// The item's handle, taken anew.
delos_field* taken(delos_state& state, const std::string& name) {
  delos::Field field = state.state->field(name);
  std::unique_ptr<delos_field>& kept = state.fields[field.name()];
  if (kept) {
    kept->field = std::move(field);
  } else {
    kept = std::make_unique<delos_field>(std::move(field));
  }
  return kept.get();
}

std::span<const double> values_of(const double* values, int64_t size) {
  need(values, "values");
  if (size < 0) {
    throw Refusal{DELOS_ERROR_ARGUMENT, "size = " + std::to_string(size) + ": must be >= 0"};
  }
  return {values, static_cast<std::size_t>(size)};
}

std::vector<double> axis_of(const double* values, int64_t size) {
  const auto span = values_of(values, size);
  return {span.begin(), span.end()};
}

}  // namespace

int delos_state_size(const delos_state* state, int64_t* n) {
  return call(state, __func__, [&] {
    need(n, "n");
    *n = state->state->size();
  });
}

int delos_state_name(delos_state* state, int64_t i, const char** name) {
  if (name != nullptr) *name = nullptr;
  return call(state, __func__, [&] {
    need(name, "name");
    const int64_t n = state->state->size();
    if (i < 0 || i >= n) {
      throw Refusal{DELOS_ERROR_ARGUMENT, "i = " + std::to_string(i) + ": the state has " +
                                              std::to_string(n) + " items, from 0"};
    }
    const std::string own = state->state->names()[static_cast<std::size_t>(i)];
    // Its handle is not taken anew by a look at its name.
    const auto found = state->fields.find(own);
    const delos_field* const field =
        found == state->fields.end() ? taken(*state, own) : found->second.get();
    *name = field->field->name().c_str();
  });
}

int delos_state_contains(const delos_state* state, const char* name, int* flag) {
  return call(state, __func__, [&] {
    need(name, "name");
    need(flag, "flag");
    *flag = state->state->contains(name) ? 1 : 0;
  });
}

int delos_state_field(delos_state* state, const char* name, delos_field** field) {
  if (field != nullptr) *field = nullptr;
  return call(state, __func__, [&] {
    need(name, "name");
    need(field, "field");
    const bool is_there = state->state->contains(name);
    try {
      *field = taken(*state, name);
    } catch (const delos::Error& error) {
      if (is_there) throw;
      throw Refusal{DELOS_ERROR_NOT_FOUND, error.what()};
    }
  });
}

#define DELOS_FIELD_TEXT(name)                                          \
  int delos_field_##name(const delos_field* field, const char** text) { \
    if (text != nullptr) *text = nullptr;                               \
    return call(field, __func__, [&] {                                  \
      need(text, "text");                                               \
      *text = field->field->name().c_str();                             \
    });                                                                 \
  }
DELOS_FIELD_TEXT(name)
DELOS_FIELD_TEXT(standard_name)
DELOS_FIELD_TEXT(units)
DELOS_FIELD_TEXT(long_name)
#undef DELOS_FIELD_TEXT

// NOLINTBEGIN(bugprone-macro-parentheses): a type can't stand in them
#define DELOS_FIELD_NUMBER(name, type)                            \
  int delos_field_##name(const delos_field* field, type* value) { \
    return call(field, __func__, [&] {                            \
      need(value, #name);                                         \
      *value = static_cast<type>(field->field->name());           \
    });                                                           \
  }
DELOS_FIELD_NUMBER(location, int)
DELOS_FIELD_NUMBER(n_components, int64_t)
DELOS_FIELD_NUMBER(n_points, int64_t)
DELOS_FIELD_NUMBER(generation, int64_t)
DELOS_FIELD_NUMBER(has_data, int)
DELOS_FIELD_NUMBER(is_updated, int)
#undef DELOS_FIELD_NUMBER
// NOLINTEND(bugprone-macro-parentheses)

int delos_field_time_stamp(delos_field* field, const char** text) {
  if (text != nullptr) *text = nullptr;
  return call(field, __func__, [&] {
    need(text, "text");
    const std::optional<delos::Time> stamp = field->field->time_stamp();
    field->time_stamp = stamp ? stamp->text() : "";
    *text = field->time_stamp.c_str();
  });
}

int delos_field_data(const delos_field* field, const double** values, int64_t* size) {
  if (values != nullptr) *values = nullptr;
  return call(field, __func__, [&] {
    need(values, "values");
    const std::span<const double> data = field->field->data();
    *values = data.data();
    if (size != nullptr) *size = static_cast<int64_t>(data.size());
  });
}

int delos_field_place_on_lat_lon(delos_field* field, const double* lon_deg, int64_t n_lon,
                                 const double* lat_deg, int64_t n_lat) {
  return call(field, __func__, [&] {
    field->field->place_on_lat_lon(axis_of(lon_deg, n_lon), axis_of(lat_deg, n_lat));
  });
}

int delos_field_bind(delos_field* field, const double* values, int64_t size) {
  return call(field, __func__, [&] { field->field->bind(values_of(values, size)); });
}

int delos_field_store(delos_field* field, const double* values, int64_t size) {
  return call(field, __func__, [&] { field->field->store(values_of(values, size)); });
}

int delos_field_stamp(delos_field* field, const char* time, const char* calendar) {
  return call(field, __func__, [&] {
    need(time, "time");
    const delos::Calendar counted =
        calendar == nullptr ? delos::Calendar::gregorian : delos::parse_calendar(calendar);
    field->field->stamp(delos::Time::parse(time, counted));
  });
}
