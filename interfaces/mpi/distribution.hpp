// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a distributed grid holds, and how one is made over a communicator that others share.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "communicator.hpp"
#include "delos/distributed.hpp"

namespace delos::mpi {

struct DistributedGrid::Impl {
  explicit Impl(std::shared_ptr<const Communicator> all) : team(std::move(all)), ranks(*team) {}
  bool is_root() const { return ranks.rank() == root; }
  std::size_t n_owned(Location location) const {
    return static_cast<std::size_t>(local->n_owned(location));
  }
  std::size_t n_local(Location location) const {
    return static_cast<std::size_t>(local->n_local(location));
  }

  std::shared_ptr<const Communicator> team;
  const Communicator& ranks;
  int root = 0;
  std::optional<LocalGrid> local;
  std::int64_t generation = 0;
  std::string digest, config_text;
  std::optional<Grid> whole;
};

/// Collective: Error(config), on all, unless all gave the same root, one of the ranks, and the same
/// number of halo layers.
void check_options(const Communicator& ranks, const Options& options);

/// As the host asked, but for MPI that allows a single thread only.
GenerateOptions allowed(GenerateOptions options);

struct Distribution {
  /// distribute() over a communicator of ours, with options that were checked.
  static DistributedGrid make(std::shared_ptr<const Communicator> team,
                              const std::function<Grid()>& make_grid, const Options& options);
  /// In the place of a collective call whose arguments this process can't use: the others don't
  /// wait for it, and throw Error(state), which names both calls.
  static void pass_over(const DistributedComponent& component);
};

}  // namespace delos::mpi
