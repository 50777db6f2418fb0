// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/solution.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "sizing/nodes.hpp"

namespace delos {
namespace {

double amplitude_of(EddyQuantity quantity, double energy) {
  if (quantity == EddyQuantity::amplitude) return energy;
  return std::sqrt(quantity == EddyQuantity::kinetic_energy ? 2.0 * energy : energy);
}

double energy_of(EddyQuantity quantity, double amplitude) {
  if (quantity == EddyQuantity::amplitude) return amplitude;
  return amplitude * amplitude * (quantity == EddyQuantity::kinetic_energy ? 0.5 : 1.0);
}

double spacing_of(const EddyLinear& form, double amplitude) {
  const double t =
      (amplitude - form.quiet_amplitude) / (form.energetic_amplitude - form.quiet_amplitude);
  return form.quiet_spacing_m +
         std::clamp(t, 0.0, 1.0) * (form.energetic_spacing_m - form.quiet_spacing_m);
}

double spacing_of(const EddyThreshold& form, double amplitude) {
  return amplitude < form.amplitude ? form.spacing_below_m : form.spacing_above_m;
}

void check_spacing(double h) {
  DELOS_CHECK(std::isfinite(h) && h > 0.0, ErrorKind::config, "eddy spacing is ", h,
              " m: it must be finite and > 0");
}

void check_form(const EddyLinear& form) {
  check_spacing(form.quiet_spacing_m);
  check_spacing(form.energetic_spacing_m);
  DELOS_CHECK(form.quiet_amplitude >= 0.0 && form.energetic_amplitude > form.quiet_amplitude,
              ErrorKind::config, "eddy amplitudes are ", form.quiet_amplitude, " (quiet) and ",
              form.energetic_amplitude, " (energetic): 0 <= quiet < energetic is needed");
}

void check_form(const EddyThreshold& form) {
  check_spacing(form.spacing_below_m);
  check_spacing(form.spacing_above_m);
  DELOS_CHECK(form.amplitude > 0.0, ErrorKind::config, "eddy threshold is ", form.amplitude,
              ": it must be > 0");
}

}  // namespace

double eddy_spacing_m(const EddySource& source, double energy) {
  const double filled =
      std::isnan(energy) ? energy_of(source.quantity, source.fill_amplitude) : energy;
  const double amplitude =
      amplitude_of(source.quantity, std::clamp(filled, 0.0, source.max_energy));
  return std::visit([&](const auto& form) { return spacing_of(form, amplitude); }, source.form);
}

void fill_eddies(parallel::Executor& exec, const EddySource& source, LatLonField& field) {
  std::visit([](const auto& form) { check_form(form); }, source.form);
  DELOS_CHECK(source.field != nullptr, ErrorKind::config, "eddy source has no field");
  DELOS_CHECK(source.max_energy > 0.0 && source.fill_amplitude >= 0.0, ErrorKind::config,
              "eddy energies are clamped at ", source.max_energy, " and filled by amplitude ",
              source.fill_amplitude, ": the clamp must be > 0, the fill >= 0");
  sample(exec, *source.field, field);
  // What is missing takes no part in the mean: the quiet fill must not calm its neighbours.
  smooth(exec, source.smooth_rad, field);
  for_rows(exec, field, [&](Index, double* values) {
    for (Index i = 0; i < field.n_lon; ++i) values[i] = eddy_spacing_m(source, values[i]);
  });
}

}  // namespace delos
