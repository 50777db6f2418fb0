// SPDX-License-Identifier: BSD-3-Clause
#include "handle.hpp"

using delos::c::call;
using delos::c::CancelReset;
using delos::c::need;
using delos::c::need_handle;

namespace {

/// The shells of a state and its fields stay with that of their component.
void empty(delos_state& state) {
  for (const auto& [unused, field] : state.fields) {
    field->magic = delos::c::kDeadMagic;
    field->field.reset();
    field->time_stamp = std::string();
  }
  state.magic = delos::c::kDeadMagic;
  state.state.reset();
}

int hand_out(delos_component* component, const char* function, std::string delos_component::*kept,
             std::string (delos::Component::*say)() const, const char** text) {
  if (text != nullptr) *text = nullptr;
  return call(component, function, [&] {
    need(text, "text");
    component->*kept = (*component->component.*say)();
    *text = (component->*kept).c_str();
  });
}

int hand_out(delos_component* component, const char* function, delos_state delos_component::*which,
             delos_state** state) {
  if (state != nullptr) *state = nullptr;
  return call(component, function, [&] {
    need(state, "state");
    *state = &(component->*which);
  });
}

}  // namespace

int delos_component_create(delos_context* context, const delos_config* config,
                           delos_component** component) {
  if (component != nullptr) *component = nullptr;
  return call(context, __func__, [&] {
    need_handle(config, "config");
    need(component, "component");
    *component = context->components.keep(std::make_unique<delos_component>(
        *context, delos::Component(*config->config, delos::c::options_of(*context))));
  });
}

int delos_component_destroy(delos_component* component) {
  if (component == nullptr) return DELOS_SUCCESS;
  return call(component, __func__, [&] {
    component->component.reset();
    component->time = component->decision = component->failure = std::string();
    empty(component->imports);
    empty(component->exports);
    component->context.components.retire(component);
  });
}

int delos_component_advertise(delos_component* component) {
  return call(component, __func__,
              [&] { component->component->initialize(delos::InitializePhase::advertise); });
}

int delos_component_realize(delos_component* component) {
  return call(component, __func__, [&] {
    const CancelReset reset(component->context);
    component->component->initialize(delos::InitializePhase::realize);
  });
}

int delos_component_initialize(delos_component* component) {
  return call(component, __func__, [&] {
    const CancelReset reset(component->context);
    component->component->initialize();
  });
}

int delos_component_run(delos_component* component, const delos_state* import_state,
                        const delos_state* export_state, const delos_clock* clock) {
  return call(component, __func__, [&] {
    need_handle(import_state, "import_state");
    need_handle(export_state, "export_state");
    need_handle(clock, "clock");
    component->component->run(*import_state->state, *export_state->state, *clock->clock);
  });
}

int delos_component_finalize(delos_component* component) {
  return call(component, __func__, [&] {
    component->component->finalize();
    component->grid = nullptr;
  });
}

int delos_component_write_restart(const delos_component* component, const char* path,
                                  const delos_clock* clock) {
  return call(component, __func__, [&] {
    need(path, "path");
    need_handle(clock, "clock");
    component->component->write_restart(path, *clock->clock);
  });
}

int delos_component_read_restart(delos_component* component, const char* path, delos_clock* clock) {
  return call(component, __func__, [&] {
    need(path, "path");
    need_handle(clock, "clock");
    const CancelReset reset(component->context);
    component->component->read_restart(path, *clock->clock);
  });
}

int delos_component_generation(const delos_component* component, int64_t* generation) {
  return call(component, __func__, [&] {
    need(generation, "generation");
    *generation = component->component->generation();
  });
}

int delos_component_current_time(delos_component* component, const char** text) {
  if (text != nullptr) *text = nullptr;
  return call(component, __func__, [&] {
    need(text, "text");
    const std::optional<delos::Time> time = component->component->current_time();
    component->time = time ? time->text() : "";
    *text = component->time.c_str();
  });
}

int delos_component_remesh_decision(delos_component* component, const char** text) {
  return hand_out(component, __func__, &delos_component::decision,
                  &delos::Component::remesh_decision, text);
}

int delos_component_remesh_failure(delos_component* component, const char** text) {
  return hand_out(component, __func__, &delos_component::failure, &delos::Component::remesh_failure,
                  text);
}

int delos_component_grid(delos_component* component, delos_grid** grid) {
  if (grid != nullptr) *grid = nullptr;
  return call(component, __func__, [&] {
    need(grid, "grid");
    delos::Grid current = component->component->grid();
    if (component->grid == nullptr || component->grid->grid->generation() != current.generation()) {
      component->grid = component->context.grids.keep(
          std::make_unique<delos_grid>(component->context, std::move(current)));
    }
    *grid = component->grid;
  });
}

int delos_component_import_state(delos_component* component, delos_state** state) {
  return hand_out(component, __func__, &delos_component::imports, state);
}

int delos_component_export_state(delos_component* component, delos_state** state) {
  return hand_out(component, __func__, &delos_component::exports, state);
}
