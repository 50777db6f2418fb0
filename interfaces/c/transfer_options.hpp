// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Arguments of transfers, from C's to C++'s.
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>

#include "handle.hpp"

namespace delos::c {

template <class Choice>
Choice chosen(std::initializer_list<Choice> choices, int32_t given, const char* name) {
  if (given < 0 || given >= static_cast<int32_t>(choices.size())) {
    throw Refusal{DELOS_ERROR_ARGUMENT, std::string(name) + " = " + std::to_string(given) +
                                            ": must be one of the constants of delos/transfer.h"};
  }
  return *(choices.begin() + given);
}

inline TransferOptions transfer_options(const delos_transfer_options& options) {
  return {.order = chosen({TransferOrder::second, TransferOrder::first}, options.order, "order"),
          .limiter = chosen(
              {TransferLimiter::gradient, TransferLimiter::none, TransferLimiter::assured_sum},
              options.limiter, "limiter"),
          .n_levels = options.n_levels == 0 ? 1 : options.n_levels,
          .normalization = chosen({TransferNormalization::covered, TransferNormalization::whole},
                                  options.normalization, "normalization")};
}

/// Without options all are what their zeros mean.
inline delos_transfer_options or_defaults(const delos_transfer_options* options) {
  return options == nullptr ? delos_transfer_options{} : *options;
}

inline VelocityRoute velocity_route(const delos_transfer_options& options) {
  return chosen({VelocityRoute::vectors, VelocityRoute::stream_function, VelocityRoute::helmholtz},
                options.velocity, "velocity");
}

/// An array of the host's as both sides see it.
template <class Number>
std::span<Number> values_of(Number* first, int64_t n, const char* name) {
  if (n < 0) {
    throw Refusal{DELOS_ERROR_ARGUMENT, std::string("the size of ") + name + " is " +
                                            std::to_string(n) + ": must be >= 0"};
  }
  if (n > 0) need(first, name);
  return {first, static_cast<std::size_t>(n)};
}

}  // namespace delos::c
