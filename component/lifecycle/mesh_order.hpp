// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// In which order the cells of a grid of the whole surface stand in memory.
#include "core/progress.hpp"
#include "lifecycle/settings.hpp"
#include "metrics/report.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// Phase "order", where settings.output asks for one: numbers the vertices of a closed mesh along a
/// Hilbert curve or by METIS's parts, and its triangles by their lowest vertex; nothing moves.
/// Section "order" of the report: the mean difference of the ids of neighbours, before and after.
/// The mesh has no fixed vertices. Error(config) as domain::order_cells(). The same bits for any
/// number of threads.
void order_mesh(Context& context, const Settings& settings, Mesh& mesh, Report& report);

}  // namespace delos
