// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The processes of one component, as the cap needs them: team_mpi.cpp with MPI, team_alone.cpp
// without. One of the two is linked.
#include <delos/delos.hpp>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace delos::cap {

/// All functions but is_first are collective.
class Team {
 public:
  virtual ~Team() = default;
  /// The one process that makes and keeps the grid.
  virtual bool is_first() const = 0;
  /// make() is called on the first process; its failure is thrown by all.
  virtual LocalGrid spread(const std::function<Grid()>& make) = 0;
  /// The first process's.
  virtual double shared(double value) = 0;
  /// Values of each one's own cells: of the whole grid by id on the first process, nothing
  /// elsewhere.
  virtual std::vector<double> gather(std::span<const double> own) = 0;
  /// And back; `whole` is looked at on the first process.
  virtual std::vector<double> scatter(std::span<const double> whole) = 0;
  /// body() on every process; what one of them throws is thrown by all.
  virtual void together(const std::function<void()>& body) = 0;
};

/// `communicator` is MPI's Fortran handle. Error(config) for more than one process without MPI.
std::unique_ptr<Team> make_team(int communicator, int n_processes);

}  // namespace delos::cap
