// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The whole surface's cells behind a grid of a part of it.
#include <optional>
#include <span>

#include "core/array.hpp"
#include "core/progress.hpp"
#include "dual/grid.hpp"
#include "lifecycle/generate.hpp"

namespace delos {

/// The dual of all of a product's mesh: the product's own grid, or, where that one was culled, the
/// one from which it was. Refers to the product and the context.
class WholeGrid {
 public:
  WholeGrid(Context& context, const Product& product) : context_(context), product_(product) {}

  bool is_culled() const { return product_.domain.has_value(); }
  const Ellipsoid& surface() const { return product_.grid->surface; }
  /// Where the product's grid is culled, the first call makes the dual again: a phase "dual", which
  /// no other may hold.
  const Grid& grid();

  /// Values of the product's cells at all cells; NaN at those that the product's grid lacks. Makes
  /// no dual.
  Array<double> spread(std::span<const double> values) const;
  /// The same, but those cells get the mean of their neighbours, ring by ring from the product's
  /// cells outward: within the range of the values.
  Array<double> flooded(std::span<const double> values);
  /// Those of the product's cells. Makes no dual.
  void pick(std::span<const double> all, std::span<double> values) const;

 private:
  Context& context_;
  const Product& product_;
  std::optional<Grid> made_;
};

}  // namespace delos
