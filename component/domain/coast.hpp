// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How well the border of an ocean follows its coast.
#include "domain/mask.hpp"
#include "dual/grid.hpp"

namespace delos::domain {

/// A corner of the coast: the angle on the side of the sea, and where.
struct Corner {
  double angle_deg = 180.0;
  LonLat where{};
};

/// The coast of a grid is the chain of edges between sea cells and others, closed loops with the
/// sea on the left. Its line is the coast of the data as the cells see it: where the wet share,
/// linear between the centres of neighbouring cells, passes the share that makes a cell sea.
struct CoastReport {
  std::int64_t n_edges = 0;
  double length_m = 0.0;  ///< of the edges
  double line_m = 0.0;  ///< of the line: on a straight coast a grid of hexagons needs 1.15 to 1.33
                        ///< times as much
  /// How far the edges lie from the coast of the data on average: what is dry of the sea cells
  /// along the coast and wet of the cells across it, over the length.
  double offset_m = 0.0;
  double mean_turn_deg = 0.0;  ///< from one edge to the next; 60 on hexagons, 0 where it is smooth
  /// How high the steps are: mean distance of a corner from the chord between the two beside it.
  /// On regular hexagons half a side, 0.29 of the spacing.
  double step_m = 0.0;
  /// Share of the corners that turn against both their neighbours. Each corner turns by an angle of
  /// a triangle, hence no coast is without; a straight one has 1 along a row of cells, where its
  /// length is least, 0 across rows, and 2 sqrt(3) - 3 = 0.46 over all directions.
  double stair_share = 0.0;
  /// Where corners in succession turn the same way by more than 150 degrees: tips of the sea, and
  /// of the land, one cell wide.
  std::int64_t n_sea_tips = 0, n_land_tips = 0;
  Corner sharpest_sea, sharpest_land;  ///< the least and the largest angle of all corners
};

/// `grid` is closed, `sea` the cells that are kept of it, `wet_fraction` one value a cell. All zero
/// without a coast. The same bits for any number of threads.
CoastReport measure_coast(parallel::Executor& exec, const Grid& grid, const Mask& sea,
                          const Array<double>& wet_fraction, double least_wet);

}  // namespace delos::domain
