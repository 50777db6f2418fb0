// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// METIS, as far as partitions need it.
#include <span>
#include <vector>

#include "dual/grid.hpp"

namespace delos::kway {

/// Whether the library was built with METIS.
bool is_available();

/// Part of each cell by METIS's multilevel k-way method (Karypis & Kumar 1998,
/// doi:10.1006/jpdc.1997.1404), n_parts >= 2; parts may be empty when they would have few cells.
/// `weight` as in PartitionOptions, checked. Error(config) without METIS, Error(resource) for more
/// neighbours than METIS's integers count or too little memory.
std::vector<Index> partition(const Grid& grid, Index n_parts, std::span<const double> weight);

}  // namespace delos::kway
