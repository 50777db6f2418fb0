// SPDX-License-Identifier: BSD-3-Clause
#include <mpi.h>

#include <array>
#include <delos/mpi.hpp>
#include <exception>
#include <new>
#include <optional>
#include <string>

#include "team.hpp"

namespace delos::cap {
namespace {

constexpr int kFirst = 0;

/// What a process brings to the others: the kind of its error, and the text.
struct Failure {
  ErrorKind kind = ErrorKind::internal;
  std::string text;
};

std::optional<Failure> failure_of(const std::function<void()>& body) {
  try {
    body();
    return std::nullopt;
  } catch (const Error& error) {
    return Failure{error.kind(), error.what()};
  } catch (const std::bad_alloc&) {
    return Failure{ErrorKind::resource, "out of memory"};
  } catch (const std::exception& error) {
    return Failure{ErrorKind::internal, error.what()};
  }
}

class Processes : public Team {
 public:
  /// The host's communicator is used for what MPI itself guards; the grid has one of its own.
  explicit Processes(MPI_Comm host) : host_(host) {
    MPI_Comm_rank(host_, &rank_);
    MPI_Comm_size(host_, &size_);
  }

  bool is_first() const override { return rank_ == kFirst; }

  LocalGrid spread(const std::function<Grid()>& make) override {
    grid_.emplace(mpi::distribute(host_, make, {.root = kFirst}));
    return grid_->local();
  }

  double shared(double value) override {
    MPI_Bcast(&value, 1, MPI_DOUBLE, kFirst, host_);
    return value;
  }

  std::vector<double> gather(std::span<const double> own) override {
    return grid_->gather(own, Location::cell);
  }

  std::vector<double> scatter(std::span<const double> whole) override {
    std::vector<double> out = grid_->scatter(whole, Location::cell);
    out.resize(static_cast<std::size_t>(grid_->local().n_owned(Location::cell)));
    return out;
  }

  void together(const std::function<void()>& body) override {
    const auto failure = failure_of(body);
    int who = failure ? rank_ : size_;
    MPI_Allreduce(MPI_IN_PLACE, &who, 1, MPI_INT, MPI_MIN, host_);
    if (who == size_) return;
    Failure told = failure.value_or(Failure());
    std::array<int, 2> head = {static_cast<int>(told.kind), static_cast<int>(told.text.size())};
    MPI_Bcast(head.data(), 2, MPI_INT, who, host_);
    told.text.resize(static_cast<std::size_t>(head[1]));
    MPI_Bcast(told.text.data(), head[1], MPI_CHAR, who, host_);
    throw Error(static_cast<ErrorKind>(head[0]), told.text);
  }

 private:
  MPI_Comm host_;
  int rank_ = 0;
  int size_ = 1;
  std::optional<mpi::DistributedGrid> grid_;
};

}  // namespace

std::unique_ptr<Team> make_team(int communicator, int /*n_processes*/) {
  return std::make_unique<Processes>(MPI_Comm_f2c(communicator));
}

}  // namespace delos::cap
