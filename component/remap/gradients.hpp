// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Gradients of means over the polygons of a tiling.
#include <span>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "remap/overlap.hpp"
#include "remap/tiling.hpp"

namespace delos::remap {

/// Rows of least squares: gradient of source j = sum over its neighbours k (those of the tiling
/// that exist, from offsets[j] on) of coefficient (f_k - f_j), a vector in the plane that touches
/// the sphere through the source's middle. Scaled: per unit of length. Exact for functions that are
/// linear there.
struct GradientStencils {
  Array<std::int64_t> offsets;  ///< [n_sources + 1]
  Array<Index> neighbour;       ///< [n]
  Array<Vec3> coefficient;      ///< [n]
};

/// Means are taken to be values at source_middle, which is good to second order.
GradientStencils gradient_stencils(parallel::Executor& exec, const Tiling& source,
                                   const Overlaps& overlaps);

/// [n_sources]
Array<Vec3> gradients(parallel::Executor& exec, const GradientStencils& stencils,
                      std::span<const double> field);

}  // namespace delos::remap
