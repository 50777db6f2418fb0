// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Other programs, for tests that ask them what they make of our files.
#include <array>
#include <cstdio>
#include <string>

namespace delos::testing {

struct Outcome {
  int status = -1;     ///< of the shell; 0: the command succeeded
  std::string output;  ///< stdout and stderr
  bool says(const std::string& part) const { return output.find(part) != std::string::npos; }
};

inline Outcome run(const std::string& command) {
  Outcome outcome;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return outcome;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) {
    outcome.output += buffer.data();
  }
  outcome.status = ::pclose(pipe);
  return outcome;
}

}  // namespace delos::testing
