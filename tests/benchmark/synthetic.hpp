// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Fields that look like the ocean's, made from formulas, so that no data are needed. The same bits
// on every machine.
#include <string>

namespace delos::benchmark {

/// Twice a zonally averaged first baroclinic Rossby radius as keys of a `latitude_profile`:
/// "latitude: [...], spacing: [...], interpolation: cubic", every 2.5 degrees.
std::string rossby_profile();

/// A netCDF file with `eke` (m2 s-2) on a grid of 0.25 degrees: western boundary currents, a
/// circumpolar band and equatorial jets, broken into eddies of some 300 km; missing near the
/// equator and beyond 72 degrees, as altimeters leave it.
void write_eddies(const std::string& path);

}  // namespace delos::benchmark
