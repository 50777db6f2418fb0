// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What of a mesh a remesh changes, decided from the spacing it was made for and the one wanted now.
#include <cstdint>
#include <vector>

#include "core/parallel.hpp"
#include "sizing/spacing.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

struct RegionOptions {
  /// tau: a vertex is wanted where old over new spacing is outside [1 / tau, tau]. Relaxed meshes
  /// keep sides above 0.80 h: at 1.2 kept ones are above 0.65 of the new spacing.
  double tolerance = 1.2;
  /// Rings that are always added to the wanted vertices.
  int rings = 3;
  /// Growth goes on beyond them where old over new spacing is outside [1 / blend, blend]: there
  /// the new mesh would meet the old one with a step...
  double blend = 1.05;
  /// ... for at most so many rings.
  int blend_rings = 12;
  /// In place of that: around the wanted vertices the wanted spacing passes into that of the mesh,
  /// by steps of at most `blend`, in as many rings as `tolerance` needs (`rings` at least), for
  /// spacings that differ everywhere. The mesh is then made for followed_spacing().
  bool passes = false;
  /// Rings around what is removed whose vertices stay but may move.
  int moving_rings = 0;
  /// Regions of fewer wanted vertices are left alone.
  int least_wanted = 12;
};

enum class Change : std::uint8_t {
  keep,   ///< the coordinates stay, bit for bit
  move,   ///< stays, may move
  remove  ///< makes room for new vertices
};

struct Region {
  std::vector<Change> change;  ///< [n_vertices]
  /// [n_vertices] with RegionOptions::passes, else empty: how far the new mesh goes from the
  /// spacing of the old one (0, what is kept) to the wanted (1).
  std::vector<double> share;
  std::vector<char> is_barred;  ///< [n_vertices]: fixed, or next to a fixed one
  std::int64_t n_wanted = 0;    ///< vertices whose spacing is outside the tolerance
  std::int64_t n_removed = 0;
  std::int64_t n_moving = 0;
  std::int64_t n_held = 0;  ///< wanted, but barred
};

/// A mesh whose Vertex::spacing tells what it was made for, and one triangle at each vertex.
struct OldMesh {
  const Mesh& mesh;
  const std::vector<Index>& at_vertex;  ///< of triangle_at_vertex()
};

/// `is_fixed`: [n_vertices], or empty. Neither a fixed vertex nor a neighbour of one changes, so
/// fixed cells stay as they are. The same for any number of threads.
Region find_region(parallel::Executor& exec, const OldMesh& old, const SpacingField& spacing,
                   const RegionOptions& options, const std::vector<char>& is_fixed);

}  // namespace delos
