// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/convert.hpp"

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "domain/stack.hpp"
#include "dual/build.hpp"
#include "dual/digest.hpp"
#include "io/esmf_mesh.hpp"
#include "io/fesom.hpp"
#include "io/gmsh.hpp"
#include "io/jigsaw.hpp"
#include "io/mpas.hpp"
#include "io/names.hpp"
#include "io/scrip.hpp"
#include "io/ugrid.hpp"
#include "io/vtu.hpp"
#include "lifecycle/culled.hpp"
#include "lifecycle/grid_file.hpp"
#include "lifecycle/outputs.hpp"
#include "lifecycle/version.hpp"

namespace delos {
namespace {

namespace fs = std::filesystem;

bool ends_with(const std::string& word, const std::string& ending) {
  return word.size() >= ending.size() &&
         word.compare(word.size() - ending.size(), std::string::npos, ending) == 0;
}

FileKind kind_named(const std::string& to) {
  const std::vector<std::string> names = file_kind_names();
  const auto found = std::find(names.begin(), names.end(), to);
  DELOS_CHECK(found != names.end(), ErrorKind::config, "--to ", to, ": is none of ",
              join_names(names), ".");
  return static_cast<FileKind>(found - names.begin());
}

Provenance provenance_of(Context& context, const Conversion& conversion, const GridFile& file) {
  Provenance out;
  out.version = library_version();
  out.config = file.origin.config;
  for (const InputRecord& input : file.origin.inputs) {
    out.inputs.push_back({input.path, input.sha256});
  }
  out.history = history_now(conversion.command);
  if (!file.origin.history.empty()) out.history += "\n" + file.origin.history;
  if (file.mesh) {
    out.digest = digest(*file.mesh);
  } else if (file.grid) {
    out.digest = digest(context.exec, *file.grid);
  }
  if (file.origin.format == "MPAS") out.parent_id = mpas_parent_id(conversion.from);
  return out;
}

/// What was measured of what the new file holds: of cells with a border perhaps the triangles
/// alone.
void certify(Context& context, const GridFile& file, FileKind kind, Provenance& provenance) {
  const auto measure = [&](const CertifiedMesh& mesh) { return measure_quality(context, mesh); };
  const bool is_open = !file.mesh && kind == FileKind::ugrid_triangles;
  const Quality quality =
      is_open ? measure(CulledMesh(context.exec, *file.grid, CulledMesh::Part::triangles).subject())
              : visit_mesh(context, file, measure);
  provenance.certificate = file_certificate(certificate(quality));
}

/// The C-grid, with the spacing at the edges where the file knows it.
Grid grid_of(Context& context, const GridFile& file) {
  if (file.grid) return *file.grid;
  Grid grid = build_grid(context, file.surface, file.latitude, *file.mesh);
  const bool has_spacing = std::all_of(file.mesh->vertices.begin(), file.mesh->vertices.end(),
                                       [](const Vertex& vertex) { return vertex.spacing > 0.0; });
  if (!has_spacing) grid.cell_spacing_m.clear();
  if (!file.spacing) return grid;
  grid.edge_spacing_m.reserve(grid.vertices_on_edge.size());
  for (const auto& [tri, other] : grid.vertices_on_edge) {  // vertex t belongs to triangle t
    const int side = side_towards(file.mesh->triangle(tri), other);
    grid.edge_spacing_m.push_back(file.surface.scale_m() * file.spacing(tri, side));
  }
  return grid;
}

MpasVertical vertical_of(const GridFile& file) {
  return file.origin.format == "MPAS" ? read_mpas_vertical(file.path) : MpasVertical{};
}

/// Of the sides of triangles_of(grid), each once, from the triangle of lower id.
std::vector<double> spacing_by_triangle(const Grid& grid) {
  std::vector<double> out;
  if (grid.edge_spacing_m.empty()) return out;
  const auto is_triangle = [&](Index vertex) {
    const auto& cells = grid.cells_on_vertex[at(vertex)];
    return std::find(cells.begin(), cells.end(), kNone) == cells.end();
  };
  for (Index vertex = 0; vertex < grid.n_vertices(); ++vertex) {
    if (!is_triangle(vertex)) continue;
    // Side k is opposite corner k, across edge k - 1.
    for (std::size_t k = 0; k < 3; ++k) {
      const Index edge = grid.edges_on_vertex[at(vertex)][(k + 2) % 3];
      const auto& ends = grid.vertices_on_edge[at(edge)];
      const Index beyond = ends[0] == vertex ? ends[1] : ends[0];
      if (beyond < vertex && is_triangle(beyond)) continue;
      out.push_back(grid.edge_spacing_m[at(edge)]);
    }
  }
  return out;
}

/// The same for each side of the mesh; empty when it is not known.
std::vector<double> spacing_by_triangle(const GridFile& file) {
  std::vector<double> out;
  if (!file.spacing) return out;
  for (Index tri = 0; tri < file.mesh->n_triangles(); ++tri) {
    for (int k = 0; k < 3; ++k) {
      if (file.mesh->triangle(tri).neighbour[static_cast<std::size_t>(k)] < tri) continue;
      out.push_back(file.surface.scale_m() * file.spacing(tri, k));
    }
  }
  return out;
}

/// The folder of the three files of FESOM2, removed again when they do not come to be.
void write_into_folder(const std::string& folder, const TriangleSet& set) {
  std::error_code failed;
  const bool is_new = fs::create_directory(folder, failed);
  DELOS_CHECK(!failed, ErrorKind::output, "can't make the folder ", folder, ": ", failed.message(),
              ". Choose another one.");
  try {
    write_fesom(folder, set);
  } catch (...) {
    if (is_new) fs::remove(folder, failed);
    throw;
  }
}

void write_triangles(const std::string& path, FileKind kind, const TriangleSet& set) {
  switch (kind) {
    case FileKind::vtu:
      return write_vtu_triangles(path, set);
    case FileKind::gmsh:
      return write_gmsh(path, set);
    case FileKind::jigsaw:
      return write_jigsaw(path, set);
    default:
      return write_into_folder(path, set);
  }
}

/// What a file of triangles with a border can become: all but cells, which it does not have.
void write_open_triangles(Context& context, const GridFile& file, const Conversion& conversion) {
  const TriangleSet& set = *file.triangles;
  if (conversion.kind == FileKind::ugrid_triangles) {
    Array<Vertex> points(set.position.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3& p = set.position[i];
      points[i] = {p.x(), p.y(), p.z(), 0.0};
    }
    return write_ugrid_triangles(
        conversion.to, mesh_from_triangles(std::move(points), set.corners, Border::allowed),
        {file.surface, file.latitude}, provenance_of(context, conversion, file),
        {netcdf::Format::cdf5, true, &context.exec});
  }
  const bool is_possible = !holds_cells(conversion.kind) || conversion.kind == FileKind::vtu;
  DELOS_CHECK(is_possible, ErrorKind::input, conversion.from,
              ": triangles with a border can't be made into ",
              file_kind_names()[static_cast<std::size_t>(conversion.kind)],
              ", which holds cells: those along the border reach beyond the triangles. Convert a "
              "file of cells (mpas, ugrid_cells, scrip, esmf, vtu), or into ugrid_triangles, vtu, "
              "gmsh, jigsaw or fesom.");
  write_triangles(conversion.to, conversion.kind, set);
}

/// With the layers that the file has: MPAS's own, or those above the depths of a FESOM2 mesh, the
/// lowest one of which ends at the bottom.
void write_mpas_layers(Context& context, const GridFile& file, const Conversion& conversion,
                       const Provenance& provenance) {
  const MpasVertical vertical = vertical_of(file);
  MpasOptions options{netcdf::Format::cdf5, false, &context.exec};
  std::optional<MpasOceanLayers> ocean = vertical.ocean();
  const std::optional<MpasTerrainLayers> terrain = vertical.terrain();
  std::optional<domain::Stack> stack;
  if (!file.depth_m.empty() && !file.level_m.empty()) {
    const domain::Levels levels = domain::listed_levels(file.level_m);
    Array<double> bottom_m(file.depth_m.begin(), file.depth_m.end());
    for (double& depth_m : bottom_m) depth_m = std::min(depth_m, levels.depth_m());
    stack = domain::stack_above(levels, std::move(bottom_m));
    ocean = MpasOceanLayers{
        stack->levels.interface_m, stack->n_layers, stack->bottom_depth_m,
        [&](std::int64_t cell, std::int64_t k) { return stack->thickness_m(cell, k); }};
  }
  if (ocean) options.ocean = &*ocean;
  if (terrain) options.terrain = &*terrain;
  write_mpas(conversion.to, grid_of(context, file), provenance, options);
}

/// The triangles, with depths where they are known and can be written; of a grid with a border
/// those between three cells, and the cells in them.
TriangleSet triangles_for(parallel::Executor& exec, const GridFile& file, FileKind kind) {
  const Mesh open = file.mesh ? Mesh() : triangles_of(exec, *file.grid);
  TriangleSet set = triangle_set(file.surface, file.latitude, file.mesh ? *file.mesh : open);
  set.depth_m = file.depth_m;
  set.level_m = file.level_m;
  if (kind == FileKind::fesom) {
    MpasVertical vertical = vertical_of(file);
    if (!vertical.interface_m.empty()) {
      set.depth_m = std::move(vertical.bottom_depth_m);
      set.level_m = std::move(vertical.interface_m);
    }
  }
  if (!file.mesh) drop_lone_points(set);
  return set;
}

void write_cells_or_mesh(Context& context, const GridFile& file, const Conversion& conversion) {
  const std::string& path = conversion.to;
  Provenance provenance = provenance_of(context, conversion, file);
  if (!holds_cells(conversion.kind) && conversion.kind != FileKind::ugrid_triangles) {
    return write_triangles(path, conversion.kind,
                           triangles_for(context.exec, file, conversion.kind));
  }
  certify(context, file, conversion.kind, provenance);
  if (conversion.kind == FileKind::ugrid_triangles) {
    const std::vector<double> spacing_m =
        file.mesh ? spacing_by_triangle(file) : spacing_by_triangle(*file.grid);
    return write_ugrid_triangles(path,
                                 file.mesh ? *file.mesh : triangles_of(context.exec, *file.grid),
                                 {file.surface, file.latitude, nullptr, spacing_m}, provenance,
                                 {netcdf::Format::cdf5, true, &context.exec});
  }
  if (conversion.kind == FileKind::mpas) {
    return write_mpas_layers(context, file, conversion, provenance);
  }
  const Grid grid = grid_of(context, file);
  switch (conversion.kind) {
    case FileKind::ugrid_cells:
      return write_ugrid_cells(path, grid, provenance, {netcdf::Format::cdf5, true, &context.exec});
    case FileKind::scrip:
      return write_scrip(path, grid, provenance, {netcdf::Format::cdf5, &context.exec});
    case FileKind::esmf:
      return write_esmf_mesh(path, grid, provenance, {netcdf::Format::cdf5, &context.exec});
    default:
      return write_vtu_cells(path, grid);
  }
}

/// What the file has and the kind does not hold, in words.
std::vector<std::string> left_out(parallel::Executor& exec, const GridFile& file, FileKind kind) {
  std::vector<std::string> out;
  const MpasVertical vertical = vertical_of(file);
  const bool has_ocean = vertical.ocean() || !file.depth_m.empty() ||
                         (file.triangles && !file.triangles->depth_m.empty());
  const bool holds_ocean = kind == FileKind::fesom || (kind == FileKind::mpas && !file.triangles) ||
                           (kind == FileKind::vtu && file.triangles);
  if ((has_ocean && !holds_ocean) || (vertical.terrain() && kind != FileKind::mpas)) {
    out.emplace_back("layers");
  }
  if (!file.grid || holds_cells(kind)) return out;
  if (!file.grid->cell_ring.empty()) out.emplace_back("rings");
  if (is_closed(*file.grid)) return out;
  out.emplace_back("the outlines of the cells along the border (no way back to cells)");
  if (kind == FileKind::ugrid_triangles) return out;
  const auto n_lone = file.grid->n_cells() -
                      static_cast<std::int64_t>(triangles_for(exec, file, kind).position.size());
  if (n_lone > 0) out.push_back(text(n_lone, n_lone == 1 ? " cell" : " cells", " of no triangle"));
  return out;
}

}  // namespace

FileKind file_kind_of(const std::string& path, const std::string& to) {
  if (!to.empty()) return kind_named(to);
  std::error_code ignored;
  if (fs::is_directory(path, ignored) || ends_with(path, ".fesom")) return FileKind::fesom;
  for (std::size_t i = 0; i < file_kind_names().size(); ++i) {
    const auto kind = static_cast<FileKind>(i);
    if (ends_with(path, "." + file_ending(kind))) return kind;
  }
  if (ends_with(path, ".msh")) return FileKind::gmsh;
  throw Error(ErrorKind::config,
              text(path, ": the ending does not say what kind of file this is to be. Give --to ",
                   join_names(file_kind_names()), "."));
}

std::vector<std::string> convert_grid_file(Context& context, const Conversion& conversion) {
  const GridFile file = read_grid_file(context, conversion.from);
  const Phase phase(context.monitor, "write", 1);
  if (file.triangles) {
    write_open_triangles(context, file, conversion);
  } else {
    write_cells_or_mesh(context, file, conversion);
  }
  return left_out(context.exec, file, conversion.kind);
}

}  // namespace delos
