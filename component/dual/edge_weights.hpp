// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Weights of the tangential velocity on C-grids (TRiSK).
#include "core/parallel.hpp"
#include "dual/grid.hpp"

namespace delos::dual {

/// Fills edges_on_edge and weights_on_edge: the velocity along vertices_on_edge[0] -> [1] is the
/// sum of weight x normal velocity over edges_on_edge.
///   w(e, e') = s n(e') (1/2 - R) dv(e') / dc(e)
/// where R sums kite / cell area from e counter-clockwise to e', n(e') = +1 if the cell is
/// cells_on_edge[e'][0], and s = +1 on the side of cells_on_edge[e][0], else -1.
/// Thuburn, Ringler, Skamarock & Klemp 2009, Eq. 33, doi:10.1016/j.jcp.2009.08.006;
/// Ringler et al. 2010, section 3, doi:10.1016/j.jcp.2009.12.007.
/// Laws: dc(e) w(e, e') / dv(e') is antisymmetric; the divergence of the tangential flux on a
/// triangle is the kite-weighted mean of the divergences on its cells. A missing cell
/// (cells_on_edge[e][1] = kNone) has no share in a row.
void weigh_edges(parallel::Executor& exec, Grid& grid);

}  // namespace delos::dual
