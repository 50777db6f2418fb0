// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Polish: rounds of patches around the triangles below the target, until there are none.
#include "relax/relax.hpp"
#include "relax/target.hpp"

namespace delos {

struct PolishReport {
  int rounds = 0;
  std::int64_t n_flips = 0;
  std::int64_t n_removed = 0;
  std::int64_t n_inserted = 0;
  std::int64_t n_below_target = 0;  ///< see RelaxReport
};

/// Each round picks bad triangles in ascending order, gives each a patch unless a patch of this
/// round already holds a vertex of it, mends the patches in parallel and commits them in order. A
/// triangle whose patch gained nothing gets stronger means the next time: vertices may come and
/// go, then more rings; when the strongest have failed it is left, and counted in the report.
/// With a part, only triangles with a free corner are looked at and only free vertices move or go;
/// part->is_free is kept up to date.
PolishReport polish(Context& context, const Target& target, const RelaxOptions& options, Mesh& mesh,
                    RelaxPart* part = nullptr);

}  // namespace delos
