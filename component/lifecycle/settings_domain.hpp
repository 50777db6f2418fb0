// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The section `domain`: which part of the surface the grid keeps.
#include <optional>
#include <string>
#include <vector>

#include "domain/ocean.hpp"
#include "lifecycle/file_request.hpp"

namespace delos {

class MapReader;

/// Lines in a GeoJSON file.
struct LinesRequest {
  FileRequest file;
  std::string select;               ///< name or tag of the features to take; empty: all
  std::vector<std::string> except;  ///< names or tags of those of them to leave out
};

struct DomainSettings {
  domain::OceanOptions options;  ///< without its lines
  FileRequest land;              ///< polygons in place of the bathymetry; no file: none
  std::string land_feature;      ///< feature to take; empty: all
  LinesRequest passages, blockages;
  bool fits_coast = false;  ///< moves cells along the coast before the dual is built

  bool needs_bathymetry() const { return land.file.empty(); }
};

struct CellOrderSettings {
  domain::CellOrder kind = domain::CellOrder::kept;
  std::int64_t n_parts = 0;  ///< of metis
};

/// The key `order` and, for metis, the number of parts; `standard` is kept or hilbert.
CellOrderSettings read_cell_order(MapReader& keys, const char* parts_key,
                                  domain::CellOrder standard);

/// Nothing without the section. Error(config) as all settings.
std::optional<DomainSettings> read_domain(MapReader& root);

}  // namespace delos
