// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The layers that the settings ask for, of a finished grid.
#include <optional>
#include <span>
#include <vector>

#include "core/progress.hpp"
#include "domain/stack.hpp"
#include "domain/terrain.hpp"
#include "dual/grid.hpp"
#include "lifecycle/settings.hpp"
#include "metrics/report.hpp"
#include "sizing/raster.hpp"

namespace delos {

/// One of the two.
struct Layers {
  std::optional<domain::Stack> ocean;
  std::optional<domain::TerrainLayers> terrain;
};

/// What layers are made of.
struct LayerSources {
  const Grid& grid;
  const Raster& elevation_m;
  bool is_sea_only;  ///< every cell is sea, else those with the wet share that the settings want
};

/// Phase "layers": from the elevation's means over the cells; section "layers" of the report.
/// The settings must have layers. Errors of shape_bathymetry, build_stack, build_terrain_layers.
Layers make_layers(Context& context, const Settings& settings, const LayerSources& sources,
                   Report& report);

/// What must be kept to make them again: depth of the bottom (0: land), or height of the ground, of
/// each cell.
std::span<const double> saved_heights(const Layers& layers);
/// The same layers again.
Layers restored_layers(const LayerSettings& settings, std::span<const double> saved);

/// Work of each cell in a model: its layers; empty where all cells have the same.
std::vector<double> cell_weights(const std::optional<Layers>& layers);

}  // namespace delos
