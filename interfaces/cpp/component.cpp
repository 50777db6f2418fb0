// SPDX-License-Identifier: BSD-3-Clause
#include "delos/component.hpp"

#include <utility>

#include "callbacks.hpp"
#include "clock_access.hpp"
#include "config_access.hpp"
#include "field_access.hpp"
#include "grid_access.hpp"
#include "lifecycle/component.hpp"
#include "time_access.hpp"
#include "translate.hpp"

namespace delos::api {
namespace {

// Names as in ESMF's ESMC_ReturnCodes.h.
constexpr int kArgValue = 9;
constexpr int kFileRead = 21;
constexpr int kFileWrite = 22;
constexpr int kMem = 30;
constexpr int kNotValid = 42;
constexpr int kInternalBad = 45;
constexpr int kValueWrong = 54;

/// The state handed to run must be the component's own, and the right one of the two.
void check_state(const State& given, const delos::State& own) {
  const char* const intent = delos::to_string(own.intent());
  DELOS_CHECK(StateAccess::engine(given) == &own, delos::ErrorKind::state,
              "run was given another state as its ", intent, " state (intent ",
              to_string(given.intent()), "): pass the component's own ", intent, "_state()");
}

}  // namespace

int esmf_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::config:
      return kArgValue;
    case ErrorKind::input:
      return kFileRead;
    case ErrorKind::output:
      return kFileWrite;
    case ErrorKind::resource:
      return kMem;
    case ErrorKind::state:
      return kNotValid;
    case ErrorKind::quality:
      return kValueWrong;
    case ErrorKind::cancelled:
    case ErrorKind::internal:
      return kInternalBad;
  }
  return kInternalBad;
}

struct Component::Impl {
  Impl(Settings settings, GenerateOptions of_host)
      : options(std::move(of_host)),
        component(std::move(settings), {.threads = options.threads,
                                        .on_progress = progress_of(options),
                                        .on_log = log_of(options),
                                        .cancel = options.cancel}) {}
  GenerateOptions options;  // the callbacks refer to it
  delos::Component component;
  std::optional<Grid> grid;  // made when it is asked for, of one generation
};

Component::Component(const Config& config, const GenerateOptions& options)
    : impl_(translated(
          [&] { return std::make_unique<Impl>(ConfigAccess::settings(config), options); })) {}
Component::Component(Component&& other) noexcept = default;
Component& Component::operator=(Component&& other) noexcept = default;
Component::~Component() = default;

void Component::initialize(InitializePhase phase) {
  translated([&] {
    if (phase == InitializePhase::advertise) {
      impl_->component.advertise();
    } else {
      impl_->component.realize();
    }
  });
}

void Component::initialize() {
  translated([&] {
    const delos::Stage stage = impl_->component.stage();
    // A realized component stays as it is: repeating both phases does nothing.
    if (stage != delos::Stage::realized) impl_->component.advertise();
    impl_->component.realize();
  });
}

void Component::run(const State& import_state, const State& export_state, const Clock& clock) {
  translated([&] {
    check_state(import_state, *impl_->component.imports());
    check_state(export_state, *impl_->component.exports());
    const delos::Clock& host = ClockAccess::engine(clock);
    impl_->component.run(host.current(), host.next());
  });
}

void Component::write_restart(const std::string& path, const Clock& clock) const {
  translated([&] { impl_->component.write_restart(path, ClockAccess::engine(clock)); });
}

void Component::read_restart(const std::string& path, Clock& clock) {
  translated([&] {
    delos::Clock& own = ClockAccess::engine(clock);
    own = impl_->component.read_restart(path, own);
  });
}

void Component::finalize() {
  translated([&] {
    impl_->component.finalize();
    impl_->grid.reset();
  });
}

State Component::import_state() const { return StateAccess::make(impl_->component.imports()); }
State Component::export_state() const { return StateAccess::make(impl_->component.exports()); }

Grid Component::grid() const {
  return translated([&] {
    auto product = impl_->component.product();
    if (!impl_->grid || impl_->grid->generation() != impl_->component.generation()) {
      impl_->grid = GridAccess::make(std::move(product), impl_->component.generation());
    }
    return *impl_->grid;
  });
}

std::int64_t Component::generation() const { return impl_->component.generation(); }

std::optional<Time> Component::current_time() const {
  const auto& clock = impl_->component.clock();
  if (!clock) return std::nullopt;
  return TimeAccess::made(clock->current());
}

std::string Component::remesh_decision() const {
  const auto& decision = impl_->component.decision();
  return decision ? decision->text : "";
}

std::string Component::remesh_failure() const { return impl_->component.remesh_failure(); }

}  // namespace delos::api
