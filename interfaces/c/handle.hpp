// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the opaque handles of delos.h hold, and the one place where exceptions become a status.
#include <atomic>
#include <cstdint>
#include <delos/delos.hpp>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "delos/delos.h"

namespace delos::c {

// Unlikely in memory that is no handle; one for each kind, and one for the destroyed.
constexpr std::uint64_t kContextMagic = 0x64656c6f732e6374;
constexpr std::uint64_t kConfigMagic = 0x64656c6f732e6366;
constexpr std::uint64_t kGridMagic = 0x64656c6f732e6772;
constexpr std::uint64_t kDeadMagic = 0x64656c6f732e7878;

/// The first part of every handle, so that one function reads the text of all.
struct Handle {
  explicit Handle(std::uint64_t kind) : magic(kind) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() = default;

  std::uint64_t magic;
  mutable std::string error;
};

/// Keeps place + message on the handle and returns `status`.
int fail(const Handle& handle, int status, const char* place, const char* message) noexcept;
int status_of(ErrorKind kind) noexcept;

/// An argument that can't be used; becomes DELOS_ERROR_ARGUMENT or DELOS_ERROR_STATE.
struct Refusal {
  int status;
  std::string message;
};

/// Throws Refusal unless the argument points somewhere.
inline void need(const void* argument, const char* name) {
  if (argument == nullptr) {
    throw Refusal{DELOS_ERROR_ARGUMENT, std::string(name) + " is NULL: pass a valid pointer"};
  }
}

/// Runs body(); whatever it throws becomes a status, and a text on `handle` that begins with the
/// function's name where the caller is at fault.
template <class Body>
int guarded(const Handle& handle, const char* function, Body&& body) noexcept {
  try {
    body();
    return DELOS_SUCCESS;
  } catch (const Error& error) {
    return fail(handle, status_of(error.kind()), "", error.what());
  } catch (const Refusal& refusal) {
    return fail(handle, refusal.status, function, refusal.message.c_str());
  } catch (const std::bad_alloc&) {
    // Short enough to need no memory.
    return fail(handle, DELOS_ERROR_RESOURCE, "", "out of memory");
  } catch (const std::exception& error) {
    return fail(handle, DELOS_ERROR_INTERNAL, function, error.what());
  } catch (...) {
    return fail(handle, DELOS_ERROR_INTERNAL, function, "a callback threw");
  }
}

/// DELOS_SUCCESS if `handle` is alive and of the kind; else the text is left on it where it can be.
int check_handle(const Handle* handle, std::uint64_t kind, const char* function) noexcept;

/// A function on a handle: the handle first, then body().
template <class Kind, class Body>
int call(const Kind* handle, const char* function, Body&& body) noexcept {
  const int status = check_handle(handle, Kind::kMagic, function);
  return status == DELOS_SUCCESS ? guarded(*handle, function, body) : status;
}

}  // namespace delos::c

// NOLINTBEGIN(readability-identifier-naming): the names of the C types
struct delos_config : delos::c::Handle {
  static constexpr std::uint64_t kMagic = delos::c::kConfigMagic;
  explicit delos_config(delos::Config made) : Handle(kMagic), config(std::move(made)) {}
  std::optional<delos::Config> config;
  std::string text;
};

struct delos_grid : delos::c::Handle {
  static constexpr std::uint64_t kMagic = delos::c::kGridMagic;
  explicit delos_grid(delos::Grid made) : Handle(kMagic), grid(std::move(made)) {}
  std::optional<delos::Grid> grid;
  std::string paths;
};

struct delos_context : delos::c::Handle {
  static constexpr std::uint64_t kMagic = delos::c::kContextMagic;
  delos_context() : Handle(kMagic) {}
  int n_threads = 0;
  delos_progress_callback on_progress = nullptr;
  void* progress_data = nullptr;
  delos_log_callback on_log = nullptr;
  void* log_data = nullptr;
  std::atomic<bool> cancel{false};
  // Destroyed ones stay as empty shells, so that a stale handle is seen, not followed.
  std::vector<std::unique_ptr<delos_config>> configs;
  std::vector<std::unique_ptr<delos_grid>> grids;
};
// NOLINTEND(readability-identifier-naming)
