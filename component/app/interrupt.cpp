// SPDX-License-Identifier: BSD-3-Clause
#include "app/interrupt.hpp"

#include <csignal>

namespace delos::app {
namespace {

// A signal handler reaches nothing else; the library itself has no such state.
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void on_signal(int signal) {
  interrupted.store(true);
  std::signal(signal, SIG_DFL);
}

}  // namespace

const std::atomic<bool>& watch_for_interrupt() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  // A file that grows beyond `ulimit -f` is then an error of the write, and leaves nothing behind.
  std::signal(SIGXFSZ, SIG_IGN);
  return interrupted;
}

}  // namespace delos::app
