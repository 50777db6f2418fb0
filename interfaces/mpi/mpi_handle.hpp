// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the handles of delos_mpi.h hold, on the C layer's way from exceptions to a status.
#include <new>
#include <optional>
#include <string>

#include "delos/delos_mpi.h"
#include "delos/distributed.hpp"
#include "handle.hpp"

// NOLINTBEGIN(readability-identifier-naming): the names of the C types
struct delos_mpi_grid : delos::c::Handle {
  static constexpr const char* kName = "grid";
  delos_mpi_grid() : Handle(0x64656c6f732e6d67) {}
  std::optional<delos::mpi::DistributedGrid> held;
};

struct delos_mpi_component : delos::c::Handle {
  static constexpr const char* kName = "component";
  delos_mpi_component() : Handle(0x64656c6f732e6d63) {}
  std::optional<delos::mpi::DistributedComponent> held;
  std::string time;
};
// NOLINTEND(readability-identifier-naming)

namespace delos::mpi::c {

/// A new handle, with what make() gives or with the text of what it throws.
template <class Kind, class Make>
int create(const char* function, Kind** handle, Make&& make) noexcept {
  if (handle == nullptr) return DELOS_ERROR_ARGUMENT;
  *handle = new (std::nothrow) Kind;
  if (*handle == nullptr) return DELOS_ERROR_RESOURCE;
  return delos::c::guarded(**handle, function, [&] { (*handle)->held.emplace(make()); });
}

/// A function on a handle: body(what it holds).
template <class Kind, class Body>
int call(Kind* handle, const char* function, Body&& body) noexcept {
  if (handle == nullptr) return DELOS_ERROR_ARGUMENT;
  return delos::c::guarded(*handle, function, [&] {
    if (!handle->held) {
      throw Error(ErrorKind::state, std::string("this handle has no ") + Kind::kName +
                                        ", since making it failed: destroy it");
    }
    body(*handle->held);
  });
}

template <class Kind>
const char* text_of(const Kind* handle) {
  return handle == nullptr ? "the handle is NULL: the call that should have made it failed"
                           : handle->error.c_str();
}

Options options_of(const delos_mpi_options* given);
/// Error(config) for NULL.
Config config_from_file(const char* path);
Config config_from_text(const char* yaml, const char* folder);

}  // namespace delos::mpi::c
