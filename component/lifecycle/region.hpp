// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From the grid of the whole surface to that of a region, with the rings around it.
#include "core/progress.hpp"
#include "dual/grid.hpp"
#include "lifecycle/domain.hpp"
#include "lifecycle/settings.hpp"
#include "metrics/report.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

struct RegionSource {
  const Settings& settings;  ///< with a region
  const Inputs& inputs;
  const FixedEdges* outline;  ///< the edges that the region's outline became; null: none
};

/// Gives the grid its rings (cell_ring, kNone beyond them): inside are the cells with their centre
/// in the region or on its outline. Errors of domain::limited_area. A region in parts, or one with
/// fewer cells inside than in its rings, is said in the log.
void mark_region(Context& context, const RegionSource& source, Grid& grid);

/// Phase "domain": culls the grid to the cells with a ring, along a Hilbert curve.
DomainIds cull_to_region(Context& context, Grid& grid);

/// Section "region" of the report, with a line in the log, of the finished grid; `n_made`: cells of
/// the triangulation that it was made of.
void tell_of_region(Context& context, const Settings& settings, const Grid& grid,
                    std::int64_t n_made, Report& report);

}  // namespace delos
