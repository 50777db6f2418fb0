// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Spacing from what a model or an altimeter saw: eddy kinetic energy or the variance of sea
// surface height (Sein et al. 2016, doi:10.1002/2016MS000650), or any amplitude of a model's own.
#include <memory>
#include <variant>

#include "core/parallel.hpp"
#include "sizing/raster.hpp"
#include "sizing/spacing.hpp"

namespace delos {

/// What the field holds: EKE in m2/s2 (amplitude u_rms = sqrt(2 EKE) in m/s), or the variance of
/// sea surface height in m2 (amplitude = standard deviation in m), or the amplitude itself, >= 0,
/// in any unit (|grad vorticity| in 1/(m s), say).
enum class EddyQuantity { kinetic_energy, height_variance, amplitude };

/// Spacing straight in the amplitude between two points, constant beyond them.
struct EddyLinear {
  double quiet_amplitude = 0.05, quiet_spacing_m = 60.0e3;
  double energetic_amplitude = 0.45, energetic_spacing_m = 10.0e3;
};

/// One spacing below the threshold of the amplitude, one at and above it.
struct EddyThreshold {
  double amplitude = 0.2;
  double spacing_below_m = 60.0e3, spacing_above_m = 15.0e3;
};

struct EddySource {
  std::shared_ptr<const Raster> field;
  EddyQuantity quantity = EddyQuantity::kinetic_energy;
  std::variant<EddyLinear, EddyThreshold> form;
  double fill_amplitude = 0.03;  ///< where the field is missing (ice, poles, equator band)
  double smooth_rad = 0.0;       ///< Gaussian sigma applied to the valid values first; 0 = none
  double max_energy = 0.5;       ///< values above are then taken as this (m2/s2, m2, the unit)
};

void fill_eddies(parallel::Executor& exec, const EddySource& source, LatLonField& field);

/// Spacing of one energy (or variance) by the form of the source: the pointwise law of
/// fill_eddies; NaN means missing.
double eddy_spacing_m(const EddySource& source, double energy);

}  // namespace delos
