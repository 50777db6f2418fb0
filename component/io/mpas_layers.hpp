// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The vertical in MPAS files.
#include <cstdint>
#include <functional>
#include <span>

#include "core/types.hpp"

namespace delos {

/// Layers of MPAS-Ocean: levels from the surface down, of which each cell has the first n_layers.
/// All in metres, on a unit sphere too. Written as refBottomDepth, refZMid, refInterfaces,
/// vertCoordMovementWeights (1), maxLevelCell (from 1; 0 on land), bottomDepth, restingThickness
/// and layerThickness (at Time 0), thicknesses 0 below the bottom.
struct MpasOceanLayers {
  std::span<const double> interface_m;     ///< [n_levels + 1] positive down, 0 first
  std::span<const Index> n_layers;         ///< [n_cells]
  std::span<const double> bottom_depth_m;  ///< [n_cells]
  std::function<double(std::int64_t cell, std::int64_t level)> thickness_m;
};

/// Interfaces of MPAS-Atmosphere: zgrid [nCells, nVertLevelsP1] and the ground below, ter [nCells].
struct MpasTerrainLayers {
  std::int64_t n_levels = 0;
  std::span<const double> ground_m;  ///< [n_cells]
  std::function<double(std::int64_t cell, std::int64_t interface)> height_m;
};

}  // namespace delos
