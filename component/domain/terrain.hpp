// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Layers of an atmosphere that follow the ground and become level with height.
#include <cstdint>
#include <span>
#include <vector>

#include "core/array.hpp"
#include "core/progress.hpp"
#include "domain/cell_means.hpp"
#include "dual/grid.hpp"

namespace delos::domain {

struct TerrainOptions {
  std::int64_t n_levels = 55;
  double top_m = 30000.0;
  /// Interface k of n lies at top (k / n)^stretching over flat ground: 1 = even, more = thinner
  /// layers below.
  double stretching = 1.5;
  double level_above_m = 30000.0;  ///< from here on interfaces are level; at most top_m
  std::int64_t smoothing_rounds = 2;
};

/// Heights of the interfaces, z = zeta + influence x ground.
struct TerrainLayers {
  std::vector<double> zeta_m;     ///< [n_levels + 1] over flat ground, 0 first
  std::vector<double> influence;  ///< [n_levels + 1] of the ground, 1 first
  Array<double> ground_m;         ///< [n_cells] above sea level, >= 0, smoothed

  std::int64_t n_levels() const { return static_cast<std::int64_t>(zeta_m.size()) - 1; }
  double height_m(std::int64_t cell, std::int64_t k) const {
    return zeta_m[static_cast<std::size_t>(k)] +
           influence[static_cast<std::size_t>(k)] * ground_m[static_cast<std::size_t>(cell)];
  }
};

struct TerrainReport {
  double ground_max_m = 0.0;
  double ground_volume_m3 = 0.0;  ///< above sea level
  /// Least thickness of a layer over that of the same layer over flat ground.
  double thinnest = 1.0;
  double thinnest_layer_m = 0.0;
};

/// Mean height of the land of each cell, over the whole cell: sea counts as 0.
Array<double> ground_of(Context& context, const CellMeans& means);

/// `ground_m` exchanges volume with its neighbours for some rounds, which keeps its sum (to
/// rounding) and adds no peaks. The influence of the ground is cos^6(pi/2 zeta / level_above)
/// (Klemp 2011, doi:10.1175/MWR-D-10-05046.1, whose smoothing with height is left out). The same
/// for any number of threads.
/// Error(config) for options out of range; Error(input) with the height of the ground and what to
/// do when layers would cross.
TerrainLayers build_terrain_layers(Context& context, const Grid& grid, Array<double> ground_m,
                                   const TerrainOptions& options);

/// The layers over ground that build_terrain_layers() smoothed.
TerrainLayers terrain_over(Array<double> ground_m, const TerrainOptions& options);

TerrainReport measure_terrain(Context& context, const Grid& grid, const TerrainLayers& layers);

}  // namespace delos::domain
