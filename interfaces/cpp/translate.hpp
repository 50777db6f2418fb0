// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The way into the engine: the one place where its errors become public ones, and where the host's
// floating point is put aside.
#include "core/error.hpp"
#include "core/floating_point.hpp"
#include "delos/error.hpp"

namespace delos::api {

static_assert(static_cast<int>(ErrorKind::config) == static_cast<int>(delos::ErrorKind::config));
static_assert(static_cast<int>(ErrorKind::input) == static_cast<int>(delos::ErrorKind::input));
static_assert(static_cast<int>(ErrorKind::output) == static_cast<int>(delos::ErrorKind::output));
static_assert(static_cast<int>(ErrorKind::resource) ==
              static_cast<int>(delos::ErrorKind::resource));
static_assert(static_cast<int>(ErrorKind::state) == static_cast<int>(delos::ErrorKind::state));
static_assert(static_cast<int>(ErrorKind::quality) == static_cast<int>(delos::ErrorKind::quality));
static_assert(static_cast<int>(ErrorKind::cancelled) ==
              static_cast<int>(delos::ErrorKind::cancelled));
static_assert(static_cast<int>(ErrorKind::internal) ==
              static_cast<int>(delos::ErrorKind::internal));

/// function() in the default floating-point environment, with the engine's errors rethrown as
/// public ones. std::bad_alloc and a host's own exceptions from a callback pass through as they
/// are.
template <class Function>
auto translated(Function&& function) -> decltype(function()) {
  const DefaultFloatingPoint own;
  try {
    return function();
  } catch (const delos::Error& error) {
    throw Error(static_cast<ErrorKind>(error.kind()), error.what());
  }
}

}  // namespace delos::api
