// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The `sizing` and `bathymetry` sections.
#include "lifecycle/settings.hpp"
#include "lifecycle/settings_reader.hpp"

namespace delos {

/// `radius_m` turns lengths along the surface into angles.
SizingSettings read_sizing(MapReader& root, double radius_m, LatitudeKind latitude);

/// The section `bathymetry`, where read_sizing() did not need it.
void add_bathymetry(MapReader& root, SizingSettings& out);

/// What turns eddies into spacing: form, quiet, energetic, threshold, spacing_below, spacing_above,
/// clamp, smooth, and fill_speed, fill_height or fill; the source has no field yet.
EddySource read_eddy_law(MapReader& keys, EddyQuantity quantity, double radius_m);

/// An angle, or a length along a great circle of that radius, in radians.
double read_arc(MapReader& reader, const std::string& key, double radius_m,
                const char* fallback = nullptr);

}  // namespace delos
