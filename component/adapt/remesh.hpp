// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A mesh made to fit another spacing, changed only where the two differ.
#include <string>
#include <vector>

#include "adapt/region.hpp"
#include "core/progress.hpp"
#include "refine/refine.hpp"
#include "relax/relax.hpp"

namespace delos {

struct RemeshOptions {
  RegionOptions region;
  RefineOptions refine;
  RelaxOptions relax;
  /// Above this share of the vertices to be removed, everything is made anew: that then costs less.
  double full_share = 0.5;
  /// Times that more vertices are set free around triangles that miss the certificate.
  int release_rounds = 3;
};

/// What a remesh starts from.
struct RemeshInput {
  const Ellipsoid& surface;
  const SpacingField& spacing;  ///< wanted now
  const Mesh& mesh;             ///< Vertex::spacing: what it was made for
  /// [n_vertices] or empty: vertices whose cells must stay as they are.
  const std::vector<char>& is_fixed;
};

enum class RemeshKind { nothing, local, full };
/// "nothing", "local" or "full".
const char* to_string(RemeshKind kind);

/// What a remesh is about to do.
struct RemeshPlan {
  std::vector<Index> at_vertex;  ///< one triangle at each vertex of the old mesh
  Region region;
  RemeshKind kind = RemeshKind::nothing;
  std::string reason;  ///< for that kind, a sentence
};

struct RemeshReport {
  RemeshKind kind = RemeshKind::nothing;
  std::string reason;          ///< for that kind, a sentence
  std::int64_t n_wanted = 0;   ///< vertices whose spacing is off by more than the tolerance
  std::int64_t n_held = 0;     ///< of those, held by fixed ones
  std::int64_t n_regions = 0;  ///< holes that were filled anew
  std::int64_t n_kept = 0;     ///< vertices with the same coordinates, bit for bit
  std::int64_t n_moved = 0;    ///< that stayed but may have moved
  std::int64_t n_removed = 0;
  std::int64_t n_inserted = 0;
  double changed_area = 0.0;  ///< share of the surface in triangles with a vertex that is not kept
  int release_rounds = 0;     ///< times that more vertices were set free
  std::int64_t n_obtuse = 0;  ///< triangles with a vertex that is not kept: not acute,
  std::int64_t n_short = 0;   ///< or with a side below 0.65 of the wanted spacing
  RelaxReport relax;          ///< of the first relaxation
};

struct Remeshed {
  Mesh mesh;
  /// [n_vertices of the old mesh]: the id of the vertex with the same coordinates, bit for bit, or
  /// kNone. Ascending: kept vertices stay in their order.
  std::vector<Index> new_id;
};

/// Decides what of the mesh changes. An `is_fixed` that is not empty excludes a full rebuild;
/// lines to keep (options.refine.lines) ask for one, Error(config) with both.
RemeshPlan plan_remesh(Context& context, const RemeshInput& input, const RemeshOptions& options);

/// Does it. The spacing may by now be another than the one of the plan, as long as the two agree
/// where the plan keeps the mesh. The old mesh is left alone: an error or a request to stop costs
/// nothing. The result is sound and Delaunay, the same bits for any number of threads; time goes
/// with what changes, but for a few passes over all vertices.
Remeshed remesh(Context& context, const RemeshInput& input, const RemeshOptions& options,
                const RemeshPlan& plan, RemeshReport& report);
/// Both.
Remeshed remesh(Context& context, const RemeshInput& input, const RemeshOptions& options,
                RemeshReport& report);

}  // namespace delos
