// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Quality of a triangulation and of its dual, straight from the mesh: every number of the report.
// Angles, areas and radii of triangles are those of the flat (chordal) triangles; lengths are
// chords; positions of dual vertices are the centres of the surface Delaunay balls.
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/progress.hpp"
#include "dual/grid.hpp"
#include "geometry/ellipsoid.hpp"
#include "sizing/spacing.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// What a measure is of: a cell (vertex of the triangulation), an edge, a triangle.
enum class Element { cell, edge, triangle };

/// The worst element of one measure, and where it is: a cell itself, the projected middle of an
/// edge or of the corners of a triangle. An edge is named by its two cells, the lower first; for
/// the others, `other` is kNone. Ids from 0.
struct Extreme {
  double value = 0.0;
  Index id = kNone;
  Index other = kNone;
  LonLat where{0.0, 0.0};
  Element element = Element::cell;
};

/// The wanted spacing (scaled) at the projected middle of side k of a triangle.
using SideSpacing = std::function<double(Index tri, int k)>;

/// What a mesh of a part of the surface can't say itself. Triangle t of such a mesh is vertex t of
/// a grid with a border: corners are kNone where their cells are gone, neighbours where a side has
/// not two cells, or no triangle beyond it.
struct MeshBorder {
  /// [n_triangles] the grid's vertices, where dual edges end at triangles that miss corners; may be
  /// empty where none does.
  std::span<const Vec3> centre;
  /// The triangles around every cell, counter-clockwise; null: not known, nor degrees and areas.
  const Ragged<Index>* polygons = nullptr;
};

/// A mesh that came from somewhere.
struct CertifiedMesh {
  const Ellipsoid& surface;
  const SideSpacing& spacing;  ///< null: not known
  const Mesh& mesh;
  LatitudeKind latitude = LatitudeKind::geodetic;
  const MeshBorder* border = nullptr;  ///< null: the mesh is closed
};

/// counts[i] = values in [lower + i w, lower + (i + 1) w), w = (upper - lower) / counts.size(); the
/// first and the last bin also take what lies outside.
struct Histogram {
  double lower = 0.0, upper = 0.0;
  std::vector<std::int64_t> counts;
};

struct Quality {
  // --- counts
  std::int64_t n_vertices = 0, n_triangles = 0, n_edges = 0;
  /// Of a grid with a border, beside those: edges with one cell, and vertices that miss a cell.
  std::int64_t n_border_edges = 0, n_border_vertices = 0;
  std::int64_t euler = 0;           ///< n_vertices - n_edges + n_triangles, 2 when closed
  std::int64_t n_non_delaunay = 0;  ///< sides that the surface Delaunay would flip
  std::int64_t n_degenerate = 0;    ///< triangles of zero area or folded over; 0 when right
  bool knows_spacing = false;       ///< else relative_edge_* and spacing_* mean nothing

  // --- triangles
  Extreme area_length_min;  ///< (4 sqrt(3) / 3) area / mean squared edge; ideal 1
  double area_length_p01 = 0.0, area_length_mean = 0.0;
  Extreme angle_min_deg, angle_max_deg;
  double angle_mad_deg = 0.0;  ///< mean |angle - 60|
  Extreme radius_edge_max;     ///< circumradius / shortest edge; ideal 0.577
  double radius_edge_mean = 0.0;
  double well_centred = 0.0;  ///< fraction of triangles that are acute and face outward
  std::int64_t n_obtuse = 0;  ///< the others (largest angle >= 90 degrees)
  std::int64_t n_right = 0;   ///< largest angle within some 1e-7 degrees of 90: rounding decides
  Extreme grading_max;        ///< area ratio of neighbours; where = the smaller triangle

  // --- edges
  Extreme relative_edge_min, relative_edge_max;  ///< length / spacing at the projected midpoint
  double relative_edge_mean = 0.0, relative_edge_std = 0.0;
  Extreme dual_ratio_min;  ///< signed length of the dual edge / length of the edge; ideal 0.577
  double dual_ratio_mean = 0.0;
  Extreme stagger_max;  ///< distance of the two midpoints / length of the edge; ideal 0
  double stagger_mean = 0.0;
  double edge_length_min_m = 0.0, edge_length_mean_m = 0.0, edge_length_max_m = 0.0;
  double spacing_min_m = 0.0, spacing_max_m = 0.0;  ///< asked for, at the edges' midpoints

  // --- vertices and cells
  double degree_5 = 0.0, degree_6 = 0.0, degree_7 = 0.0, degree_other = 0.0;  ///< fractions
  std::int64_t n_degree_5 = 0, n_degree_6 = 0, n_degree_7 = 0, n_degree_other = 0;
  Extreme degree_min, degree_max;
  Extreme cell_area_min_m2, cell_area_max_m2;  ///< of the Voronoi cells
  double total_area_m2 = 0.0;                  ///< sum of the cell areas
  double total_area_error = 0.0;               ///< relative to a closed surface's area, else 0

  bool has_border() const { return n_border_edges > 0; }

  // --- for pictures
  Histogram area_length;    ///< [0.5, 1], 100 bins
  Histogram angle_deg;      ///< [0, 180], 180 bins
  Histogram relative_edge;  ///< [0, 2], 200 bins
  Histogram degree;         ///< [0, 16], one bin a degree
};

/// Measures a closed mesh of at least four vertices. Never NaN: a degenerate triangle counts in
/// n_degenerate, has quality 0 and an angle of 180 degrees; Error(internal) when the mesh has no
/// triangles, a vertex is no point of the surface, or a spacing is not > 0. Exact percentiles; the
/// same bits for any number of threads. Latitudes of places are of the given kind.
Quality measure_quality(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
                        const Mesh& mesh, LatitudeKind latitude = LatitudeKind::geodetic);

/// The same where no field is at hand (a grid read from a file). Null: the spacing is not known.
Quality measure_quality(Context& context, const Ellipsoid& surface, const SideSpacing& spacing,
                        const Mesh& mesh, LatitudeKind latitude = LatitudeKind::geodetic);

/// The same of what a grid with a border has: triangles between three cells, edges between two,
/// every cell. Dual edges that end at the border count, Delaunay and grading need both triangles.
/// Error(input) when no two triangles lie side by side.
Quality measure_quality(Context& context, const CertifiedMesh& subject);

}  // namespace delos
