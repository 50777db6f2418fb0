// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Transfer as a sparse matrix: target = W source.
#include <span>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "remap/overlap.hpp"

namespace delos::remap {

/// Compressed sparse rows (csr), columns ascending in a row.
struct Weights {
  std::int64_t n_columns = 0;
  bool adds_to_one = true;      ///< each row that is not empty, but for rounding
  Array<std::int64_t> offsets;  ///< [n_rows + 1]
  Array<Index> column;          ///< [n]
  Array<double> value;          ///< [n]

  std::int64_t n_rows() const { return static_cast<std::int64_t>(offsets.size()) - 1; }
};

/// Overlap over target area: rows sum to 1, a target's value is the mean of what it covers.
Weights first_order_weights(parallel::Executor& exec, const Overlaps& overlaps);

/// `target` = W `source`, summed as r + sum w (source - r), r the source of the largest weight: a
/// constant stays that constant to the last bit, and a row of one weight 1 copies. Where rows do
/// not add up to 1, plainly sum w source; 0 for an empty row. Error(input) when a size does not
/// fit.
void apply(parallel::Executor& exec, const Weights& weights, std::span<const double> source,
           std::span<double> target);

/// The transposed matrix (the adjoint of the transfer), W^T: [n_columns] rows.
Weights transpose(parallel::Executor& exec, const Weights& weights);

}  // namespace delos::remap
