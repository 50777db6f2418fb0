// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The recipe of this layer: from a grid of the whole surface to that of its ocean.
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "domain/coast.hpp"
#include "domain/cull.hpp"
#include "domain/mask.hpp"
#include "domain/order.hpp"
#include "geometry/lines.hpp"
#include "sizing/raster.hpp"

namespace delos::domain {

enum class BodyRule {
  largest,  ///< the body of the largest area
  all,      ///< every body
  named     ///< those that hold the points of OceanOptions::body_points
};

struct OceanOptions {
  double least_wet = 0.5;  ///< of a sea cell's area
  double sea_level_m = 0.0;
  double tip_margin = 0.0;  ///< of clear_tips(), which lines overrule; 0: tips stay
  /// Kept open, whatever the mask says. Around the cells of a blockage where few cells of sea lead
  /// around, else through; then the cells on the other side of the blockage's line are shut.
  std::vector<LonLatLine> passages;
  std::vector<LonLatLine> blockages;  ///< kept shut, whatever the mask says
  PruneOptions prune;                 ///< the cells of passages stay
  BodyRule bodies = BodyRule::largest;
  std::vector<LonLat> body_points;
  CellOrder order = CellOrder::hilbert;
  std::int64_t n_parts = 0;  ///< of CellOrder::metis
};

/// What became of a passage or blockage.
struct LineReport {
  std::string name;
  std::int64_t n_cells = 0;    ///< that it runs through
  std::int64_t n_changed = 0;  ///< opened or shut, where the mask had it otherwise
  /// Of a blockage: cells that stay sea since a passage runs through them.
  std::int64_t n_shared = 0;
  /// A passage: all its cells are in the ocean. A blockage: no two neighbouring cells of the ocean
  /// have their centres on either side of it.
  bool holds = false;
};

struct OceanReport {
  std::int64_t n_cells = 0, n_edges = 0, n_border_edges = 0, n_vertices = 0;
  double area_m2 = 0.0;
  std::int64_t n_bodies = 0, n_bodies_kept = 0;
  std::int64_t n_cells_of_other_bodies = 0;
  std::int64_t n_tips_cleared = 0;
  PruneReport pruned;
  std::int64_t n_cells_given_back = 0;  ///< of those, since a passage needs them
  std::vector<LineReport> passages, blockages;
  CoastReport coast;
};

struct Ocean {
  Culled culled;
  OceanReport report;
};

/// Steps in this order: wet cells, tips, blockages, passages, pruning, bodies, order, culling.
/// `wet_fraction` is one value a cell of `grid`, which is closed. Error(input) when no cell is sea,
/// or a point names no body.
Ocean select_ocean(parallel::Executor& exec, const Grid& grid, const Array<double>& wet_fraction,
                   const OceanOptions& options);

/// Land polygons as an elevation for mean_over_cells: 1 m inside, -1 m outside, on a table with
/// nodes `resolution_rad` apart at most. Error(input) for a set without polygons.
LatLonField elevation_of(parallel::Executor& exec, const PolygonSet& land, double resolution_rad);

}  // namespace delos::domain
