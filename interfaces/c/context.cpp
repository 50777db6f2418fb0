// SPDX-License-Identifier: BSD-3-Clause
#include "handle.hpp"

namespace delos::c {
namespace {

const char* kind_name(std::uint64_t magic) {
  switch (magic) {
    case kContextMagic:
      return "a context";
    case kConfigMagic:
      return "a configuration";
    case kGridMagic:
      return "a grid";
    case kComponentMagic:
      return "a component";
    case kStateMagic:
      return "a state";
    case kFieldMagic:
      return "a field";
    case kClockMagic:
      return "a clock";
    case kTransferMagic:
      return "a transfer";
    case kDeadMagic:
      return "destroyed";
    default:
      return nullptr;
  }
}

bool is_known(std::uint64_t magic) { return kind_name(magic) != nullptr; }

}  // namespace

int check_handle(const Handle* handle, std::uint64_t kind, const char* function) noexcept {
  if (handle == nullptr) return DELOS_ERROR_ARGUMENT;
  if (handle->magic == kind) return DELOS_SUCCESS;
  // What is no handle at all must not be written to.
  if (!is_known(handle->magic)) return DELOS_ERROR_STATE;
  return guarded(*handle, function, [&] {
    throw Refusal{DELOS_ERROR_STATE, std::string("the handle is ") + kind_name(handle->magic) +
                                         ", it must be " + kind_name(kind)};
  });
}

GenerateOptions options_of(delos_context& context) {
  GenerateOptions options;
  options.threads = context.n_threads;
  options.cancel = &context.cancel;
  options.progress = [&context](const Progress& state) {
    if (context.on_progress == nullptr) return;
    const delos_progress progress{state.phase.c_str(), state.done, state.total, state.elapsed_s};
    context.on_progress(&progress, context.progress_data);
  };
  options.log = [&context](LogLevel level, const std::string& message) {
    if (context.on_log == nullptr) return;
    context.on_log(static_cast<int>(level), message.c_str(), context.log_data);
  };
  return options;
}

}  // namespace delos::c

using delos::c::call;

int delos_abi_version(void) { return DELOS_ABI_VERSION; }
const char* delos_version(void) { return delos::version(); }

const char* delos_status_name(int status) {
  switch (status) {
    case DELOS_SUCCESS:
      return "success";
    case DELOS_ERROR_STATE:
      return "state";
    case DELOS_ERROR_ARGUMENT:
      return "argument";
    case DELOS_ERROR_CONFIG:
      return "config";
    case DELOS_ERROR_INPUT:
      return "input";
    case DELOS_ERROR_OUTPUT:
      return "output";
    case DELOS_ERROR_RESOURCE:
      return "resource";
    case DELOS_ERROR_INTERNAL:
      return "internal";
    case DELOS_ERROR_QUALITY:
      return "quality";
    case DELOS_ERROR_NOT_FOUND:
      return "not found";
    case DELOS_ERROR_CANCELLED:
      return "cancelled";
    default:
      return "unknown";
  }
}

const char* delos_last_error(const void* handle) {
  if (handle == nullptr) return "the handle is NULL: the call that should have made it failed";
  const auto* const known = static_cast<const delos::c::Handle*>(handle);
  if (!delos::c::is_known(known->magic)) return "this is no handle of delos";
  return known->error.c_str();
}

int delos_context_create(delos_context** context) {
  if (context == nullptr) return DELOS_ERROR_ARGUMENT;
  *context = new (std::nothrow) delos_context;
  return *context == nullptr ? DELOS_ERROR_RESOURCE : DELOS_SUCCESS;
}

int delos_context_destroy(delos_context* context) {
  if (context == nullptr) return DELOS_SUCCESS;
  return call(context, __func__, [&] {
    // Best effort: freed memory should not look like a context. Volatile, or it is optimised away.
    *const_cast<volatile std::uint64_t*>(&context->magic) = 0;
    delete context;
  });
}

int delos_context_set_threads(delos_context* context, int n_threads) {
  return call(context, __func__, [&] {
    if (n_threads < 0) {
      throw delos::c::Refusal{DELOS_ERROR_ARGUMENT, "n_threads = " + std::to_string(n_threads) +
                                                        ": must be >= 0, 0 = as configured"};
    }
    context->n_threads = n_threads;
  });
}

int delos_context_set_progress(delos_context* context, delos_progress_callback callback,
                               void* user_data) {
  return call(context, __func__, [&] {
    context->on_progress = callback;
    context->progress_data = user_data;
  });
}

int delos_context_set_log(delos_context* context, delos_log_callback callback, void* user_data) {
  return call(context, __func__, [&] {
    context->on_log = callback;
    context->log_data = user_data;
  });
}

int delos_context_cancel(delos_context* context) {
  return call(context, __func__, [&] { context->cancel = true; });
}
