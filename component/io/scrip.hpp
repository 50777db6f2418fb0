// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// SCRIP grid files, which CDO, ESMF, NCO and TempestRemap read: each cell with its corners.
#include <string>

#include "core/parallel.hpp"
#include "dual/grid.hpp"
#include "io/face_mesh.hpp"
#include "io/provenance.hpp"

namespace delos {

struct ScripOptions {
  netcdf::Format format = netcdf::Format::cdf5;
  /// Converts while the file is written; null: all on the calling thread.
  parallel::Executor* exec = nullptr;
};

/// The Voronoi cells. Degrees; corners counter-clockwise, padded by the last one, and the same bits
/// wherever cells share one, since readers merge them by value; areas in square radians, 4 pi in
/// all. A certificate is left out, since the file has no triangles to count. Atomic.
void write_scrip(const std::string& path, const Grid& grid, const Provenance& provenance,
                 const ScripOptions& options = {});

/// Any SCRIP file, in degrees or radians. Corners of the same place become one node, in order of
/// their first use; repeated corners of a cell are dropped. Areas become m2 where the file has
/// `delos_radii_m`, else they are those of the unit sphere. Error(input) naming the cell with fewer
/// than three corners, or what is missing.
FaceMesh read_scrip(const std::string& path);

}  // namespace delos
