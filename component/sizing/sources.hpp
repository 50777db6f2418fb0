// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The front of this layer: a recipe of sources in memory becomes the spacing.
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/progress.hpp"
#include "sizing/analytic.hpp"
#include "sizing/bathymetry.hpp"
#include "sizing/coast.hpp"
#include "sizing/combine.hpp"
#include "sizing/gradient_limit.hpp"
#include "sizing/raster.hpp"
#include "sizing/region.hpp"
#include "sizing/rossby.hpp"
#include "sizing/solution.hpp"
#include "sizing/spacing.hpp"

namespace delos {

/// Spacing read from a file: bilinear, or averaged where the raster is finer than the table.
struct RasterSource {
  std::shared_ptr<const Raster> raster;
  double metres_per_unit = 1.0;
  std::optional<double> missing_m;  ///< for missing values; without it the nearest valid one
};

struct SpacingSource {
  std::string name;  ///< for messages, e.g. "sizing.sources[2] (coast)"
  std::variant<ConstantSource, LatitudeProfileSource, RasterSource, DiscSource, BoxSource,
               PolygonSource, SlopeSource, TidalSource, CoastSource, RossbySource, EddySource>
      source;
};

/// Steps in this order: sources -> combine -> smooth -> clamp -> land -> limit; with `cells`, scale
/// (before the clamp) and repeat the last three until the count is met.
struct SpacingRecipe {
  LatitudeKind latitude = LatitudeKind::geodetic;
  double resolution_rad = 0.0;  ///< of the table; 0 = default_resolution_rad(surface, recipe)
  std::vector<SpacingSource> sources;
  std::shared_ptr<const Raster> elevation_m;  ///< positive up; for slope, tidal, coast and land
  CombineOptions combine;
  double smooth_rad = 0.0;  ///< Gaussian sigma of the combined field; 0 = none
  std::optional<ClampOptions> clamp;
  std::optional<double> land_spacing_m;  ///< where the elevation is >= 0; needs elevation_m
  double gradient_limit = 0.0;           ///< 0 = none
  std::int64_t cells = 0;                ///< budget: wanted number of vertices; 0 = none
  /// Of a regional grid: the last step coarsens what lies outside, and `cells` is the number in the
  /// region and its rings, met to some per cent.
  std::optional<RegionShape> region;
  OutsideOptions outside;
};

/// The finest gridded source (elevation counts where used), for a region four times its least
/// spacing where a source's formula tells that, at least as fine as 0.5 degree and not finer than
/// 1/12 degree or half the clamp's least spacing.
double default_resolution_rad(const Ellipsoid& surface, const SpacingRecipe& recipe);

/// True when only constants are combined and neither a land value nor a region is given: no table
/// is needed.
bool is_constant(const SpacingRecipe& recipe);

/// The table in metres. Error(config) for options that don't fit together, errors of
/// check_region(), Error(input) with the
/// source's name and lon/lat for values that are not finite and > 0.
LatLonField build_spacing_table(Context& context, const Ellipsoid& surface,
                                const SpacingRecipe& recipe);

/// The table (or the constant) as a field ready for refine.
SpacingField build_spacing(Context& context, const Ellipsoid& surface, const SpacingRecipe& recipe);

}  // namespace delos
