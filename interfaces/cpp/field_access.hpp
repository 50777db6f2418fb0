// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How the adapters make Fields and States.
#include <memory>

#include "delos/field.hpp"
#include "delos/state.hpp"
#include "lifecycle/fields.hpp"

namespace delos::api {

/// The engine's field, and its generation when this handle was taken.
struct FieldImpl {
  std::shared_ptr<delos::Field> field;
  std::int64_t generation = 0;
};

struct StateImpl {
  std::shared_ptr<delos::State> state;
};

struct FieldAccess {
  static Field make(const std::shared_ptr<delos::Field>& field) {
    return Field(std::make_shared<FieldImpl>(FieldImpl{field, field->generation()}));
  }
};

struct StateAccess {
  static State make(const std::shared_ptr<delos::State>& state) {
    return State(std::make_shared<StateImpl>(StateImpl{state}));
  }
  static const delos::State* engine(const State& state) { return state.impl_->state.get(); }
};

}  // namespace delos::api
