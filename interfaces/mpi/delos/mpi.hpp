// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A grid spread over the processes of a communicator: made once, by one of them, and handed out
// part by part.
//
//   auto grid = delos::mpi::generate(comm, [] { return delos::Config::from_file("ocean.yaml"); });
//   std::vector<double> depth_m(grid.local().n_local(delos::Location::cell));
//   ...                                                 // the owned ones come first
//   grid.exchange(depth_m, delos::Location::cell);      // halo from its owners
//
// MPI 3, which the host starts and ends. delos uses a duplicate of the communicator, and only in
// the thread that calls. Every function but those that ask only is collective.
#include <mpi.h>

#include <cstdint>
#include <delos/delos.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace delos::mpi {

struct Distribution;

struct Options {
  /// Threads and callbacks of the generating process. MPI started for a single thread
  /// (MPI_THREAD_SINGLE) gives it one, and a warning.
  GenerateOptions generate = {};
  int root = 0;         ///< rank of the generating process; the same everywhere
  int halo_layers = 1;  ///< the same everywhere
  PartitionMethod method = PartitionMethod::automatic;
  /// Work of each cell, [n_cells], finite, >= 0; called on the generating process. Without it:
  /// as `work` says.
  std::function<std::vector<double>(const Grid&)> cell_weight = {};
  CellWork work = CellWork::automatic;  ///< by wet layers where the grid has them
  /// Whether the generating process keeps the whole grid, to write files or to remap.
  bool keep_whole_grid = false;
};

/// One process's part with what it takes to exchange. Copies share it. The last copy frees the
/// communicator, which is collective: let go of it everywhere, before MPI_Finalize.
class DELOS_API DistributedGrid {
 public:
  const LocalGrid& local() const;
  /// delos's duplicate; its ranks are the parts.
  MPI_Comm communicator() const;
  /// Rank of the generating process.
  int root() const;

  // --- of the whole grid, known to all, as Grid's
  std::int64_t generation() const;
  const std::string& digest() const;
  const std::string& config_text() const;
  /// On the generating process, with keep_whole_grid.
  const std::optional<Grid>& whole() const;

  // --- fields: [n_local, n_components], owned ones first; location cell, edge or vertex
  /// Sets the halo to the owners' values, bit for bit. Sizes are checked for each process by
  /// itself (Error(input)); all others must be stopped by the host then.
  void exchange(std::span<double> values, Location location, int n_components = 1) const;
  void exchange(std::span<float> values, Location location, int n_components = 1) const;
  void exchange(std::span<std::int32_t> values, Location location, int n_components = 1) const;

  /// The whole field by global id on the generating process, nothing elsewhere. `values` holds the
  /// owned ones or all local ones.
  std::vector<double> gather(std::span<const double> values, Location location,
                             int n_components = 1) const;
  /// From the whole field on the generating process to each one's local places, halo included.
  /// `whole` is looked at there only.
  std::vector<double> scatter(std::span<const double> whole, Location location,
                              int n_components = 1) const;
  /// A field of this distribution for `to`, another distribution of the same grid over the same
  /// processes (new weights, say); halo included. No process sees the whole. Error(state) for
  /// another grid: after a remesh gather, remap and scatter.
  std::vector<double> redistribute(std::span<const double> values, const DistributedGrid& to,
                                   Location location, int n_components = 1) const;

 private:
  friend struct Distribution;
  struct Impl;
  explicit DistributedGrid(std::shared_ptr<const Impl> impl);
  template <class Number>
  void exchange_numbers(std::span<Number> values, Location location, int n_components) const;
  std::shared_ptr<const Impl> impl_;
};

/// make() is called on the generating process; the others sleep until their part comes, one after
/// the other. Whatever it throws, and all that goes wrong on any process, is thrown by all: the
/// same kind and text as Error, the first one itself where it came from. Error(state) for
/// MPI_COMM_NULL, for MPI that is not running, and in a thread that may not call MPI;
/// Error(config) for fewer cells than processes and for options that differ.
DELOS_API DistributedGrid distribute(MPI_Comm communicator, const std::function<Grid()>& make,
                                     const Options& options = {});

/// configure() is called on the generating process only: no other opens a file.
DELOS_API DistributedGrid generate(MPI_Comm communicator, const std::function<Config()>& configure,
                                   const Options& options = {});

}  // namespace delos::mpi
