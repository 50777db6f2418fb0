// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Fields of one grid on another.
#include <span>

#include "core/progress.hpp"
#include "remap/gradients.hpp"
#include "remap/overlap.hpp"
#include "remap/weights.hpp"

namespace delos::remap {

enum class Order {
  first,  ///< constant in each source
  second  ///< linear in each source
};

enum class Limiter {
  none,
  /// Gradients are shortened until no overlap's value leaves the range of the source and its
  /// neighbours (Barth & Jespersen 1989, doi:10.2514/6.1989-366). Only the second order needs it.
  gradient,
  /// Values that leave the range of the sources that a target covers and of their neighbours are
  /// clipped, and what that takes is given to the others in proportion to their room (clip and
  /// assured sum: Bradley et al. 2019, doi:10.1137/18M1165414). Keeps the order at extremes too.
  assured_sum
};

/// Of a target that sources with a border cover in part. One that they don't cover gets NaN.
enum class Normalization {
  covered,  ///< the mean over what is covered ("fracarea"): constants are kept
  whole     ///< that mean times the covered fraction ("destarea"): area times value keeps the mass
};

struct TransferOptions {
  Order order = Order::second;
  Limiter limiter = Limiter::gradient;
  std::int64_t n_levels = 1;  ///< values of a polygon, which stand together: [n, n_levels]
  Normalization normalization = Normalization::covered;
};

/// Everything that carries fields from one grid to another, computed once for many fields; needs
/// the grids no longer.
class Transfer {
 public:
  /// What the highest order needs is made at once: the second needs gradients' stencils, a quarter
  /// of the time. Advances the phase that the caller has begun by one for each target. Errors as
  /// intersect().
  Transfer(Context& context, const Tiling& source, const Tiling& target,
           Order highest = Order::second);

  const Overlaps& overlaps() const { return overlaps_; }
  /// Makes what the second order needs, unless it is there; `source` is the constructor's.
  void add_second_order(parallel::Executor& exec, const Tiling& source);
  /// Linear transfer as a matrix; that of the second order reaches to the neighbours. Error(state)
  /// when the transfer was made for the first order only.
  /// The rows of targets that are not covered are empty.
  Weights weights(parallel::Executor& exec, Order order,
                  Normalization normalization = Normalization::covered) const;
  /// Mass kept within 1e-14, a constant and unchanged polygons to the last bit; with a limiter, and
  /// to first order, no value outside the range of the sources that a target covers and, to second
  /// order, of their neighbours; each level by itself. Values must be finite. The same bits for any
  /// number of threads. Error(input) when a size does not fit or for Limiter::assured_sum
  /// between grids of which one has a border, Error(state) as weights().
  void apply(parallel::Executor& exec, std::span<const double> source, std::span<double> target,
             const TransferOptions& options = {}) const;
  /// As apply, of one level, where NaN means missing: a target gets the mean over its valid part,
  /// NaN where that is less than `least_valid` of what is covered. Sources with a missing neighbour
  /// have no gradient; the sum of value times valid area is kept, but for what targets below
  /// `least_valid` cover. Error(input) for Limiter::assured_sum, which has to know all.
  void apply_valid(parallel::Executor& exec, std::span<const double> source,
                   std::span<double> target, const TransferOptions& options,
                   double least_valid = 0.5) const;

 private:
  void require(Order order) const;
  Weights second_order_weights(parallel::Executor& exec) const;
  void scale_to_whole(parallel::Executor& exec, std::span<double> target) const;
  void apply_level(parallel::Executor& exec, std::span<const double> source,
                   std::span<double> target, const TransferOptions& options) const;
  void check_sizes(std::size_t n_source, std::size_t n_target, std::int64_t n_levels) const;
  Array<Vec3> limited_gradients(parallel::Executor& exec, std::span<const double> source,
                                const TransferOptions& options) const;

  Overlaps overlaps_;
  ByKey by_source_;
  GradientStencils stencils_;
};

}  // namespace delos::remap
