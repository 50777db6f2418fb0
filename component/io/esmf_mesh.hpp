// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// ESMF unstructured mesh files: polygons over nodes, for ESMF_MeshCreate and ESMF_RegridWeightGen.
#include <string>

#include "core/parallel.hpp"
#include "dual/grid.hpp"
#include "io/face_mesh.hpp"
#include "io/provenance.hpp"

namespace delos {

struct EsmfMeshOptions {
  netcdf::Format format = netcdf::Format::cdf5;
  /// Converts while the file is written; null: all on the calling thread.
  parallel::Executor* exec = nullptr;
};

/// The Voronoi cells as elements, counter-clockwise (ESMF refuses the other way), ids from 1 in
/// 32 bits, degrees; with centres, masks and areas (square radians, 4 pi in all). A certificate is
/// left out. Atomic.
void write_esmf_mesh(const std::string& path, const Grid& grid, const Provenance& provenance,
                     const EsmfMeshOptions& options = {});

/// Any such file with coordDim = 2, start_index 0 or 1, degrees or radians. Areas as read_scrip.
/// Error(input) with variable and element for ids that are not there.
FaceMesh read_esmf_mesh(const std::string& path);

}  // namespace delos
