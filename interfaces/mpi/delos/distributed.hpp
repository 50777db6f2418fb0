// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The grid as a component of a model on many processes: delos::Component, whose calls are
// collective.
//
//   delos::mpi::DistributedComponent component(comm, [] {
//     return delos::Config::from_file("ocean.yaml");
//   });
//   component.initialize();
//   for (; !clock.is_done(); clock.advance()) {
//     component.set_import("eddy_kinetic_energy", eke_of_owned_cells);
//     if (component.run(clock)) depth_m = component.transfer(depth_m);    // onto the new grid
//   }
//   component.finalize();
#include <mpi.h>

#include <cstdint>
#include <delos/delos.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "delos/mpi.hpp"

namespace delos::mpi {

/// What an item of a state is; see delos::Field.
struct FieldInfo {
  std::string name, standard_name, units, long_name;
  Location location = Location::cell;
  int n_components = 1;
};

/// One instance over the processes of a communicator. One of them, the root, has the component
/// with the whole grid, its statistics and its restart file; the others sleep while it works, and
/// each has its part. All results are bit for bit those of delos::Component on one process, on any
/// number of processes.
///
/// What is marked collective is called by all processes in the same order, and whatever goes wrong
/// on one of them is thrown by all, with the same kind and text: Error(state) for a call in the
/// wrong order, also when the processes call different functions. Otherwise as delos::Component.
class DELOS_API DistributedComponent {
 public:
  /// Collective. configure() is called on the root only. Options as of distribute(); the callbacks
  /// are called in initialize, read_restart and run, on the root.
  DistributedComponent(MPI_Comm communicator, const std::function<Config()>& configure,
                       const Options& options = {});
  DistributedComponent(DistributedComponent&& other) noexcept;
  DistributedComponent& operator=(DistributedComponent&& other) noexcept;
  DistributedComponent(const DistributedComponent&) = delete;
  DistributedComponent& operator=(const DistributedComponent&) = delete;
  /// Collective, before MPI_Finalize.
  ~DistributedComponent();

  /// Collective. realize makes the grid and hands it out. When handing it out fails, it stays on
  /// the root, and realize may be called again.
  void initialize(InitializePhase phase);
  /// Collective: both.
  void initialize();

  /// The values of an import at the places that this process owns, [n_owned, n_components]; copied.
  /// Not collective; the next run takes what was given and refuses it for all when sizes do not fit
  /// or somebody gave nothing. Error(state) for an unknown name. Values stay until others are
  /// given or the grid is made anew.
  void set_import(const std::string& name, std::span<const double> owned);
  /// Collective: from clock.current() to clock.next(), which all must agree on. The values of
  /// set_import are gathered on the root, stamped with clock.current(). Whether the grid was made
  /// anew: then all parts, exports and grid() are those of the new one. When that can't be
  /// handed out, finalize must follow.
  bool run(const Clock& clock);
  /// Collective. The root writes; the file is that of delos::Component, byte for byte.
  void write_restart(const std::string& path, const Clock& clock) const;
  /// Collective, in the place of initialize(realize), on any number of processes, whoever wrote the
  /// file. `path` is looked at on the root only. Every clock becomes the one written, with its
  /// alarms.
  void read_restart(const std::string& path, Clock& clock);
  /// Collective. Gives the parts back.
  void finalize();

  /// Collective. After a run that made a new grid, until the next one: values of the former one's
  /// cells, owned or all local, [n, options.n_levels], on all local cells of the new grid. As
  /// delos::Transfer::apply of the whole field. Error(state) when there is no former grid.
  std::vector<double> transfer(std::span<const double> former,
                               const TransferOptions& options = {}) const;
  /// Collective. Likewise velocities along the normals of edges, as Transfer::apply_velocity.
  std::vector<double> transfer_velocity(std::span<const double> former,
                                        VelocityRoute route = VelocityRoute::vectors,
                                        const TransferOptions& options = {}) const;

  // --- known to each process
  /// In the order of declaration; empty before advertise.
  const std::vector<FieldInfo>& imports() const;
  const std::vector<FieldInfo>& exports() const;
  /// The local values of an export, halo included, [n_local, n_components], or one value of the
  /// whole grid. Valid until the next run or finalize. Error(state) for an unknown name, and
  /// without a grid.
  std::span<const double> get_export(const std::string& name) const;
  /// This process's part of the current grid. Error(state) without one. Copies keep the part when
  /// the component goes on.
  const DistributedGrid& grid() const;
  /// Of the current grid, from 1; 0 without one.
  std::int64_t generation() const;
  /// Where the last run ended; nothing before the first.
  const std::optional<Time>& current_time() const;
  /// As delos::Component's.
  const std::string& remesh_decision() const;
  const std::string& remesh_failure() const;
  /// On the root, for values on a lat-lon grid of the host's (place_on_lat_lon, store), which are
  /// not spread over processes; nothing elsewhere.
  std::optional<State> whole_imports() const;

 private:
  friend struct Distribution;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace delos::mpi
