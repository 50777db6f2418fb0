// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Spacing in proportion to the first baroclinic Rossby radius, read or computed from a
// climatology of temperature and salinity.
#include <memory>

#include "core/parallel.hpp"
#include "sizing/raster.hpp"
#include "sizing/spacing.hpp"

namespace delos {

/// h = factor * L1. Either `radius_m` or both stacks. Where L1 is missing (land, marginal seas)
/// the nearest valid value serves.
struct RossbySource {
  std::shared_ptr<const Raster> radius_m;
  std::shared_ptr<const RasterStack> temperature_degc;  ///< in situ
  std::shared_ptr<const RasterStack> salinity_psu;
  double factor = 2.0;
  double min_radius_m = 1.0e3;  ///< floor for unstratified water, where L1 falls to 0
};

/// Density of sea water (kg/m3) at practical salinity, in-situ temperature (degC) and sea
/// pressure (dbar): the international equation of state EOS-80 (UNESCO 1981; Fofonoff & Millard
/// 1983, UNESCO Tech. Pap. Mar. Sci. 44). Check value: density(40, 40, 10000) = 1059.82037.
double sea_water_density(double salinity_psu, double temperature_degc, double pressure_dbar);

/// Potential temperature of water moved adiabatically from `pressure` to `reference_dbar`
/// (Bryden 1973; Fofonoff 1977). Check value: (40, 40, 10000, 0) = 36.89073 degC.
double potential_temperature(double salinity_psu, double temperature_degc, double pressure_dbar,
                             double reference_dbar);

/// First baroclinic Rossby radius (m) on the nodes of the stacks (Chelton et al. 1998,
/// doi:10.1175/1520-0485(1998)028<0433:GVOTFB>2.0.CO;2): with c = integral of N dz / pi,
/// L1 = c / |f| away from the equator and sqrt(c / (2 beta)) near it, the smaller of the two, which
/// is continuous. N^2 between two levels from their densities referenced adiabatically to the
/// pressure midway; below the last valid level half the way to the next at the last N. NaN where
/// fewer than two levels are valid. Error(input) unless the stacks share their nodes.
Raster rossby_radius(parallel::Executor& exec, const RasterStack& temperature_degc,
                     const RasterStack& salinity_psu);

void fill_rossby(parallel::Executor& exec, const RossbySource& source, LatLonField& field);

}  // namespace delos
