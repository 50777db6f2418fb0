// SPDX-License-Identifier: BSD-3-Clause
#include "communicator.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <new>
#include <thread>

namespace delos::mpi {
namespace {

constexpr int kTag = 0;  // the communicator is ours alone, and messages of a pair keep their order
// MPI counts in int; a power of two well below 2^31.
constexpr std::size_t kLongestMessage = std::size_t{1} << 30;

void check_running() {
  int is_up = 0, is_down = 0;
  MPI_Initialized(&is_up);
  MPI_Finalized(&is_down);
  if (is_up == 0 || is_down != 0) {
    throw Error(ErrorKind::state, is_up == 0
                                      ? "MPI is not initialized: call MPI_Init_thread before delos."
                                      : "MPI has been finalized: use delos before MPI_Finalize.");
  }
  int level = MPI_THREAD_SINGLE, is_main = 0;
  MPI_Query_thread(&level);
  MPI_Is_thread_main(&is_main);
  if (level < MPI_THREAD_SERIALIZED && is_main == 0) {
    throw Error(ErrorKind::state,
                "this thread may not call MPI: call delos from the thread that initialized MPI, or "
                "initialize it with MPI_THREAD_SERIALIZED.");
  }
}

/// What a failure is to the other processes.
struct Failure {
  std::int32_t kind = 0;
  std::string text;
};

Failure describe(const std::exception_ptr& failure) {
  const auto of = [](ErrorKind kind, std::string text) {
    return Failure{static_cast<std::int32_t>(kind), std::move(text)};
  };
  try {
    std::rethrow_exception(failure);
  } catch (const Error& error) {
    return of(error.kind(), error.what());
  } catch (const std::bad_alloc&) {
    return of(ErrorKind::resource, "out of memory");
  } catch (const std::exception& error) {
    return of(ErrorKind::internal, error.what());
  } catch (...) {
    return of(ErrorKind::internal, "a callback threw");
  }
}

}  // namespace

void check(int status, const char* call) {
  if (status == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  MPI_Error_string(status, text.data(), &length);
  throw Error(ErrorKind::internal, std::string(call) + ": " +
                                       std::string(text.data(), static_cast<std::size_t>(length)));
}

void wait_asleep(MPI_Request& request) {
  // Short messages come while we poll; then naps grow, up to what nobody notices beside a grid.
  constexpr int kPolls = 100;
  constexpr auto kLongest = std::chrono::microseconds(10000);
  auto nap = std::chrono::microseconds(20);
  int is_done = 0;
  for (int poll = 0;; ++poll) {
    check(MPI_Test(&request, &is_done, MPI_STATUS_IGNORE), "MPI_Test");
    if (is_done != 0) return;
    if (poll < kPolls) continue;
    std::this_thread::sleep_for(nap);
    nap = std::min(2 * nap, kLongest);
  }
}

Communicator::Communicator(MPI_Comm host) {
  check_running();
  if (host == MPI_COMM_NULL) {
    throw Error(ErrorKind::state,
                "the communicator is MPI_COMM_NULL: only processes of the communicator may call "
                "delos, with that communicator.");
  }
  int is_inter = 0;
  MPI_Comm_test_inter(host, &is_inter);
  if (is_inter != 0) {
    throw Error(ErrorKind::config,
                "the communicator joins two groups: give one of a single group of processes.");
  }
  // Asleep, too: a process may come long before the others.
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Comm_idup(host, &own_, &request), "MPI_Comm_idup");
  wait_asleep(request);
  MPI_Comm_set_errhandler(own_, MPI_ERRORS_RETURN);
  MPI_Comm_rank(own_, &rank_);
  MPI_Comm_size(own_, &size_);
}

Communicator::~Communicator() {
  int is_down = 0;
  MPI_Finalized(&is_down);
  if (is_down == 0) MPI_Comm_free(&own_);
}

void Communicator::settle(const std::exception_ptr& failure) const {
  constexpr int kNobody = std::numeric_limits<int>::max();
  const int mine = failure ? rank_ : kNobody;
  int first = kNobody;
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Iallreduce(&mine, &first, 1, MPI_INT, MPI_MIN, own_, &request), "MPI_Iallreduce");
  wait_asleep(request);
  if (first == kNobody) return;
  Failure shared;
  if (rank_ == first) shared = describe(failure);
  check(MPI_Bcast(&shared.kind, 1, MPI_INT32_T, first, own_), "MPI_Bcast");
  broadcast(shared.text, first);
  if (rank_ == first) std::rethrow_exception(failure);
  throw Error(static_cast<ErrorKind>(shared.kind), shared.text);
}

void Communicator::broadcast(std::string& text, int root) const {
  auto size = static_cast<std::uint64_t>(text.size());
  broadcast(std::span(&size, 1), root);
  text.resize(static_cast<std::size_t>(size));
  broadcast(std::span(text), root);
}

void Communicator::broadcast_bytes(std::span<std::byte> bytes, int root) const {
  for (std::size_t begin = 0; begin < bytes.size(); begin += kLongestMessage) {
    const auto n = static_cast<int>(std::min(kLongestMessage, bytes.size() - begin));
    MPI_Request request = MPI_REQUEST_NULL;
    check(MPI_Ibcast(bytes.data() + begin, n, MPI_BYTE, root, own_, &request), "MPI_Ibcast");
    wait_asleep(request);
  }
}

Communicator::Range Communicator::range(std::span<const std::int64_t> mine) const {
  // One reduction for both: the least of all complements is the complement of the greatest.
  std::vector<std::int64_t> both(mine.begin(), mine.end());
  for (const std::int64_t number : mine) both.push_back(~number);
  std::vector<std::int64_t> least(both.size());
  MPI_Request request = MPI_REQUEST_NULL;
  check(MPI_Iallreduce(both.data(), least.data(), static_cast<int>(both.size()), MPI_INT64_T,
                       MPI_MIN, own_, &request),
        "MPI_Iallreduce");
  wait_asleep(request);
  const auto middle = least.begin() + static_cast<std::ptrdiff_t>(mine.size());
  Range out{{least.begin(), middle}, {}};
  std::transform(middle, least.end(), std::back_inserter(out.greatest),
                 [](std::int64_t number) { return ~number; });
  return out;
}

void Communicator::send_bytes(std::span<const std::byte> bytes, int to) const {
  for (std::size_t begin = 0; begin < bytes.size(); begin += kLongestMessage) {
    const auto n = static_cast<int>(std::min(kLongestMessage, bytes.size() - begin));
    MPI_Request request = MPI_REQUEST_NULL;
    check(MPI_Isend(bytes.data() + begin, n, MPI_BYTE, to, kTag, own_, &request), "MPI_Isend");
    wait_asleep(request);
  }
}

void Communicator::receive_bytes(std::span<std::byte> bytes, int from) const {
  for (std::size_t begin = 0; begin < bytes.size(); begin += kLongestMessage) {
    const auto n = static_cast<int>(std::min(kLongestMessage, bytes.size() - begin));
    MPI_Request request = MPI_REQUEST_NULL;
    check(MPI_Irecv(bytes.data() + begin, n, MPI_BYTE, from, kTag, own_, &request), "MPI_Irecv");
    wait_asleep(request);
  }
}

}  // namespace delos::mpi
