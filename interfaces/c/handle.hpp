// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the opaque handles of delos.h hold, and the one place where exceptions become a status.
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <delos/delos.hpp>
#include <deque>
#include <exception>
#include <map>
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
constexpr std::uint64_t kComponentMagic = 0x64656c6f732e636d;
constexpr std::uint64_t kStateMagic = 0x64656c6f732e7374;
constexpr std::uint64_t kFieldMagic = 0x64656c6f732e6664;
constexpr std::uint64_t kClockMagic = 0x64656c6f732e636c;
constexpr std::uint64_t kTransferMagic = 0x64656c6f732e7472;
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
inline int fail(const Handle& handle, int status, const char* place, const char* message) noexcept {
  try {
    handle.error = place;
    if (*place != '\0') handle.error += ": ";
    handle.error += message;
  } catch (...) {
    handle.error.clear();
  }
  return status;
}

inline int status_of(ErrorKind kind) noexcept {
  switch (kind) {
    case ErrorKind::config:
      return DELOS_ERROR_CONFIG;
    case ErrorKind::input:
      return DELOS_ERROR_INPUT;
    case ErrorKind::output:
      return DELOS_ERROR_OUTPUT;
    case ErrorKind::resource:
      return DELOS_ERROR_RESOURCE;
    case ErrorKind::state:
      return DELOS_ERROR_STATE;
    case ErrorKind::quality:
      return DELOS_ERROR_QUALITY;
    case ErrorKind::cancelled:
      return DELOS_ERROR_CANCELLED;
    case ErrorKind::internal:
      break;
  }
  return DELOS_ERROR_INTERNAL;
}

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

/// Copies into the host's array. Throws Refusal unless it has the room.
inline void fill(const std::vector<double>& from, double* values, int64_t size) {
  if (size != static_cast<int64_t>(from.size())) {
    throw Refusal{DELOS_ERROR_ARGUMENT,
                  "size = " + std::to_string(size) + ": must be " + std::to_string(from.size())};
  }
  if (from.empty()) return;
  need(values, "values");
  std::copy(from.begin(), from.end(), values);
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

/// Throws Refusal unless the argument is a live handle of its kind.
template <class Kind>
void need_handle(const Kind* argument, const char* name) {
  need(argument, name);
  if (argument->magic != Kind::kMagic) {
    throw Refusal{DELOS_ERROR_STATE,
                  std::string(name) + " is no " + Kind::kName + ", or destroyed"};
  }
}

/// Owns the handles of one kind. Destroyed ones stay for a while as empty shells, so that a stale
/// handle is seen, not followed; the oldest shells go, so that memory does not grow.
template <class Kind>
class Handles {
 public:
  Kind* keep(std::unique_ptr<Kind> made) {
    alive_.push_back(std::move(made));
    return alive_.back().get();
  }
  /// The handle's contents must be gone already.
  void retire(Kind* handle) {
    const auto found = std::find_if(alive_.begin(), alive_.end(),
                                    [&](const auto& one) { return one.get() == handle; });
    handle->magic = kDeadMagic;
    shells_.push_back(std::move(*found));
    alive_.erase(found);
    if (shells_.size() > kShells) shells_.pop_front();
  }

  /// visit(handle) for those that are alive.
  template <class Visit>
  void each(Visit&& visit) {
    for (const auto& one : alive_) visit(*one);
  }

 private:
  static constexpr std::size_t kShells = 100;  // as delos.h says
  std::vector<std::unique_ptr<Kind>> alive_;
  std::deque<std::unique_ptr<Kind>> shells_;
};

}  // namespace delos::c

// NOLINTBEGIN(readability-identifier-naming): the names of the C types
struct delos_config : delos::c::Handle {
  static constexpr std::uint64_t kMagic = delos::c::kConfigMagic;
  static constexpr const char* kName = "configuration";
  delos_config(delos_context& owner, delos::Config made)
      : Handle(kMagic), context(owner), config(std::move(made)) {}
  delos_context& context;
  std::optional<delos::Config> config;
  std::string text;
};

struct delos_grid : delos::c::Handle {
  static constexpr std::uint64_t kMagic = delos::c::kGridMagic;
  static constexpr const char* kName = "grid";
  delos_grid(delos_context& owner, delos::Grid made)
      : Handle(kMagic), context(owner), grid(std::move(made)) {}
  delos_context& context;
  std::optional<delos::Grid> grid;
  std::string paths;
};

struct delos_field : delos::c::Handle {
  static constexpr std::uint64_t kMagic = delos::c::kFieldMagic;
  static constexpr const char* kName = "field";
  explicit delos_field(delos::Field taken) : Handle(kMagic), field(std::move(taken)) {}
  std::optional<delos::Field> field;
  std::string time_stamp;
};

struct delos_state : delos::c::Handle {
  static constexpr std::uint64_t kMagic = delos::c::kStateMagic;
  static constexpr const char* kName = "state";
  explicit delos_state(delos::State of_component)
      : Handle(kMagic), state(std::move(of_component)) {}
  std::optional<delos::State> state;
  // One handle a name, however often it is asked for.
  std::map<std::string, std::unique_ptr<delos_field>> fields;
};

struct delos_component : delos::c::Handle {
  static constexpr std::uint64_t kMagic = delos::c::kComponentMagic;
  static constexpr const char* kName = "component";
  delos_component(delos_context& owner, delos::Component made)
      : Handle(kMagic),
        context(owner),
        component(std::move(made)),
        imports(component->import_state()),
        exports(component->export_state()) {}
  delos_context& context;
  std::optional<delos::Component> component;
  delos_state imports, exports;
  delos_grid* grid = nullptr;  // of the current generation, once it was asked for
  std::string time, decision, failure;
};

struct delos_transfer : delos::c::Handle {
  static constexpr std::uint64_t kMagic = delos::c::kTransferMagic;
  static constexpr const char* kName = "transfer";
  delos_transfer(delos_context& owner, delos::Transfer made)
      : Handle(kMagic), context(owner), transfer(std::move(made)) {}
  delos_context& context;
  std::optional<delos::Transfer> transfer;
};

struct delos_clock : delos::c::Handle {
  static constexpr std::uint64_t kMagic = delos::c::kClockMagic;
  static constexpr const char* kName = "clock";
  delos_clock(delos_context& owner, delos::Clock made)
      : Handle(kMagic), context(owner), clock(std::move(made)) {}
  delos_context& context;
  std::optional<delos::Clock> clock;
  mutable std::map<std::string, std::string> texts;  // by the function that handed them out
};

struct delos_context : delos::c::Handle {
  static constexpr std::uint64_t kMagic = delos::c::kContextMagic;
  static constexpr const char* kName = "context";
  delos_context() : Handle(kMagic) {}
  int n_threads = 0;
  delos_progress_callback on_progress = nullptr;
  void* progress_data = nullptr;
  delos_log_callback on_log = nullptr;
  void* log_data = nullptr;
  std::atomic<bool> cancel{false};
  delos::c::Handles<delos_config> configs;
  delos::c::Handles<delos_grid> grids;
  delos::c::Handles<delos_component> components;
  delos::c::Handles<delos_clock> clocks;
  delos::c::Handles<delos_transfer> transfers;
};
// NOLINTEND(readability-identifier-naming)

namespace delos::c {

/// The context's threads, callbacks (those that are set when they are due) and flag to stop; refers
/// to the context.
GenerateOptions options_of(delos_context& context);

/// A request to stop is used up by the call that it stops, or that ended before.
class CancelReset {
 public:
  explicit CancelReset(delos_context& context) : requested_(context.cancel) {}
  CancelReset(const CancelReset&) = delete;
  CancelReset& operator=(const CancelReset&) = delete;
  ~CancelReset() { requested_ = false; }

 private:
  std::atomic<bool>& requested_;
};

}  // namespace delos::c
