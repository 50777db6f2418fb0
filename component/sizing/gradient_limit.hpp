// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Bound on the slope of the spacing: neighbouring cells must not differ too much in size.
#include "core/progress.hpp"
#include "geometry/ellipsoid.hpp"
#include "sizing/spacing.hpp"

namespace delos {

struct GradientLimitReport {
  std::int64_t n_updates =
      0;             ///< times that a node was lowered (fixed by the input, not by threads)
  int n_rounds = 0;  ///< passes over the tiles that still changed
};

/// The largest h' <= h with |grad h'| <= slope on the surface (Persson 2006,
/// doi:10.1007/s00366-006-0014-1; the eikonal equation with an upwind scheme on the table, with
/// the ellipsoid's metric; poles are single points, columns are periodic). Error(config) unless
/// slope > 0.
/// Laws: h' <= h; idempotent; the same bits for any number of threads; from one low node the
/// result is the cone h0 + slope * distance, also over a pole and the date line.
GradientLimitReport limit_gradient(Context& context, const Ellipsoid& surface,
                                   LatitudeKind latitude, double slope, LatLonField& spacing_m);

}  // namespace delos
