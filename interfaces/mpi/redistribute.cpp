// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "distribution.hpp"
#include "places.hpp"

namespace delos::mpi {
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
