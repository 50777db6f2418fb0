// SPDX-License-Identifier: BSD-3-Clause
#include "delos/mpi.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "distribution.hpp"

namespace delos::mpi {

void check_options(const Communicator& ranks, const Options& options) {
  const std::array<std::int64_t, 2> mine{options.root, options.halo_layers};
  if (!ranks.range(mine).is_same_everywhere()) {
    throw Error(ErrorKind::config,
                "the processes gave different roots or halo layers: give the same everywhere.");
  }
  if (options.root < 0 || options.root >= ranks.size()) {
    throw Error(ErrorKind::config, "root = " + std::to_string(options.root) +
                                       ": must be a rank of the communicator, in [0, " +
                                       std::to_string(ranks.size()) + ").");
  }
}

GenerateOptions allowed(GenerateOptions options) {
  int level = MPI_THREAD_SINGLE;
  MPI_Query_thread(&level);
  if (level != MPI_THREAD_SINGLE || options.threads == 1) return options;
  options.threads = 1;
  if (options.log) {
    options.log(LogLevel::warning,
                "MPI was started for a single thread, so the grid is made by one: start it with "
                "MPI_Init_thread and MPI_THREAD_FUNNELED.");
  }
  return options;
}

namespace {

using Layout = std::array<std::int64_t, LocalGrid::kLayoutSize>;

/// Hands part `to` to its process: the layout, its word that it has room, the arrays. A process
/// whose part can't be made gets a layout of zeros.
void hand_out(const Communicator& ranks, Partition& partition, int to) {
  Layout layout{};
  const auto send_layout = [&] { ranks.send(layout, to); };
  std::optional<LocalGrid> part;
  try {
    part = partition.part(to);
    layout = part->layout();
  } catch (...) {
    layout = {};
    send_layout();
    throw;
  }
  send_layout();
  int has_room = 0;
  ranks.receive(std::span(&has_room, 1), to);
  if (has_room == 0) return;
  for (const auto buffer : part->buffers()) ranks.send(buffer, to);
}

std::optional<LocalGrid> take(const Communicator& ranks, int root) {
  Layout layout{};
  ranks.receive(layout, root);
  if (layout[0] == 0) return std::nullopt;
  bool is_told = false;
  const auto tell = [&](int has_room) {
    if (!std::exchange(is_told, true)) ranks.send(std::span(&has_room, 1), root);
  };
  try {
    return LocalGrid::received(layout, [&](std::span<std::byte> buffer) {
      tell(1);
      ranks.receive(buffer, root);
    });
  } catch (...) {
    tell(0);
    throw;
  }
}

/// On the generating process: a part to everyone. One that failed does not keep the others from
/// theirs; the first failure is thrown at the end.
LocalGrid hand_out_all(const Communicator& ranks, Partition& partition) {
  std::exception_ptr failure;
  for (int to = 0; to < ranks.size(); ++to) {
    if (to == ranks.rank()) continue;
    try {
      hand_out(ranks, partition, to);
    } catch (...) {
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
  return partition.part(ranks.rank());
}

Partition partition_of(const Grid& grid, int n_parts, const Options& options) {
  PartitionOptions how{.n_parts = n_parts,
                       .method = options.method,
                       .halo_layers = options.halo_layers,
                       .cell_weight = {},
                       .work = options.work};
  if (options.cell_weight) {
    how.cell_weight = options.cell_weight(grid);
    if (how.cell_weight.empty()) {
      throw Error(ErrorKind::config, "cell_weight gave no weights: give one for each cell.");
    }
  }
  return Partition(grid, how);
}

}  // namespace

DistributedGrid::DistributedGrid(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

const LocalGrid& DistributedGrid::local() const { return *impl_->local; }
MPI_Comm DistributedGrid::communicator() const { return impl_->ranks.get(); }
int DistributedGrid::root() const { return impl_->root; }
std::int64_t DistributedGrid::generation() const { return impl_->generation; }
const std::string& DistributedGrid::digest() const { return impl_->digest; }
const std::string& DistributedGrid::config_text() const { return impl_->config_text; }
const std::optional<Grid>& DistributedGrid::whole() const { return impl_->whole; }

DistributedGrid Distribution::make(std::shared_ptr<const Communicator> team,
                                   const std::function<Grid()>& make_grid, const Options& options) {
  auto impl = std::make_shared<DistributedGrid::Impl>(std::move(team));
  const Communicator& ranks = impl->ranks;
  impl->root = options.root;

  std::optional<Grid> grid;
  std::optional<Partition> partition;
  ranks.together([&] {
    if (!impl->is_root()) return;
    grid = make_grid();
    partition = partition_of(*grid, ranks.size(), options);
  });
  ranks.together([&] {
    if (impl->is_root()) {
      impl->local = hand_out_all(ranks, *partition);
    } else {
      impl->local = take(ranks, impl->root);
    }
  });
  partition.reset();
  if (grid) {
    impl->generation = grid->generation();
    impl->digest = grid->digest();
    impl->config_text = grid->config_text();
    if (options.keep_whole_grid) impl->whole = *grid;
  }
  ranks.broadcast(std::span(&impl->generation, 1), impl->root);
  ranks.broadcast(impl->digest, impl->root);
  ranks.broadcast(impl->config_text, impl->root);
  return DistributedGrid(std::move(impl));
}

DistributedGrid distribute(MPI_Comm communicator, const std::function<Grid()>& make,
                           const Options& options) {
  auto team = std::make_shared<const Communicator>(communicator);
  check_options(*team, options);
  return Distribution::make(std::move(team), make, options);
}

DistributedGrid generate(MPI_Comm communicator, const std::function<Config()>& configure,
                         const Options& options) {
  return distribute(
      communicator, [&] { return delos::generate(configure(), allowed(options.generate)); },
      options);
}

}  // namespace delos::mpi
