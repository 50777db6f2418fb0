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
/// one from which it was. Refers to the product.
class WholeGrid {
 public:
  /// Makes the dual again where the product's grid is culled.
  WholeGrid(Context& context, const Product& product);

  const Grid& grid() const { return made_ ? *made_ : *product_.grid; }
  bool is_culled() const { return made_.has_value(); }

  /// Values of the product's cells at all cells; NaN at those that the product's grid lacks.
  Array<double> spread(std::span<const double> values) const;
  /// The same, but those cells get the mean of their neighbours, ring by ring from the product's
  /// cells outward: within the range of the values.
  Array<double> flooded(std::span<const double> values) const;
  /// Those of the product's cells.
  void pick(std::span<const double> all, std::span<double> values) const;

 private:
  const Product& product_;
  std::optional<Grid> made_;
};

}  // namespace delos
