// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The wanted spacing on its lat-lon table as a CF file.
#include <string>

#include "io/netcdf.hpp"
#include "io/provenance.hpp"
#include "sizing/spacing.hpp"

namespace delos {

/// The lat-lon table of the spacing as a CF variable `spacing`(lat, lon) in metres; longitudes
/// -180 <= lon < 180. Atomic.
void write_spacing(const std::string& path, const LatLonField& spacing_m,
                   const Provenance& provenance, netcdf::Format format = netcdf::Format::cdf5);

}  // namespace delos
