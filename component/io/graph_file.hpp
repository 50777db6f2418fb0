// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which cells are neighbours, for programs that share them out.
#include <string>

#include "dual/grid.hpp"

namespace delos {

/// graph.info for METIS: "nCells nInternalEdges", then the neighbours of each cell, from 1;
/// atomically. Error(output) when it can't be written.
void write_graph_info(const std::string& path, const Grid& grid);

}  // namespace delos
