// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The engine behind every component interface, in ESMF's phases: advertise, realize, run, finalize.
// No threads outlive a phase, nothing is printed or written, nothing is shared between instances.
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/progress.hpp"
#include "lifecycle/fields.hpp"
#include "lifecycle/generate.hpp"
#include "lifecycle/remesh.hpp"
#include "lifecycle/settings.hpp"
#include "time/clock.hpp"

namespace delos {

enum class Stage { created, advertised, realized, running, finalized };
const char* to_string(Stage stage);

/// What a component lives with beside its settings; the callbacks are called in realize.
struct ComponentOptions {
  int threads = 0;  ///< 0: what the settings say
  ProgressCallback on_progress = {};
  LogCallback on_log = {};
  const std::atomic<bool>* cancel = nullptr;
};

/// Every phase leaves the component as it was when it throws, and a phase that is done already does
/// nothing. A call in the wrong order is an Error(state) that says which call is expected.
/// One thread at a time.
class Component {
 public:
  Component(Settings settings, ComponentOptions options);
  /// Handles of fields that outlive it fail with Error(state).
  ~Component();
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;

  /// Declares the fields of both states; first, or after finalize.
  void advertise();
  /// Makes the grid: everything that generate() throws. Exports have values from here on.
  void realize();
  /// From one time to a later one: the component's clock goes there and exports are stamped with
  /// it. The first run starts the clock; a later `from` other than its time is an Error(state).
  /// With a section `remesh` the imports, as they stand, go into its statistics first (Error(input)
  /// for values that can't be used), and at its alarm the grid may be made anew: a generation on,
  /// imports without values. A remesh that fails leaves grid and fields: see remesh_failure().
  void run(const Time& from, const Time& until);
  /// The grid, both clocks and the generation into one file, after realize. Error(output) naming
  /// the path, Error(state) when the host's clock does not stand where the last run ended.
  void write_restart(const std::string& path, const Clock& host) const;
  /// In the place of realize: the component goes on from the file as the one that wrote it, the
  /// exports stamped as there. Gives the host's clock of the file; Error(input) as
  /// delos::read_restart, Error(config) when it counts another calendar than `host`.
  Clock read_restart(const std::string& path, const Clock& host);
  /// Gives the grid back; generations go on counting when the component starts again.
  void finalize();

  Stage stage() const { return stage_; }
  const Settings& settings() const { return settings_; }
  /// Of the grid; 0 without one.
  std::int64_t generation() const;
  /// Error(state) without a grid.
  std::shared_ptr<const Product> product() const;
  /// Set by the first run.
  const std::optional<Clock>& clock() const { return clock_; }
  /// Of the last alarm of `remesh`; none before.
  const std::optional<Decision>& decision() const { return decision_; }
  /// Why the remesh of the last alarm failed; empty when none did.
  const std::string& remesh_failure() const { return remesh_failure_; }
  /// Empty before advertise.
  const std::shared_ptr<State>& imports() const { return imports_; }
  const std::shared_ptr<State>& exports() const { return exports_; }

 private:
  [[noreturn]] void refuse(const char* call) const;
  void put_in_place(std::shared_ptr<const Product> product, std::int64_t number);
  void release_fields() noexcept;
  void start_remeshing();
  void follow_imports(Clock& clock, double duration_s);
  void take(RemeshOutcome outcome, const Time& now);

  Settings settings_;
  ComponentOptions options_;
  Stage stage_ = Stage::created;
  std::int64_t last_generation_ = 0;
  std::shared_ptr<const Product> product_;
  std::optional<Clock> clock_;
  std::optional<Remesh> remesh_;
  std::optional<Decision> decision_;
  std::string remesh_failure_;
  std::shared_ptr<State> imports_;
  std::shared_ptr<State> exports_;
};

}  // namespace delos
