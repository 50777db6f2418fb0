// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A grid file with the numbers that every command shows.
#include <optional>
#include <string>

#include "lifecycle/grid_file.hpp"
#include "metrics/report.hpp"

namespace delos::app {

struct LoadedGrid {
  GridFile file;
  Grid grid;      ///< as the file has it, or built from the file's triangulation
  Report report;  ///< measured anew
};

/// Error(input) for faces with a border, which have no C-grid.
LoadedGrid load_grid(Context& context, const std::string& path);
/// The same; faces with a border (UGRID) are measured, and there is no grid.
LoadedGrid load_grid(Context& context, GridFile file);

}  // namespace delos::app
