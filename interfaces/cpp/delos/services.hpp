// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The component's phases as ESMF registers them (SetServices, SetEntryPoint), for drivers that call
// phases by method and number and know no component's own functions:
//
//   std::vector<delos::EntryPoint> table;
//   delos::set_services([&](delos::EntryPoint entry) { table.push_back(std::move(entry)); });
//   for (const delos::EntryPoint& entry : table) {
//     if (entry.method == delos::Method::initialize) entry.call(component, imports, exports,
//     clock);
//   }
#include <functional>
#include <string>

#include "delos/clock.hpp"
#include "delos/component.hpp"
#include "delos/export.hpp"
#include "delos/state.hpp"

namespace delos::api {

/// ESMF's methods, with its numbers (ESMF_METHOD_INITIALIZE, ...).
enum class Method { initialize = 1, run = 2, finalize = 3, write_restart = 4, read_restart = 5 };

/// "initialize", "run", "finalize", "write_restart" or "read_restart".
DELOS_API const char* to_string(Method method);

/// What is called at a phase, in ESMF's shape. The states are the component's own, the clock is the
/// host's, who advances it; read_restart alone changes it. Throws as the component's function; a
/// cap returns esmf_code(error.kind()).
using PhaseRoutine = std::function<void(Component& component, const State& import_state,
                                        const State& export_state, Clock& clock)>;

struct EntryPoint {
  Method method;
  int phase;          ///< of its method, from 1
  std::string label;  ///< "advertise", "realize", else the method's name
  PhaseRoutine call;
};

/// Hands every phase to `set_entry_point`, in the order of a component's life: initialize 1
/// (advertise) and 2 (realize), run 1, finalize 1; and, when `restart_path` is given, write_restart
/// 1 and read_restart 1, whose file it names by the clock of the call. The routines serve any
/// component. Throws what the arguments throw.
DELOS_API void set_services(const std::function<void(EntryPoint)>& set_entry_point,
                            const std::function<std::string(const Clock&)>& restart_path = {});

}  // namespace delos::api

#ifndef DELOS_BUILDING_LIBRARY
namespace delos {
using api::EntryPoint;
using api::Method;
using api::PhaseRoutine;
using api::set_services;
using api::to_string;
}  // namespace delos
#endif
