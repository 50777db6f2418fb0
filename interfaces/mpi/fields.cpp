// SPDX-License-Identifier: BSD-3-Clause
#include "distribution.hpp"
#include "places.hpp"

namespace delos::mpi {

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

}  // namespace delos::mpi
