// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lines on the map.
#include <string>
#include <vector>

namespace delos {

/// Points joined by the shortest arcs. Longitudes of any turn.
struct LonLatLine {
  std::string name;
  std::vector<double> lon_deg, lat_deg;
};

}  // namespace delos
