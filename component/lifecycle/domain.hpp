// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From the grid of the whole surface to that of the domain the settings ask for.
#include <span>
#include <vector>

#include "core/progress.hpp"
#include "dual/grid.hpp"
#include "lifecycle/inputs.hpp"
#include "lifecycle/settings.hpp"
#include "metrics/report.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// What a culled grid has of the triangulation that it was made of.
struct DomainIds {
  Array<Index> cells;     ///< [n_cells] the mesh's vertex
  Array<Index> vertices;  ///< [n_vertices] the mesh's triangle
};

/// Phase "fit_coast", where the settings ask for it: moves vertices of the mesh so that cells
/// follow the coast; section "fit_coast" of the report, with a line in the log.
void fit_mesh_to_coast(Context& context, const Settings& settings, const Inputs& inputs, Mesh& mesh,
                       Report& report);

/// Phase "domain": selects the domain and culls the grid to it; section "domain" of the report,
/// with a line in the log, and a warning for every passage or blockage that does not hold. The
/// settings must have a domain.
DomainIds cull_to_domain(Context& context, const Settings& settings, const Inputs& inputs,
                         Grid& grid, Report& report);

/// The same for cells selected before.
DomainIds cull_to_cells(Context& context, std::span<const Index> cells, Grid& grid);

}  // namespace delos
