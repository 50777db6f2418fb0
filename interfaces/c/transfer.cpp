// SPDX-License-Identifier: BSD-3-Clause
#include <span>

#include "handle.hpp"

using delos::c::call;
using delos::c::need;
using delos::c::need_handle;

namespace {

template <class Choice>
Choice chosen(std::initializer_list<Choice> choices, int32_t given, const char* name) {
  if (given < 0 || given >= static_cast<int32_t>(choices.size())) {
    throw delos::c::Refusal{DELOS_ERROR_ARGUMENT,
                            std::string(name) + " = " + std::to_string(given) +
                                ": must be one of the constants of delos/transfer.h"};
  }
  return *(choices.begin() + given);
}

delos::TransferOptions cpp_options(const delos_transfer_options& options) {
  using delos::TransferLimiter;
  using delos::TransferOrder;
  return {.order = chosen({TransferOrder::second, TransferOrder::first}, options.order, "order"),
          .limiter = chosen(
              {TransferLimiter::gradient, TransferLimiter::none, TransferLimiter::assured_sum},
              options.limiter, "limiter"),
          .n_levels = options.n_levels == 0 ? 1 : options.n_levels};
}

/// An array of the host's as both sides see it.
template <class Number>
std::span<Number> values_of(Number* first, int64_t n, const char* name) {
  if (n < 0) {
    throw delos::c::Refusal{DELOS_ERROR_ARGUMENT, std::string("the size of ") + name + " is " +
                                                      std::to_string(n) + ": must be >= 0"};
  }
  if (n > 0) need(first, name);
  return {first, static_cast<std::size_t>(n)};
}

}  // namespace

int delos_transfer_create(delos_context* context, const delos_grid* from, const delos_grid* to,
                          delos_transfer** transfer) {
  if (transfer != nullptr) *transfer = nullptr;
  return call(context, __func__, [&] {
    need_handle(from, "from");
    need_handle(to, "to");
    need(transfer, "transfer");
    const delos::c::CancelReset reset(*context);
    *transfer = context->transfers.keep(std::make_unique<delos_transfer>(
        *context, delos::Transfer(*from->grid, *to->grid, delos::c::options_of(*context))));
  });
}

int delos_transfer_destroy(delos_transfer* transfer) {
  if (transfer == nullptr) return DELOS_SUCCESS;
  return call(transfer, __func__, [&] {
    transfer->transfer.reset();
    transfer->context.transfers.retire(transfer);
  });
}

int delos_transfer_check(const delos_transfer* transfer, const delos_grid* from,
                         const delos_grid* to) {
  return call(transfer, __func__, [&] {
    need_handle(from, "from");
    need_handle(to, "to");
    transfer->transfer->check(*from->grid, *to->grid);
  });
}

// NOLINTNEXTLINE(readability-function-size): arrays and their sizes, as everywhere in C
int delos_transfer_apply(const delos_transfer* transfer, const double* from, int64_t n_from_values,
                         double* to, int64_t n_to_values, const delos_transfer_options* options) {
  return call(transfer, __func__, [&] {
    const delos_transfer_options given = options == nullptr ? delos_transfer_options{} : *options;
    transfer->transfer->apply(values_of(from, n_from_values, "from"),
                              values_of(to, n_to_values, "to"), cpp_options(given));
  });
}

// NOLINTNEXTLINE(readability-function-size): arrays and their sizes, as everywhere in C
int delos_transfer_apply_velocity(const delos_transfer* transfer, const double* from,
                                  int64_t n_from_values, double* to, int64_t n_to_values,
                                  const delos_transfer_options* options) {
  return call(transfer, __func__, [&] {
    const delos_transfer_options given = options == nullptr ? delos_transfer_options{} : *options;
    using delos::VelocityRoute;
    const auto route = chosen({VelocityRoute::vectors, VelocityRoute::stream_function},
                              given.velocity, "velocity");
    transfer->transfer->apply_velocity(values_of(from, n_from_values, "from"),
                                       values_of(to, n_to_values, "to"), route, cpp_options(given));
  });
}

int delos_transfer_n_overlaps(const delos_transfer* transfer, int64_t* n) {
  return call(transfer, __func__, [&] {
    need(n, "n");
    *n = transfer->transfer->n_overlaps();
  });
}

int delos_transfer_n_unchanged(const delos_transfer* transfer, int64_t* n) {
  return call(transfer, __func__, [&] {
    need(n, "n");
    *n = transfer->transfer->n_unchanged();
  });
}
