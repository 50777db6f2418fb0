// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The `sizing` and `bathymetry` sections.
#include "lifecycle/settings.hpp"
#include "lifecycle/settings_reader.hpp"

namespace delos {

/// `radius_m` turns lengths along the surface into angles.
SizingSettings read_sizing(MapReader& root, double radius_m, LatitudeKind latitude);

/// An angle, or a length along a great circle of that radius, in radians.
double read_arc(MapReader& reader, const std::string& key, double radius_m,
                const char* fallback = nullptr);

}  // namespace delos
