// SPDX-License-Identifier: BSD-3-Clause
#include "handle.hpp"
#include "transfer_options.hpp"

using delos::c::call;
using delos::c::need;
using delos::c::need_handle;
using delos::c::or_defaults;
using delos::c::transfer_options;
using delos::c::values_of;
using delos::c::velocity_route;

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

// NOLINTBEGIN(readability-function-size): arrays and their sizes, as everywhere in C
int delos_transfer_apply(const delos_transfer* transfer, const double* from, int64_t n_from_values,
                         double* to, int64_t n_to_values, const delos_transfer_options* options) {
  return call(transfer, __func__, [&] {
    transfer->transfer->apply(values_of(from, n_from_values, "from"),
                              values_of(to, n_to_values, "to"),
                              transfer_options(or_defaults(options)));
  });
}

int delos_transfer_apply_velocity(const delos_transfer* transfer, const double* from,
                                  int64_t n_from_values, double* to, int64_t n_to_values,
                                  const delos_transfer_options* options) {
  return call(transfer, __func__, [&] {
    const delos_transfer_options given = or_defaults(options);
    transfer->transfer->apply_velocity(values_of(from, n_from_values, "from"),
                                       values_of(to, n_to_values, "to"), velocity_route(given),
                                       transfer_options(given));
  });
}
// NOLINTEND(readability-function-size)

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

int delos_transfer_n_unmapped(const delos_transfer* transfer, int64_t* n) {
  return call(transfer, __func__, [&] {
    need(n, "n");
    *n = transfer->transfer->n_unmapped();
  });
}
