// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks that an error says what it must.
#include <doctest/doctest.h>

#include <initializer_list>
#include <string>

#include "core/error.hpp"

namespace delos::testing {

/// action() must throw an Error of this kind whose message holds all the parts.
template <class Action>
void expect_error(ErrorKind kind, std::initializer_list<std::string> parts, Action&& action) {
  std::string message;
  try {
    action();
  } catch (const Error& error) {
    message = error.what();
    CHECK(std::string(to_string(error.kind())) == to_string(kind));
  }
  CAPTURE(message);
  REQUIRE_MESSAGE(!message.empty(), "no error was thrown");
  for (const std::string& part : parts) {
    CHECK(message.find(part) != std::string::npos);
  }
}

}  // namespace delos::testing
