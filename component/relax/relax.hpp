// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Relaxation: springs, then repair and polish of the worst triangles.
#include <cstdint>
#include <vector>

#include "core/progress.hpp"
#include "relax/target.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

struct RelaxOptions {
  /// Rounds of spring relaxation (Engwirda 2015, Eq. 2).
  int spring_rounds = 10;
  /// Rounds that move each vertex to the centroid of its Voronoi cell (see relax/centroidal.hpp);
  /// polish then aims at 0.88 at most, which is what keeps triangles acute, so that few leave it.
  int centroidal_rounds = 0;
  /// Rounds of polish at most; they stop when every triangle meets the target or all means have
  /// failed.
  int polish_rounds = 100;
  /// Score that polish brings every triangle to where it can: area-length quality, sides between
  /// 0.80 h and 1.26 h and stagger below 0.09 at 0.94 (see relax/score.hpp).
  double target_quality = 0.94;
  /// Whether polish may remove and insert vertices.
  bool repair = true;
};

struct RelaxReport {
  int spring_rounds = 0;
  int centroidal_rounds = 0;
  int polish_rounds = 0;
  std::int64_t n_flips = 0;
  std::int64_t n_removed = 0;
  std::int64_t n_inserted = 0;
  /// Triangles that polish left below the target, or 0.01 below it where the spacing is so rough
  /// that it aims no higher.
  std::int64_t n_below_target = 0;
};

/// Improves the mesh in place; it stays a valid Delaunay triangulation of the surface. The same
/// bits for any number of threads.
RelaxReport relax(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
                  const RelaxOptions& options, Mesh& mesh);

/// The part of a mesh that a local relaxation may move.
struct RelaxPart {
  std::vector<char> is_free;     ///< [n_vertices]
  std::vector<Index> triangles;  ///< of triangles_of_free()
  std::vector<Index> at_vertex;  ///< one triangle at each vertex
};

/// Triangles that have a free corner, ascending; is_free: [n_vertices].
std::vector<Index> triangles_of_free(parallel::Executor& exec, const Mesh& mesh,
                                     const std::vector<char>& is_free);

/// The same for a part: all other vertices keep their coordinates and spacing bit for bit, and stay
/// in their order where free ones come and go; of `part`, is_free and triangles are kept up to date
/// and the rest used up.
/// Only triangles with a free corner count. A few of them may be left below the target because of
/// vertices that may not move.
RelaxReport relax_part(Context& context, const Target& target, const RelaxOptions& options,
                       RelaxPart& part, Mesh& mesh);

}  // namespace delos
