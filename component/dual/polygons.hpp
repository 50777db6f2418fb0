// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The C-grid of Voronoi cells that a file has as polygons, with a border where they end.
#include "core/parallel.hpp"
#include "dual/grid.hpp"

namespace delos {

/// Voronoi cells by their centres and corners: points of the surface, scaled.
struct CellPolygons {
  Ellipsoid surface;
  LatitudeKind latitude = LatitudeKind::geodetic;
  Array<Vec3> centre;             ///< [n_cells]
  Array<Vec3> corner;             ///< [n_vertices]
  Ragged<Index> corners_on_cell;  ///< [n_cells, ...] from 0, counter-clockwise seen from outside
};

/// The grid of these cells. Cells, vertices and the order of a cell's vertices stay as they are;
/// edges are numbered by (lower cell, order around it) as those of a culled grid, and row j of a
/// cell joins its corners j - 1 and j. What a border needs of the cell beyond it (length, place and
/// angle of an edge) comes from where that cell's centre must have been: as far from both ends of
/// the edge as the cell's own, on the other side. So the polygons of a culled grid give back all
/// its tables and measures, to rounding; cell_spacing_m, edge_spacing_m and cell_ring stay empty.
/// Error(input), with ids from 1, where an edge has more than two cells or two of one side (a cell
/// is clockwise), where more than three edges meet, and for a corner of no cell. Takes n log n on
/// one thread for the tables; the same bits for any number of threads.
Grid grid_of_polygons(parallel::Executor& exec, const CellPolygons& cells);

}  // namespace delos
