// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// MPI as this folder uses it: a communicator of our own, waiting without spinning, messages of any
// length, failures that all processes learn of.
#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "delos/error.hpp"

namespace delos::mpi {

/// Throws Error(internal) with MPI's own text unless `status` is MPI_SUCCESS.
void check(int status, const char* call);

/// A duplicate of the host's communicator that returns errors instead of ending the process.
class Communicator {
 public:
  /// Collective. Error(state) when MPI does not run, the calling thread may not use it, or `host`
  /// is null; Error(config) for an intercommunicator.
  explicit Communicator(MPI_Comm host);
  /// Collective, unless MPI has ended.
  ~Communicator();
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  MPI_Comm get() const { return own_; }
  int rank() const { return rank_; }
  int size() const { return size_; }

  /// Collective: throws on every process if one brings a failure, else does nothing. The process
  /// of lowest rank that failed has its exception back, the others get an Error of its kind and
  /// text. Processes that come early sleep.
  void settle(const std::exception_ptr& failure) const;
  /// settle() of what body() throws.
  template <class Body>
  void together(Body&& body) const {
    std::exception_ptr failure;
    try {
      body();
    } catch (...) {
      failure = std::current_exception();
    }
    settle(failure);
  }

  /// From `root` to all, collective; the others sleep.
  void broadcast(std::string& text, int root) const;
  /// As many on all.
  template <class Values>
  void broadcast(Values&& values, int root) const {
    broadcast_bytes(std::as_writable_bytes(std::span(values)), root);
  }

  /// The least and the greatest that any process gives, for each of as many numbers on all.
  /// Collective; who comes early sleeps.
  struct Range {
    std::vector<std::int64_t> least, greatest;
    bool is_same_everywhere() const { return least == greatest; }
  };
  Range range(std::span<const std::int64_t> mine) const;
  /// An array of plain values to or from one process, in messages that MPI's int can count. The
  /// caller sleeps.
  template <class Values>
  void send(const Values& values, int to) const {
    send_bytes(std::as_bytes(std::span(values)), to);
  }
  template <class Values>
  void receive(Values&& values, int from) const {
    receive_bytes(std::as_writable_bytes(std::span(values)), from);
  }

 private:
  void broadcast_bytes(std::span<std::byte> bytes, int root) const;
  void send_bytes(std::span<const std::byte> bytes, int to) const;
  void receive_bytes(std::span<std::byte> bytes, int from) const;

  MPI_Comm own_ = MPI_COMM_NULL;
  int rank_ = 0;
  int size_ = 1;
};

/// Waits for a request with naps in between: a process of a job whose grid takes minutes leaves its
/// core to the one that makes it.
void wait_asleep(MPI_Request& request);

}  // namespace delos::mpi
