// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The section `region`: the part of the surface that a limited-area model wants, with its rings.
#include <optional>
#include <string>

#include "domain/limited_area.hpp"
#include "lifecycle/file_request.hpp"
#include "sizing/region.hpp"

namespace delos {

class MapReader;

struct RegionSettings {
  std::optional<RegionShape> shape;  ///< none: the polygons of a file
  FileRequest polygons;
  std::string feature;  ///< to take of them; empty: all
  domain::RingWidths rings;
  double growth = 0.0;  ///< of the spacing per distance outside
  bool align = true;    ///< the grid keeps the outline as edges
};

/// Nothing without the section. Error(config) as all settings. `radius_m` makes angles of lengths.
std::optional<RegionSettings> read_region(MapReader& root, double radius_m);

}  // namespace delos
