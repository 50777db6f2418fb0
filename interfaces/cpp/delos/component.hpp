// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The grid as a component of a coupled model, in ESMF's phases:
//
//   delos::Component component(config);
//   component.initialize();                       // advertise, then realize
//   for (; !clock.is_done(); clock.advance()) component.run(imports, exports, clock);
//   component.finalize();
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "delos/clock.hpp"
#include "delos/config.hpp"
#include "delos/error.hpp"
#include "delos/export.hpp"
#include "delos/generate.hpp"
#include "delos/grid.hpp"
#include "delos/state.hpp"

namespace delos::api {

enum class InitializePhase {
  advertise,  ///< declares the fields; allocates nothing large, opens no file
  realize     ///< makes the grid; exports have values
};

// ESMF's return codes, for caps: 0 is success.
inline constexpr int kEsmfSuccess = 0;    ///< ESMF_SUCCESS
inline constexpr int kEsmfNotFound = 41;  ///< ESMF_RC_NOT_FOUND, an absent item of a state
/// What a cap returns for an error of this kind: config 9 (ARG_VALUE), input 21 (FILE_READ), output
/// 22 (FILE_WRITE), resource 30 (MEM), state 42 (NOT_VALID), quality 54 (VAL_WRONG), cancelled
/// and internal 45 (INTNRL_BAD).
DELOS_API int esmf_code(ErrorKind kind);

/// One instance; instances share nothing. Used by one thread at a time. It prints nothing, writes
/// no file but the restart file, and has threads in initialize(realize), read_restart and, with a
/// section `remesh`, run only, in an arena of its own.
///
/// A call in the wrong order is Error(state) that says which call is expected; a phase that is
/// done already does nothing when it is repeated; what throws leaves the component as it was.
class DELOS_API Component {
 public:
  /// Error(config). The callbacks of the options are called in initialize(realize), read_restart
  /// and, with a section `remesh`, run; what options.cancel points to must live that long.
  explicit Component(const Config& config, const GenerateOptions& options = {});
  Component(Component&& other) noexcept;
  Component& operator=(Component&& other) noexcept;
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;
  /// Fields that outlive it have lost their values, and say so; a Grid keeps its own.
  ~Component();

  /// One phase. realize throws what generate() throws.
  void initialize(InitializePhase phase);
  /// Both. When realize throws, the component stays advertised.
  void initialize();
  /// From clock.current() to clock.next(), before the host advances its clock. Exports are then of
  /// that time. The states are the component's own; the first run says when it starts, and every
  /// later one must begin where the last one ended, else Error(state). With a section `remesh` the
  /// imports, as they stand, go into its statistics (Error(input) for values that are not finite),
  /// and at its alarm the grid may be made anew: see generation().
  void run(const State& import_state, const State& export_state, const Clock& clock);
  /// The grid, the host's clock with its alarms, the component's time, the generation and the
  /// configuration in one file: whole or not at all, the former file stays until it is on the disk.
  /// After initialize, and after the host has advanced its clock; Error(output) naming the path.
  /// Values that the host gave to imports are not kept.
  void write_restart(const std::string& path, const Clock& clock) const;
  /// In the place of initialize(realize): the component goes on to the last bit as the one that
  /// wrote the file, with any number of threads. `clock`, of the same calendar, becomes the one
  /// written, with its alarms; handles of alarms follow by id, and set_stop gives a new end.
  /// Error(input) names the file when it is missing, no restart file, cut off, altered, of another
  /// version, or of another configuration, with the settings that differ. What throws leaves
  /// clock and component as they were.
  void read_restart(const std::string& path, Clock& clock);
  /// Gives the grid back. The component may be initialized again, with the next generation.
  void finalize();

  /// What the host gives and gets; the handles stay good for all phases.
  State import_state() const;
  State export_state() const;
  /// Shares the component's arrays and keeps them, when the component goes on or ends, too; its
  /// generation() says of which generation it is. Error(state) before realize.
  Grid grid() const;
  /// Of the current grid, from 1; 0 without one.
  std::int64_t generation() const;
  /// Where the last run ended; nothing before the first.
  std::optional<Time> current_time() const;

  /// Why the last alarm of section `remesh` made a new grid, or none: one line, with the numbers;
  /// empty before the first. delos/transfer.hpp carries the host's fields to a new grid.
  std::string remesh_decision() const;
  /// Why the remesh that the last alarm decided on failed, and the grid stayed; empty when it did
  /// not.
  std::string remesh_failure() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace delos::api

#ifndef DELOS_BUILDING_LIBRARY
namespace delos {
using api::Component;
using api::esmf_code;
using api::InitializePhase;
using api::kEsmfNotFound;
using api::kEsmfSuccess;
}  // namespace delos
#endif
