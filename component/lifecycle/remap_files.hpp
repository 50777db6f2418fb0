// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Fields and weights between the cells of two grid files: `delos remap`.
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "remap/transfer.hpp"

namespace delos {

struct FieldRemap {
  std::string from, to;              ///< grid files of any kind; with a border, of cells
  std::string fields, out;           ///< netCDF; both empty: weights alone
  std::string weights;               ///< a file of weights in ESMF's layout; empty: none
  std::string dimension = "nCells";  ///< of the cells in `fields`
  remap::TransferOptions options;    ///< of the fields; weights have no limiter
  std::string command;               ///< for the files' history
};

/// What was done with the variables of the file, in its order.
struct RemapReport {
  std::vector<std::string> carried, copied;
  std::vector<std::string> left_out;  ///< with the reason
  std::int64_t n_unmapped = 0;        ///< cells that no cell of `from` covers: the fill value
};

/// Carries the variables float or double of `fields` that have the cells as one dimension (leading
/// ones such as time and inner ones such as levels stay) and copies the numbers that the other
/// dimensions of these have, e.g. times and depths. A target gets the mean over its valid part, the
/// fill value where less than half of its area has values. `out` has the target's latCell, lonCell
/// and areaCell, too, and comes as netCDF CDF-5. All files appear, or none. Error(input) for files
/// that do not fit, Error(output), Error(config) when there is nothing to do. Phases: read,
/// transfer, write.
RemapReport remap_files(Context& context, const FieldRemap& task);

}  // namespace delos
