// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Fields of one grid on another: a model's state after its component has made a new grid.
//
//   const delos::Grid before = component.grid();
//   component.run(imports, exports, clock);
//   if (component.generation() != before.generation()) {
//     const delos::Grid after = component.grid();
//     const delos::Transfer transfer(before, after);
//     std::vector<double> old = std::exchange(depth, std::vector<double>(after.n_cells()));
//     transfer.apply(old, depth);
//   }
#include <cstdint>
#include <memory>
#include <span>

#include "delos/export.hpp"
#include "delos/generate.hpp"
#include "delos/grid.hpp"

namespace delos::api {

enum class TransferOrder {
  first,  ///< constant in each cell
  second  ///< linear in each cell
};

/// To second order; values of the first leave no range.
enum class TransferLimiter {
  none,
  gradient,    ///< gradients are shortened: local, no new extremes
  assured_sum  ///< values are clipped, others take what that took: keeps the order at extremes too
};

/// Of a cell that the other grid, which has a border, covers in part.
enum class TransferNormalization {
  covered,  ///< the mean over what is covered ("fracarea"): constants are kept
  whole     ///< that mean times the covered fraction ("destarea"): area times value keeps the mass
};

struct TransferOptions {
  TransferOrder order = TransferOrder::second;
  TransferLimiter limiter = TransferLimiter::gradient;
  std::int64_t n_levels = 1;  ///< values of a cell or an edge, which stand together
  TransferNormalization normalization = TransferNormalization::covered;
};

enum class VelocityRoute {
  vectors,  ///< by Cartesian vectors at the cells
  /// The part without divergence by its stream function, so that it gets none: 1e-12 of velocity
  /// over spacing; the rest as vectors. Takes some forty rounds of a solver for a flow with
  /// divergence.
  stream_function,
  /// Both parts by their potentials: a flow without divergence gets none, and of any flow every
  /// cell gets the divergence that apply() makes of the old cells' with the same order and limiter
  /// (limiter `gradient` for `assured_sum`), within 1e-10 of velocity over spacing; the
  /// divergence's sum over any part of the grid whose border stays is kept. Takes some forty rounds
  /// of a solver, then some twenty.
  helmholtz
};

/// Made once for a pair of grids, used for many fields. Keeps both grids' arrays. Copies are the
/// same transfer. Any number of threads may use it. The same bits for any number of threads.
class DELOS_API Transfer {
 public:
  /// Of the options `log` is not used, and `progress` and `cancel` in the constructor only.
  /// Error(input) when the grids lie on different surfaces, Error(cancelled). Grids may have a
  /// border (they were culled); see apply().
  Transfer(const Grid& from, const Grid& to, const GenerateOptions& options = {});
  Transfer(const Transfer& other);
  Transfer(Transfer&& other) noexcept;
  Transfer& operator=(const Transfer& other);
  Transfer& operator=(Transfer&& other) noexcept;
  ~Transfer();

  const Grid& from() const;
  const Grid& to() const;
  /// Error(state), naming the generations, unless the transfer was made for these two grids: for
  /// hosts that keep it.
  void check(const Grid& from, const Grid& to) const;

  /// Means over cells: [from().n_cells(), n_levels] to [to().n_cells(), n_levels]. The sum of value
  /// times area is kept within 1e-14, a constant and cells that did not change to the last bit;
  /// with a limiter, or to first order, no value leaves the range of the cells below it and (second
  /// order) of their neighbours. Values must be finite. Between grids with a border a cell gets the
  /// mean over what from() covers of it (options.normalization), NaN where that is nothing, and
  /// gradients come from the neighbours that exist. Error(input) when a size does not fit,
  /// or for TransferLimiter::assured_sum when a grid has a border.
  void apply(std::span<const double> from_cells, std::span<double> to_cells,
             const TransferOptions& options = {}) const;
  /// Velocities along the edges' normals: [from().n_edges(), n_levels] to [to().n_edges(),
  /// n_levels]. Edges between cells that did not change keep theirs to the last bit, with the sign
  /// of the normal. Error(input) when a size does not fit. With a border (the normalization is not
  /// used):
  /// - Nothing flows through the border's edges of to(). VelocityRoute::helmholtz is Error(input).
  /// - By vectors, what from() has at its border's edges counts in its cells, and edges between two
  ///   cells that from() does not cover get NaN.
  /// - By the stream function, which is one number on each connected coast, a flow without
  ///   divergence that goes through no border gets none, in cells that from() does not cover too
  ///   (there is no NaN); what flows between two coasts that both grids have stays. Where a coast
  ///   is new, or lost a passage, edges beside it change even between cells that did not.
  void apply_velocity(std::span<const double> from_edges, std::span<double> to_edges,
                      VelocityRoute route = VelocityRoute::vectors,
                      const TransferOptions& options = {}) const;

  /// Pairs of cells that overlap.
  std::int64_t n_overlaps() const;
  /// Cells of to() that are cells of from().
  std::int64_t n_unchanged() const;
  /// Cells of to() that from() does not cover: they get NaN.
  std::int64_t n_unmapped() const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace delos::api

#ifndef DELOS_BUILDING_LIBRARY
namespace delos {
using api::Transfer;
using api::TransferLimiter;
using api::TransferNormalization;
using api::TransferOptions;
using api::TransferOrder;
using api::VelocityRoute;
}  // namespace delos
#endif
