// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What became of the lines that a grid was to keep, and what they cost it.
#include <cstdint>
#include <vector>

#include "core/parallel.hpp"
#include "geometry/ellipsoid.hpp"
#include "sizing/spacing.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

struct KeptLines {
  std::int64_t n_vertices = 0;    ///< fixed
  std::int64_t n_edges = 0;       ///< fixed
  std::int64_t n_edges_kept = 0;  ///< of those, sides of triangles
  /// A triangle with a fixed corner that misses the certificate: its angles or sides are what the
  /// lines force.
  struct Missed {
    Vec3 place;      ///< its middle, scaled
    bool is_obtuse;  ///< not acute
    bool is_short;   ///< a side below kRelativeEdgeBound of the spacing in its middle
  };
  std::vector<Missed> missed;  ///< in the order of the triangles
};

KeptLines measure_lines(parallel::Executor& exec, const SpacingField& spacing, const Mesh& mesh);

}  // namespace delos
