// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The files that a configuration names, read into the sizing recipe.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "geometry/lines.hpp"
#include "lifecycle/settings.hpp"
#include "sizing/sources.hpp"

namespace delos {

/// A file that the grid depends on.
struct InputRecord {
  std::string path;
  std::string sha256;
};

struct Inputs {
  SpacingRecipe recipe;                         ///< complete
  std::shared_ptr<const Raster> elevation_m;    ///< of sizing or domain; null: not used
  std::shared_ptr<const PolygonSet> land;       ///< of domain; null: the elevation's
  std::vector<GivenLine> lines;                 ///< of constraints
  std::vector<LonLatLine> passages, blockages;  ///< of domain
  std::vector<InputRecord> files;               ///< each once, in the order of reading
  std::string bathymetry;                       ///< where the elevation came from; empty: not used
  std::vector<std::string> left_out;            ///< names of optional sources without their file
  std::optional<RegionShape> region;            ///< of a regional grid
  std::vector<FixedRegion> fixed;               ///< what no remesh touches, polygons of files too
};

/// Reads what the settings ask for (phase "read"). A relative name is looked for in the
/// configuration's folder, then along `data_path`, then along the environment's DELOS_DATA_PATH
/// (folders separated by ':'). Error(input) with the key that names a missing or unusable file.
Inputs read_inputs(Context& context, const Settings& settings);

}  // namespace delos
