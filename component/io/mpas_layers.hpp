// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The vertical in MPAS files.
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

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

/// What a file says of the vertical, read back. The views below refer to it.
struct MpasVertical {
  std::vector<double> interface_m;     ///< [n_levels + 1] of an ocean; empty: none
  std::vector<Index> n_layers;         ///< [n_cells]
  std::vector<double> bottom_depth_m;  ///< [n_cells]
  std::vector<double> thickness_m;     ///< [n_cells, n_levels] at rest
  std::vector<double> ground_m;        ///< [n_cells] of an atmosphere; empty: none
  std::vector<double> height_m;        ///< [n_cells, n_levels + 1]

  std::optional<MpasOceanLayers> ocean() const;
  std::optional<MpasTerrainLayers> terrain() const;
};

/// Layers of an ocean where the file has refBottomDepth, maxLevelCell and restingThickness or
/// layerThickness (without bottomDepth it is their sum), those of an atmosphere where it has zgrid;
/// nothing where it has neither. Error(input) naming the variable that does not fit the others.
MpasVertical read_mpas_vertical(const std::string& path);

}  // namespace delos
