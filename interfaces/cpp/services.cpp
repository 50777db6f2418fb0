// SPDX-License-Identifier: BSD-3-Clause
#include "delos/services.hpp"

#include <utility>

namespace delos::api {

const char* to_string(Method method) {
  switch (method) {
    case Method::initialize:
      return "initialize";
    case Method::run:
      return "run";
    case Method::finalize:
      return "finalize";
    case Method::write_restart:
      return "write_restart";
    case Method::read_restart:
      return "read_restart";
  }
  return "unknown";
}

void set_services(const std::function<void(EntryPoint)>& set_entry_point,
                  const std::function<std::string(const Clock&)>& restart_path) {
  const auto set = [&](Method method, int phase, const char* label, PhaseRoutine call) {
    set_entry_point({method, phase, label, std::move(call)});
  };
  set(Method::initialize, 1, "advertise",
      [](Component& component, const State&, const State&, Clock&) {
        component.initialize(InitializePhase::advertise);
      });
  set(Method::initialize, 2, "realize",
      [](Component& component, const State&, const State&, Clock&) {
        component.initialize(InitializePhase::realize);
      });
  set(Method::run, 1, to_string(Method::run),
      [](Component& component, const State& imports, const State& exports, Clock& clock) {
        component.run(imports, exports, clock);
      });
  set(Method::finalize, 1, to_string(Method::finalize),
      [](Component& component, const State&, const State&, Clock&) { component.finalize(); });
  if (!restart_path) return;
  set(Method::write_restart, 1, to_string(Method::write_restart),
      [restart_path](Component& component, const State&, const State&, Clock& clock) {
        component.write_restart(restart_path(clock), clock);
      });
  set(Method::read_restart, 1, to_string(Method::read_restart),
      [restart_path](Component& component, const State&, const State&, Clock& clock) {
        component.read_restart(restart_path(clock), clock);
      });
}

}  // namespace delos::api
