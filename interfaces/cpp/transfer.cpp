// SPDX-License-Identifier: BSD-3-Clause
#include "delos/transfer.hpp"

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>

#include "callbacks.hpp"
#include "grid_access.hpp"
#include "remap/velocities.hpp"
#include "translate.hpp"

namespace delos::api {
namespace {

static_assert(static_cast<int>(TransferOrder::second) == static_cast<int>(remap::Order::second));
static_assert(static_cast<int>(TransferLimiter::none) == static_cast<int>(remap::Limiter::none));
static_assert(static_cast<int>(TransferLimiter::gradient) ==
              static_cast<int>(remap::Limiter::gradient));
static_assert(static_cast<int>(TransferLimiter::assured_sum) ==
              static_cast<int>(remap::Limiter::assured_sum));
static_assert(static_cast<int>(TransferNormalization::whole) ==
              static_cast<int>(remap::Normalization::whole));
static_assert(static_cast<int>(VelocityRoute::stream_function) ==
              static_cast<int>(remap::VelocityRoute::stream_function));
static_assert(static_cast<int>(VelocityRoute::helmholtz) ==
              static_cast<int>(remap::VelocityRoute::helmholtz));

const delos::Grid& engine(const Grid& grid) { return *GridAccess::product(grid).grid; }

remap::TransferOptions engine(const TransferOptions& options) {
  return {static_cast<remap::Order>(options.order), static_cast<remap::Limiter>(options.limiter),
          options.n_levels, static_cast<remap::Normalization>(options.normalization)};
}

std::int64_t levels_of(const TransferOptions& options) {
  DELOS_CHECK(options.n_levels >= 1, delos::ErrorKind::input, "n_levels = ", options.n_levels,
              ": a cell or an edge has at least one value");
  constexpr std::int64_t kMaxLevels = 1'000'000;  // times 7e8 cells stays within 64 bits
  DELOS_CHECK(options.n_levels <= kMaxLevels, delos::ErrorKind::input,
              "n_levels = ", options.n_levels, ": a cell or an edge has at most ", kMaxLevels,
              " values");
  return options.n_levels;
}

bool is_same(const Grid& a, const Grid& b) {
  return a.generation() == b.generation() && a.digest() == b.digest();
}

std::string name_of(const Grid& grid) {
  return text("generation ", grid.generation(), " (", grid.n_cells(), " cells)");
}

remap::Transfer overlapped(const Grid& from, const Grid& to, const GenerateOptions& options,
                           int threads) {
  parallel::Executor exec(threads);
  Monitor monitor(progress_of(options), {}, options.cancel);
  Context context{exec, monitor};
  const Phase phase(monitor, "transfer", to.n_cells());
  return {context, remap::Tiling::cells(exec, engine(from)), remap::Tiling::cells(exec, engine(to)),
          remap::Order::first};
}

}  // namespace

struct Transfer::Impl {
  Impl(const Grid& of, const Grid& onto, const GenerateOptions& options)
      : from(of),
        to(onto),
        threads(options.threads > 0 ? options.threads : GridAccess::product(to).settings.threads),
        transfer(overlapped(from, to, options, threads)) {}

  /// The engine's transfer with all that `order` needs.
  const remap::Transfer& of_order(parallel::Executor& exec, TransferOrder order) const {
    if (order == TransferOrder::second) {
      std::call_once(has_second, [&] {
        transfer.add_second_order(exec, remap::Tiling::cells(exec, engine(from)));
      });
    }
    return transfer;
  }

  void check_size(const char* what, std::size_t given, std::int64_t n, const Grid& grid) const {
    DELOS_CHECK(static_cast<std::int64_t>(given) == n, delos::ErrorKind::input, "the values ", what,
                " are ", given, ", but the grid of ", name_of(grid), " has ", n,
                " of them: pass [n, n_levels] values of the transfer's own grids, from ",
                name_of(from), " to ", name_of(to));
  }

  Grid from, to;
  int threads;
  mutable std::once_flag has_second;
  mutable remap::Transfer transfer;
};

Transfer::Transfer(const Grid& from, const Grid& to, const GenerateOptions& options)
    : impl_(translated([&] { return std::make_shared<const Impl>(from, to, options); })) {}
Transfer::Transfer(const Transfer& other) = default;
Transfer::Transfer(Transfer&& other) noexcept = default;
Transfer& Transfer::operator=(const Transfer& other) = default;
Transfer& Transfer::operator=(Transfer&& other) noexcept = default;
Transfer::~Transfer() = default;

const Grid& Transfer::from() const { return impl_->from; }
const Grid& Transfer::to() const { return impl_->to; }
std::int64_t Transfer::n_overlaps() const { return impl_->transfer.overlaps().size(); }
std::int64_t Transfer::n_unchanged() const { return impl_->transfer.overlaps().n_unchanged; }
std::int64_t Transfer::n_unmapped() const { return impl_->transfer.overlaps().n_unmapped; }

void Transfer::check(const Grid& from, const Grid& to) const {
  translated([&] {
    DELOS_CHECK(is_same(from, impl_->from) && is_same(to, impl_->to), delos::ErrorKind::state,
                "the transfer was made from ", name_of(impl_->from), " to ", name_of(impl_->to),
                ", but it is used from ", name_of(from), " to ", name_of(to),
                ": make one for these grids");
  });
}

void Transfer::apply(std::span<const double> from_cells, std::span<double> to_cells,
                     const TransferOptions& options) const {
  translated([&] {
    const std::int64_t n_levels = levels_of(options);
    impl_->check_size("to carry", from_cells.size(), n_levels * from().n_cells(), from());
    impl_->check_size("to fill", to_cells.size(), n_levels * to().n_cells(), to());
    parallel::Executor exec(impl_->threads);
    impl_->of_order(exec, options.order).apply(exec, from_cells, to_cells, engine(options));
  });
}

void Transfer::apply_velocity(std::span<const double> from_edges, std::span<double> to_edges,
                              VelocityRoute route, const TransferOptions& options) const {
  translated([&] {
    const std::int64_t n_levels = levels_of(options);
    impl_->check_size("to carry", from_edges.size(), n_levels * from().n_edges(), from());
    impl_->check_size("to fill", to_edges.size(), n_levels * to().n_edges(), to());
    parallel::Executor exec(impl_->threads);
    Monitor monitor;
    Context context{exec, monitor};
    const Array<double> moved = remap::transfer_velocities(
        context, impl_->of_order(exec, options.order), {engine(from()), engine(to())}, from_edges,
        {static_cast<remap::VelocityRoute>(route), engine(options)});
    std::copy(moved.begin(), moved.end(), to_edges.begin());
  });
}

}  // namespace delos::api
