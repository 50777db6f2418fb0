// SPDX-License-Identifier: BSD-3-Clause
#include "delos/mpi.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "communicator.hpp"

namespace delos::mpi {

struct DistributedGrid::Impl {
  explicit Impl(MPI_Comm host) : ranks(host) {}
  bool is_root() const { return ranks.rank() == root; }
  std::size_t n_owned(Location location) const {
    return static_cast<std::size_t>(local->n_owned(location));
  }
  std::size_t n_local(Location location) const {
    return static_cast<std::size_t>(local->n_local(location));
  }

  Communicator ranks;
  int root = 0;
  std::optional<LocalGrid> local;
  std::int64_t generation = 0;
  std::string digest, config_text;
  std::optional<Grid> whole;
};

namespace {

using Layout = std::array<std::int64_t, LocalGrid::kLayoutSize>;

/// The options that all must agree on, before anybody waits for the wrong process.
void check_options(const Communicator& ranks, const Options& options) {
  const std::array<int, 4> mine{options.root, -options.root, options.halo_layers,
                                -options.halo_layers};
  std::array<int, 4> least{};
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Iallreduce(mine.data(), least.data(), 4, MPI_INT, MPI_MIN, ranks.get(), &request),
        "MPI_Iallreduce");
  wait_asleep(request);
  if (least[0] != -least[1] || least[2] != -least[3]) {
    throw Error(ErrorKind::config,
                "the processes gave different roots or halo layers: give the same everywhere.");
  }
  if (options.root < 0 || options.root >= ranks.size()) {
    throw Error(ErrorKind::config, "root = " + std::to_string(options.root) +
                                       ": must be a rank of the communicator, in [0, " +
                                       std::to_string(ranks.size()) + ").");
  }
}

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
  PartitionOptions how{
      .n_parts = n_parts, .method = options.method, .halo_layers = options.halo_layers};
  if (options.cell_weight) {
    how.cell_weight = options.cell_weight(grid);
    if (how.cell_weight.empty()) {
      throw Error(ErrorKind::config, "cell_weight gave no weights: give one for each cell.");
    }
  }
  return Partition(grid, how);
}

/// As the host asked, but for MPI that allows a single thread only.
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

}  // namespace

DistributedGrid::DistributedGrid(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

const LocalGrid& DistributedGrid::local() const { return *impl_->local; }
MPI_Comm DistributedGrid::communicator() const { return impl_->ranks.get(); }
int DistributedGrid::root() const { return impl_->root; }
std::int64_t DistributedGrid::generation() const { return impl_->generation; }
const std::string& DistributedGrid::digest() const { return impl_->digest; }
const std::string& DistributedGrid::config_text() const { return impl_->config_text; }
const std::optional<Grid>& DistributedGrid::whole() const { return impl_->whole; }

DistributedGrid distribute(MPI_Comm communicator, const std::function<Grid()>& make,
                           const Options& options) {
  auto impl = std::make_shared<DistributedGrid::Impl>(communicator);
  const Communicator& ranks = impl->ranks;
  check_options(ranks, options);
  impl->root = options.root;

  std::optional<Grid> grid;
  std::optional<Partition> partition;
  ranks.together([&] {
    if (!impl->is_root()) return;
    grid = make();
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
  check(MPI_Bcast(&impl->generation, 1, MPI_INT64_T, impl->root, ranks.get()), "MPI_Bcast");
  ranks.broadcast(impl->digest, impl->root);
  ranks.broadcast(impl->config_text, impl->root);
  return DistributedGrid(std::move(impl));
}

DistributedGrid generate(MPI_Comm communicator, const std::function<Config()>& configure,
                         const Options& options) {
  return distribute(
      communicator, [&] { return delos::generate(configure(), allowed(options.generate)); },
      options);
}

// ------------------------------------------------------------------ fields

namespace {

/// Throws Error(input) unless `size` is one of two counts of places, times components.
void check_size(std::size_t size, int n_components, std::array<std::size_t, 2> counts) {
  const auto per_place = static_cast<std::size_t>(std::max(n_components, 0));
  if (n_components >= 1 && (size == counts[0] * per_place || size == counts[1] * per_place)) return;
  std::string places = std::to_string(counts[0]);
  if (counts[1] != counts[0]) places += " or " + std::to_string(counts[1]);
  throw Error(ErrorKind::input, "the field has " + std::to_string(size) + " values, but " + places +
                                    " places of " + std::to_string(n_components) +
                                    " components: give them all, and n_components >= 1.");
}

/// The components of one place as one MPI element, so that counts are counts of places.
class PlaceType {
 public:
  PlaceType(std::size_t bytes_per_number, int n_components) {
    check(MPI_Type_contiguous(static_cast<int>(bytes_per_number) * n_components, MPI_BYTE, &type_),
          "MPI_Type_contiguous");
    check(MPI_Type_commit(&type_), "MPI_Type_commit");
  }
  ~PlaceType() { MPI_Type_free(&type_); }
  PlaceType(const PlaceType&) = delete;
  PlaceType& operator=(const PlaceType&) = delete;
  MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

template <class Number>
std::vector<Number> picked(std::span<const Number> values, std::span<const std::int32_t> places,
                           int n_components) {
  const auto width = static_cast<std::size_t>(n_components);
  std::vector<Number> out(places.size() * width);
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(places[i]) * n_components, width,
                out.begin() + static_cast<std::ptrdiff_t>(i * width));
  }
  return out;
}

template <class Number>
void put(std::span<const Number> from, std::span<const std::int32_t> places, int n_components,
         std::span<Number> to) {
  const auto width = static_cast<std::size_t>(n_components);
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                to.begin() + static_cast<std::ptrdiff_t>(places[i]) * n_components);
  }
}

}  // namespace

template <class Number>
void DistributedGrid::exchange_numbers(std::span<Number> values, Location location,
                                       int n_components) const {
  const LocalGrid& local = *impl_->local;
  const std::size_t n_local = impl_->n_local(location);
  check_size(values.size(), n_components, {n_local, n_local});
  const auto neighbours = local.neighbours(location);
  const auto send_offsets = local.send_offsets(location);
  const auto receive_offsets = local.receive_offsets(location);
  const auto width = static_cast<std::size_t>(n_components);
  const PlaceType place(sizeof(Number), n_components);
  const MPI_Comm ranks = impl_->ranks.get();
  constexpr int kTag = 1;

  std::vector<Number> incoming(local.receive_ids(location).size() * width);
  const std::vector<Number> outgoing =
      picked<Number>(values, local.send_ids(location), n_components);
  std::vector<MPI_Request> requests(2 * neighbours.size(), MPI_REQUEST_NULL);
  const auto count = [](std::span<const std::int64_t> offsets, std::size_t k) {
    return static_cast<int>(offsets[k + 1] - offsets[k]);
  };
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    check(MPI_Irecv(incoming.data() + static_cast<std::size_t>(receive_offsets[k]) * width,
                    count(receive_offsets, k), place.get(), neighbours[k], kTag, ranks,
                    &requests[2 * k]),
          "MPI_Irecv");
    check(MPI_Isend(outgoing.data() + static_cast<std::size_t>(send_offsets[k]) * width,
                    count(send_offsets, k), place.get(), neighbours[k], kTag, ranks,
                    &requests[2 * k + 1]),
          "MPI_Isend");
  }
  check(MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE),
        "MPI_Waitall");
  put<Number>(incoming, local.receive_ids(location), n_components, values);
}

void DistributedGrid::exchange(std::span<double> values, Location location,
                               int n_components) const {
  exchange_numbers(values, location, n_components);
}
void DistributedGrid::exchange(std::span<float> values, Location location, int n_components) const {
  exchange_numbers(values, location, n_components);
}
void DistributedGrid::exchange(std::span<std::int32_t> values, Location location,
                               int n_components) const {
  exchange_numbers(values, location, n_components);
}

std::vector<double> DistributedGrid::gather(std::span<const double> values, Location location,
                                            int n_components) const {
  const Communicator& ranks = impl_->ranks;
  std::vector<double> whole;
  ranks.together([&] {
    check_size(values.size(), n_components, {impl_->n_owned(location), impl_->n_local(location)});
    if (!impl_->is_root()) return;
    whole.resize(static_cast<std::size_t>(impl_->local->n_global(location)) *
                 static_cast<std::size_t>(n_components));
  });
  const std::size_t n_owned = impl_->n_owned(location);
  const auto own_ids = impl_->local->global_id(location).first(n_owned);
  const auto own = values.first(n_owned * static_cast<std::size_t>(n_components));
  if (!impl_->is_root()) {
    const auto n = static_cast<std::int64_t>(n_owned);
    ranks.send(std::span(&n, 1), impl_->root);
    ranks.send(own_ids, impl_->root);
    ranks.send(own, impl_->root);
    return whole;
  }
  put<double>(own, own_ids, n_components, whole);
  for (int from = 0; from < ranks.size(); ++from) {
    if (from == impl_->root) continue;
    std::int64_t n = 0;
    ranks.receive(std::span(&n, 1), from);
    std::vector<std::int32_t> ids(static_cast<std::size_t>(n));
    std::vector<double> part(ids.size() * static_cast<std::size_t>(n_components));
    ranks.receive(ids, from);
    ranks.receive(part, from);
    put<double>(part, ids, n_components, whole);
  }
  return whole;
}

std::vector<double> DistributedGrid::scatter(std::span<const double> whole, Location location,
                                             int n_components) const {
  const Communicator& ranks = impl_->ranks;
  const auto ids = impl_->local->global_id(location);
  std::vector<double> out;
  ranks.together([&] {
    if (n_components < 1) check_size(0, n_components, {0, 0});
    if (impl_->is_root()) {
      const auto n_global = static_cast<std::size_t>(impl_->local->n_global(location));
      check_size(whole.size(), n_components, {n_global, n_global});
    }
    out.resize(ids.size() * static_cast<std::size_t>(n_components));
  });
  if (!impl_->is_root()) {
    const auto n = static_cast<std::int64_t>(ids.size());
    ranks.send(std::span(&n, 1), impl_->root);
    ranks.send(ids, impl_->root);
    ranks.receive(out, impl_->root);
    return out;
  }
  for (int to = 0; to < ranks.size(); ++to) {
    if (to == impl_->root) continue;
    std::int64_t n = 0;
    ranks.receive(std::span(&n, 1), to);
    std::vector<std::int32_t> wanted(static_cast<std::size_t>(n));
    ranks.receive(wanted, to);
    ranks.send(picked<double>(whole, wanted, n_components), to);
  }
  return picked<double>(whole, ids, n_components);
}

// ------------------------------------------------------------------ redistribution

namespace {

/// Global ids in equal blocks, one a process: where owners leave values and others fetch them, so
/// that nobody needs to know who owns what.
class Exchange {
 public:
  /// `ids` in any order; their values go to, or come from, the blocks' processes.
  Exchange(MPI_Comm ranks, int n_ranks, std::int64_t block, std::span<const std::int32_t> ids)
      : ranks_(ranks), n_ranks_(n_ranks) {
    out_counts_.assign(static_cast<std::size_t>(n_ranks), 0);
    for (const std::int32_t id : ids) ++out_counts_[static_cast<std::size_t>(id / block)];
    out_begins_ = begins(out_counts_);
    std::vector<int> next = out_begins_;
    places_.resize(ids.size());
    std::vector<std::int32_t> sorted(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto k = static_cast<std::size_t>(next[static_cast<std::size_t>(ids[i] / block)]++);
      sorted[k] = ids[i];
      places_[k] = static_cast<std::int32_t>(i);
    }
    in_counts_.resize(out_counts_.size());
    check(MPI_Alltoall(out_counts_.data(), 1, MPI_INT, in_counts_.data(), 1, MPI_INT, ranks_),
          "MPI_Alltoall");
    in_begins_ = begins(in_counts_);
    asked_.resize(static_cast<std::size_t>(in_begins_.back()) +
                  static_cast<std::size_t>(in_counts_.back()));
    check(MPI_Alltoallv(sorted.data(), out_counts_.data(), out_begins_.data(), MPI_INT32_T,
                        asked_.data(), in_counts_.data(), in_begins_.data(), MPI_INT32_T, ranks_),
          "MPI_Alltoallv");
  }
  /// Ids of our block that the others named, process after process.
  std::span<const std::int32_t> asked() const { return asked_; }
  /// Values in the order of `ids` -> values in the order of asked().
  std::vector<double> forward(std::span<const double> values, int n_components) const {
    const PlaceType place(sizeof(double), n_components);
    const std::vector<double> out = picked<double>(values, places_, n_components);
    std::vector<double> in(asked_.size() * static_cast<std::size_t>(n_components));
    check(MPI_Alltoallv(out.data(), out_counts_.data(), out_begins_.data(), place.get(), in.data(),
                        in_counts_.data(), in_begins_.data(), place.get(), ranks_),
          "MPI_Alltoallv");
    return in;
  }
  /// And back.
  std::vector<double> backward(const std::vector<double>& values, int n_components) const {
    const PlaceType place(sizeof(double), n_components);
    std::vector<double> in(places_.size() * static_cast<std::size_t>(n_components));
    check(MPI_Alltoallv(values.data(), in_counts_.data(), in_begins_.data(), place.get(), in.data(),
                        out_counts_.data(), out_begins_.data(), place.get(), ranks_),
          "MPI_Alltoallv");
    std::vector<double> out(in.size());
    put<double>(in, places_, n_components, out);
    return out;
  }

 private:
  std::vector<int> begins(const std::vector<int>& counts) const {
    std::vector<int> out(static_cast<std::size_t>(n_ranks_), 0);
    for (std::size_t r = 1; r < out.size(); ++r) out[r] = out[r - 1] + counts[r - 1];
    return out;
  }
  MPI_Comm ranks_;
  int n_ranks_;
  std::vector<int> out_counts_, out_begins_, in_counts_, in_begins_;
  std::vector<std::int32_t> places_, asked_;
};

}  // namespace

std::vector<double> DistributedGrid::redistribute(std::span<const double> values,
                                                  const DistributedGrid& to, Location location,
                                                  int n_components) const {
  const Communicator& ranks = impl_->ranks;
  ranks.together([&] {
    check_size(values.size(), n_components, {impl_->n_owned(location), impl_->n_local(location)});
    const bool is_same_place =
        to.impl_->ranks.size() == ranks.size() && to.impl_->ranks.rank() == ranks.rank();
    if (to.digest() != digest() || !is_same_place) {
      throw Error(ErrorKind::state,
                  "redistribute to another grid, or to other processes: gather the field, remap "
                  "it to the new grid, and scatter it there.");
    }
  });
  const std::int64_t n_global = local().n_global(location);
  const std::int64_t block = (n_global + ranks.size() - 1) / ranks.size();
  const std::int64_t first = block * ranks.rank();
  const auto n_mine =
      static_cast<std::size_t>(std::clamp<std::int64_t>(n_global - first, 0, block));
  const auto in_block = [&](std::span<const std::int32_t> ids) {
    std::vector<std::int32_t> out(ids.begin(), ids.end());
    for (std::int32_t& id : out) id -= static_cast<std::int32_t>(first);
    return out;
  };
  const std::size_t n_owned = impl_->n_owned(location);

  const Exchange leave(ranks.get(), ranks.size(), block,
                       local().global_id(location).first(n_owned));
  std::vector<double> kept(n_mine * static_cast<std::size_t>(n_components));
  put<double>(leave.forward(values, n_components), in_block(leave.asked()), n_components, kept);
  const Exchange fetch(ranks.get(), ranks.size(), block, to.local().global_id(location));
  return fetch.backward(picked<double>(kept, in_block(fetch.asked()), n_components), n_components);
}

}  // namespace delos::mpi
