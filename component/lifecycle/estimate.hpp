// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a grid will cost, said and judged before anything large is allocated.
#include <cstdint>
#include <string>

#include "lifecycle/settings.hpp"

namespace delos {

struct Estimate {
  double n_cells = 0.0;
  double memory_bytes = 0.0;  ///< at the peak of the run
  double disk_bytes = 0.0;    ///< all outputs
};

/// Peak of refine and relax, and of the dual when it is built.
Estimate estimate_cost(const Settings& settings, double n_cells, bool with_dual);

/// "about 164 000 cells, 0.2 GiB memory, 0.1 GiB on disk"
std::string describe(const Estimate& estimate);

/// Error(resource) when the cells pass 32-bit ids or the memory passes what is available.
void check_estimate(const Estimate& estimate, double available_bytes);

/// Error(resource) when the table of spacings of this resolution passes the memory available.
void check_table(double resolution_rad, double available_bytes);

/// Memory that this process may still take: the system's, or what is left of the control group's
/// limit; infinity where the system does not say.
double available_memory_bytes();

/// Error(output) unless files can be made in `directory` (or, where it is not there yet, in the
/// nearest folder above it) and the disk has room for them. Makes nothing that stays.
void check_output_folder(const std::string& directory, double disk_bytes);

}  // namespace delos
