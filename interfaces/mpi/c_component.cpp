// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "distribution.hpp"
#include "mpi_handle.hpp"
#include "transfer_options.hpp"

using delos::c::need;
using delos::c::need_handle;
using delos::mpi::DistributedComponent;
using delos::mpi::c::call;
using delos::mpi::c::create;

namespace {

/// A collective call: body(component, argument), where argument() may refuse what it was given. The
/// others wait for this process all the same.
template <class Argument, class Body>
int collective(delos_mpi_component* component, const char* function, Argument&& check,
               Body&& body) noexcept {
  return call(component, function, [&](DistributedComponent& own) {
    try {
      check();
    } catch (...) {
      delos::mpi::Distribution::pass_over(own);
      throw;
    }
    body(own);
  });
}

template <class Body>
int collective(delos_mpi_component* component, const char* function, Body&& body) noexcept {
  return call(component, function, std::forward<Body>(body));
}

void hand_out(const std::vector<double>& from, std::span<double> to) {
  if (from.size() != to.size()) {
    throw delos::c::Refusal{DELOS_ERROR_ARGUMENT,
                            "n_values = " + std::to_string(to.size()) +
                                ": must be n_local * n_levels = " + std::to_string(from.size())};
  }
  std::copy(from.begin(), from.end(), to.begin());
}

int hand_out_text(delos_mpi_component* component, const char* function, const char** text,
                  const std::string& (DistributedComponent::*say)() const) noexcept {
  if (text != nullptr) *text = nullptr;
  return call(component, function, [&](const DistributedComponent& own) {
    need(text, "text");
    *text = (own.*say)().c_str();
  });
}

/// The arguments of a transfer as C++ takes them.
struct Carried {
  std::span<const double> former;
  std::span<double> values;
  delos_transfer_options given{};
  delos::TransferOptions options{};
};

Carried carried(std::span<const double> former, std::span<double> values,
                const delos_transfer_options* options) {
  Carried out{former, values, delos::c::or_defaults(options)};
  out.options = delos::c::transfer_options(out.given);
  return out;
}

}  // namespace

int delos_mpi_component_create_file(MPI_Comm comm, const char* path,
                                    const delos_mpi_options* options,
                                    delos_mpi_component** component) {
  return create(__func__, component, [&] {
    return DistributedComponent(
        comm, [&] { return delos::mpi::c::config_from_file(path); },
        delos::mpi::c::options_of(options));
  });
}
int delos_mpi_component_create_file_f(MPI_Fint comm, const char* path,
                                      const delos_mpi_options* options,
                                      delos_mpi_component** component) {
  return delos_mpi_component_create_file(MPI_Comm_f2c(comm), path, options, component);
}
int delos_mpi_component_create_text(MPI_Comm comm, const char* yaml, const char* folder,
                                    const delos_mpi_options* options,
                                    delos_mpi_component** component) {
  return create(__func__, component, [&] {
    return DistributedComponent(
        comm, [&] { return delos::mpi::c::config_from_text(yaml, folder); },
        delos::mpi::c::options_of(options));
  });
}
int delos_mpi_component_create_text_f(MPI_Fint comm, const char* yaml, const char* folder,
                                      const delos_mpi_options* options,
                                      delos_mpi_component** component) {
  return delos_mpi_component_create_text(MPI_Comm_f2c(comm), yaml, folder, options, component);
}

int delos_mpi_component_destroy(delos_mpi_component* component) {
  delete component;
  return DELOS_SUCCESS;
}

const char* delos_mpi_component_last_error(const delos_mpi_component* component) {
  return delos::mpi::c::text_of(component);
}

int delos_mpi_component_advertise(delos_mpi_component* component) {
  return collective(component, __func__, [](DistributedComponent& own) {
    own.initialize(delos::InitializePhase::advertise);
  });
}

int delos_mpi_component_realize(delos_mpi_component* component) {
  return collective(component, __func__, [](DistributedComponent& own) {
    own.initialize(delos::InitializePhase::realize);
  });
}

int delos_mpi_component_initialize(delos_mpi_component* component) {
  return collective(component, __func__, [](DistributedComponent& own) { own.initialize(); });
}

int delos_mpi_component_run(delos_mpi_component* component, const delos_clock* clock,
                            int* is_new_grid) {
  if (is_new_grid != nullptr) *is_new_grid = 0;
  return collective(
      component, __func__, [&] { need_handle(clock, "clock"); },
      [&](DistributedComponent& own) {
        const bool is_new = own.run(*clock->clock);
        if (is_new_grid != nullptr) *is_new_grid = is_new ? 1 : 0;
      });
}

int delos_mpi_component_write_restart(delos_mpi_component* component, const char* path,
                                      const delos_clock* clock) {
  return collective(
      component, __func__, [&] { need_handle(clock, "clock"); },
      [&](DistributedComponent& own) {
        own.write_restart(path == nullptr ? "" : path, *clock->clock);
      });
}

int delos_mpi_component_read_restart(delos_mpi_component* component, const char* path,
                                     delos_clock* clock) {
  return collective(
      component, __func__, [&] { need_handle(clock, "clock"); },
      [&](DistributedComponent& own) {
        own.read_restart(path == nullptr ? "" : path, *clock->clock);
      });
}

int delos_mpi_component_finalize(delos_mpi_component* component) {
  return collective(component, __func__, [](DistributedComponent& own) { own.finalize(); });
}

// NOLINTBEGIN(readability-function-size): arrays and their sizes, as everywhere in C
int delos_mpi_component_transfer(delos_mpi_component* component, const double* former,
                                 int64_t n_former, double* values, int64_t n_values,
                                 const delos_transfer_options* options) {
  Carried with;
  return collective(
      component, __func__,
      [&] {
        with = carried(delos::c::values_of(former, n_former, "former"),
                       delos::c::values_of(values, n_values, "values"), options);
      },
      [&](DistributedComponent& own) {
        hand_out(own.transfer(with.former, with.options), with.values);
      });
}

int delos_mpi_component_transfer_velocity(delos_mpi_component* component, const double* former,
                                          int64_t n_former, double* values, int64_t n_values,
                                          const delos_transfer_options* options) {
  Carried with;
  delos::VelocityRoute route{};
  return collective(
      component, __func__,
      [&] {
        with = carried(delos::c::values_of(former, n_former, "former"),
                       delos::c::values_of(values, n_values, "values"), options);
        route = delos::c::velocity_route(with.given);
      },
      [&](DistributedComponent& own) {
        hand_out(own.transfer_velocity(with.former, route, with.options), with.values);
      });
}
// NOLINTEND(readability-function-size)

int delos_mpi_component_item(delos_mpi_component* component, int intent, int i,
                             delos_mpi_item* item) {
  bool is_there = false;
  const int status = call(component, __func__, [&](const DistributedComponent& own) {
    need(item, "item");
    if (intent != DELOS_MPI_IMPORT && intent != DELOS_MPI_EXPORT) {
      throw delos::c::Refusal{DELOS_ERROR_ARGUMENT, "intent = " + std::to_string(intent) +
                                                        ": must be DELOS_MPI_IMPORT or _EXPORT"};
    }
    const auto& items = intent == DELOS_MPI_IMPORT ? own.imports() : own.exports();
    if (i < 0 || static_cast<std::size_t>(i) >= items.size()) return;
    const delos::mpi::FieldInfo& info = items[static_cast<std::size_t>(i)];
    *item = {info.name.c_str(),      info.standard_name.c_str(),      info.units.c_str(),
             info.long_name.c_str(), static_cast<int>(info.location), info.n_components};
    is_there = true;
  });
  return status == DELOS_SUCCESS && !is_there ? DELOS_ERROR_NOT_FOUND : status;
}

int delos_mpi_component_set_import(delos_mpi_component* component, const char* name,
                                   const double* values, int64_t size) {
  return call(component, __func__, [&](DistributedComponent& own) {
    need(name, "name");
    own.set_import(name, delos::c::values_of(values, size, "values"));
  });
}

int delos_mpi_component_get_export(delos_mpi_component* component, const char* name,
                                   const double** values, int64_t* size) {
  if (values != nullptr) *values = nullptr;
  return call(component, __func__, [&](const DistributedComponent& own) {
    need(name, "name");
    need(values, "values");
    const std::span<const double> all = own.get_export(name);
    *values = all.data();
    if (size != nullptr) *size = static_cast<int64_t>(all.size());
  });
}

int delos_mpi_component_grid(delos_mpi_component* component, delos_mpi_grid** grid) {
  if (grid != nullptr) *grid = nullptr;
  return call(component, __func__, [&](const DistributedComponent& own) {
    need(grid, "grid");
    auto made = std::make_unique<delos_mpi_grid>();
    made->held = own.grid();
    *grid = made.release();
  });
}

int delos_mpi_component_generation(delos_mpi_component* component, int64_t* generation) {
  return call(component, __func__, [&](const DistributedComponent& own) {
    need(generation, "generation");
    *generation = own.generation();
  });
}

int delos_mpi_component_current_time(delos_mpi_component* component, const char** text) {
  if (text != nullptr) *text = nullptr;
  return call(component, __func__, [&](const DistributedComponent& own) {
    need(text, "text");
    component->time = own.current_time() ? own.current_time()->text() : "";
    *text = component->time.c_str();
  });
}

int delos_mpi_component_remesh_decision(delos_mpi_component* component, const char** text) {
  return hand_out_text(component, __func__, text, &DistributedComponent::remesh_decision);
}

int delos_mpi_component_remesh_failure(delos_mpi_component* component, const char** text) {
  return hand_out_text(component, __func__, text, &DistributedComponent::remesh_failure);
}
