// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Cells that follow the coast.
#include "core/progress.hpp"
#include "geometry/ellipsoid.hpp"
#include "sizing/spacing.hpp"
#include "triangulation/mesh.hpp"

namespace delos::domain {

/// The sea to fit to: elevations on a table, the level below which they are wet, and what makes a
/// cell sea: its wet share, or that of clear_tips().
struct SeaToFit {
  const LatLonField& elevation_m;
  double sea_level_m = 0.0;
  double least_wet = 0.5;
  double tip_margin = 0.0;  ///< of clear_tips()
};

struct FitOptions {
  Ellipsoid surface;
  LatitudeKind latitude = LatitudeKind::geodetic;
  int rounds = 8;
};

struct FitReport {
  std::int64_t n_moved = 0;  ///< vertices
  /// What is dry of the sea cells along the coast and wet of the cells across it.
  double misplaced_before_m2 = 0.0, misplaced_after_m2 = 0.0;
};

/// Moves the vertices on both sides of the coast so that the Voronoi edges between them, which lie
/// midway, come to lie on it, apart from each other to make these edges' steps low, and those next
/// to them so that they have room. Triangles keep their corners: a move is taken as far as every
/// triangle at the vertex keeps its angles within 38 to 82 degrees and its sides within 0.75
/// to 1.35 of the spacing, or what it had. The mesh was Delaunay and well centred and stays so;
/// fixed vertices stay where they are. The spacing at the vertices is that of before. One vertex
/// after the other on one thread, wet shares by all: the same bits for any number of threads.
/// Advances the caller's phase by the cells looked at.
FitReport fit_to_coast(Context& context, const SeaToFit& sea, const FitOptions& options,
                       Mesh& mesh);

}  // namespace delos::domain
