// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The triangulation of a grid with a border, and how good what is left of it is.
#include <vector>

#include "core/progress.hpp"
#include "dual/grid.hpp"
#include "lifecycle/grid_file.hpp"
#include "metrics/quality.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// The triangles between three cells of a culled grid as a mesh with a border (neighbour kNone);
/// vertex i is cell i, which may belong to no triangle.
Mesh triangles_of(parallel::Executor& exec, const Grid& grid);

/// A grid with a border as a mesh to be measured or held against a certificate; refers to the grid.
class CulledMesh {
 public:
  enum class Part {
    cells,     ///< triangle t is vertex t of the grid, as MeshBorder has it
    triangles  ///< of triangles_of(), without polygons: what files of triangles hold
  };
  CulledMesh(parallel::Executor& exec, const Grid& grid, Part part = Part::cells);
  CulledMesh(const CulledMesh&) = delete;
  CulledMesh& operator=(const CulledMesh&) = delete;
  /// Valid as long as this is.
  CertifiedMesh subject() const {
    return {grid_.surface, spacing_, mesh_, grid_.latitude, &border_};
  }

 private:
  const Grid& grid_;
  std::vector<Index> vertex_;  // [n_triangles] the grid's; empty: all
  Mesh mesh_;
  SideSpacing spacing_;  // null where the grid has no edge_spacing_m
  MeshBorder border_;
};

/// What a culled grid has, with its own ids. Error(input) for too few cells.
Quality measure_culled(Context& context, const Grid& grid);

/// visit(CertifiedMesh) with what a file has to be measured: its mesh, else its cells or triangles
/// with a border. The file must have one of
/// them.
template <class Visit>
auto visit_mesh(Context& context, const GridFile& file, const Visit& visit) {
  if (file.mesh) {
    return visit(CertifiedMesh{file.surface, file.spacing, *file.mesh, file.latitude});
  }
  if (file.grid) return visit(CulledMesh(context.exec, *file.grid).subject());
  const MeshBorder border;
  return visit(CertifiedMesh{file.surface, file.spacing, *file.open_mesh, file.latitude, &border});
}

}  // namespace delos
