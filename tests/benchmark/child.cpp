// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/child.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <stdexcept>

namespace delos::benchmark {
namespace {

/// First byte of what the child sends: what kind of text follows.
constexpr char kDone = 'd', kFailed = 'f';

[[noreturn]] void serve(const std::function<std::string()>& work, int pipe_end) {
  std::string message;
  try {
    message = kDone + work();
  } catch (const std::exception& error) {
    message = std::string(1, kFailed) + error.what();
  }
  std::size_t sent = 0;
  while (sent < message.size()) {
    const ssize_t n = write(pipe_end, message.data() + sent, message.size() - sent);
    if (n < 0 && errno != EINTR) break;
    if (n > 0) sent += static_cast<std::size_t>(n);
  }
  // Not exit(): what the parent has registered and buffered is the parent's.
  _exit(sent == message.size() ? 0 : 1);
}

std::string receive(int pipe_end) {
  std::string message;
  std::array<char, 4096> buffer{};
  while (true) {
    const ssize_t n = read(pipe_end, buffer.data(), buffer.size());
    if (n > 0) message.append(buffer.data(), static_cast<std::size_t>(n));
    if (n == 0 || (n < 0 && errno != EINTR)) return message;
  }
}

}  // namespace

std::string run_in_child(const std::function<std::string()>& work) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe to a child process");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no child process");
  if (child == 0) {
    close(ends[0]);
    serve(work, ends[1]);
  }
  close(ends[1]);
  const std::string message = receive(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) {
    throw std::runtime_error("ended by signal " + std::to_string(WTERMSIG(status)) +
                             " (9: most likely out of memory)");
  }
  if (message.empty()) throw std::runtime_error("ended without a word");
  if (message.front() == kFailed) throw std::runtime_error(message.substr(1));
  return message.substr(1);
}

}  // namespace delos::benchmark
