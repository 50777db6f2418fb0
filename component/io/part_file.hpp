// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Partitions in the layout of METIS's programs, as MPAS models read them.
#include <cstdint>
#include <span>
#include <string>

#include "core/types.hpp"

namespace delos {

/// NAME.graph.info.part.N, the name that models look for; without "NAME.".
std::string part_file_ending(std::int64_t n_parts);

/// The part of each cell, base 0, one a line, in the order of the cells (METIS 5.1 manual, section
/// 4.2.2). Through an AtomicFile; Error(output) when it can't be written.
void write_parts(const std::string& path, std::span<const Index> part_of_cell);

}  // namespace delos
