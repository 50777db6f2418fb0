// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From a triangulation to the finished C-grid: Voronoi cells, tables, measures, weights.
#include "core/progress.hpp"
#include "dual/grid.hpp"
#include "geometry/ellipsoid.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// The C-grid of a closed triangulation with at least four vertices: cell i is vertex i of the
/// mesh, grid vertex t its triangle t. Edges are numbered by (lower cell, order around it), the
/// first entry of a cell's lists is its triangle of lowest id.
/// Laws: the kites of a cell sum to its area and those of a triangle to its area, to rounding; cell
/// areas sum to the surface's area within 1e-13; W is antisymmetric (Ringler et al. 2010, Eq. 25)
/// to 1e-12. Where the mesh is not well centred, kites are signed, the sums still hold and no value
/// is NaN. The same bits for any number of threads. Linear in time and memory. Advances the phase
/// that the caller has begun by n_cells in all.
Grid build_grid(Context& context, const Ellipsoid& surface, LatitudeKind latitude,
                const Mesh& mesh);

}  // namespace delos
