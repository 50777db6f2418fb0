// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Spacing that resolves the sea floor's slope and the tide's wave length.
#include "core/parallel.hpp"
#include "geometry/ellipsoid.hpp"
#include "sizing/spacing.hpp"

namespace delos {

/// h = 2 pi H / (cells |grad H|), the topographic length scale (Hannah & Wright 1995; Lyard et al.
/// 2006, doi:10.1007/s10236-006-0086-x). H is the depth, at least `min_depth_m`.
struct SlopeSource {
  double cells = 20.0;      ///< cells a topographic wave length
  double smooth_rad = 0.0;  ///< Gaussian sigma applied to the depth first; 0 = none
  double min_depth_m = 10.0;
  double max_m = 1.0e6;  ///< where the floor is flat
};

/// h = T sqrt(g H) / cells, the length of the tidal wave of period T (Westerink et al. 1994).
struct TidalSource {
  double period_s = 12.42 * 3600.0;
  double cells = 100.0;
  double min_depth_m = 10.0;
};

/// `field` comes in as elevation (m, positive up, sea < 0, nothing missing) on the nodes of the
/// table and leaves as metres of spacing. On land the depth is `min_depth_m`; give land a spacing
/// of its own.
void fill_slope(parallel::Executor& exec, const Ellipsoid& surface, LatitudeKind latitude,
                const SlopeSource& source, LatLonField& field);
void fill_tidal(parallel::Executor& exec, const TidalSource& source, LatLonField& field);

/// Gravity for c = sqrt(g H), m/s2.
inline constexpr double kGravity = 9.80665;

}  // namespace delos
