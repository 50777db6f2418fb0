// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/grid_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <tuple>

#include "core/error.hpp"
#include "io/esmf_mesh.hpp"
#include "io/fesom.hpp"
#include "io/gmsh.hpp"
#include "io/jigsaw.hpp"
#include "io/mpas.hpp"
#include "io/netcdf.hpp"
#include "io/provenance.hpp"
#include "io/scrip.hpp"
#include "io/ugrid.hpp"
#include "io/vtu.hpp"
#include "lifecycle/edge_spacing.hpp"
#include "lifecycle/face_grid.hpp"

namespace delos {
namespace {

namespace fs = std::filesystem;

using Corners = std::vector<std::array<Index, 3>>;

bool is_mpas(const netcdf::Reader& file) {
  return file.has_variable("cellsOnVertex") && file.has_variable("verticesOnCell");
}

bool is_scrip(const netcdf::Reader& file) {
  return file.has_variable("grid_center_lat") && file.has_variable("grid_corner_lat");
}

bool is_esmf_mesh(const netcdf::Reader& file) {
  return file.has_variable("nodeCoords") && file.has_variable("elementConn");
}

bool is_ugrid(const netcdf::Reader& file) {
  return std::any_of(file.variables().begin(), file.variables().end(), [&](const auto& variable) {
    return file.text_attribute(variable.name, "cf_role") == "mesh_topology";
  });
}

Extreme recorded(const FileExtreme& extreme) {
  const bool is_edge = extreme.ids[1] != kNone;
  return {extreme.value,
          is_edge ? std::min(extreme.ids[0], extreme.ids[1]) : extreme.ids[0],
          is_edge ? std::max(extreme.ids[0], extreme.ids[1]) : kNone,
          {extreme.lon_lat_deg[0] * kRadPerDeg, extreme.lon_lat_deg[1] * kRadPerDeg},
          is_edge ? Element::edge : Element::triangle};
}

Certificate recorded(const FileCertificate& certificate) {
  Certificate out;
  out.well_centred = certificate.well_centred;
  out.n_obtuse = certificate.n_obtuse;
  out.angle_max_deg = recorded(certificate.angle_max_deg);
  out.dual_ratio_min = recorded(certificate.dual_ratio_min);
  out.stagger_max = recorded(certificate.stagger_max);
  if (certificate.relative_edge_min) {
    out.relative_edge_min = recorded(*certificate.relative_edge_min);
  }
  return out;
}

FileOrigin read_origin(const netcdf::Reader& file, const char* format) {
  const Provenance notes = read_provenance(file);
  FileOrigin out;
  out.format = format;
  out.version = notes.version;
  out.config = notes.config;
  out.digest = notes.digest;
  out.history = notes.history;
  for (const InputFile& input : notes.inputs) out.inputs.push_back({input.path, input.sha256});
  if (notes.certificate) out.certificate = recorded(*notes.certificate);
  return out;
}

void set_position(Vertex& vertex, const Vec3& p) {
  vertex.x = p.x();
  vertex.y = p.y();
  vertex.z = p.z();
}

void read_spacing(GridFile& out, const Mesh& mesh, const FileEdges& edges) {
  if (edges.spacing_m.empty()) return;
  try {
    out.spacing = spacing_by_side(mesh, edges, out.surface.scale_m());
  } catch (const Error& error) {
    throw Error(error.kind(), text(out.path, ": ", error.what()));
  }
}

void read_mpas_into(GridFile& out) {
  out.grid = read_mpas(out.path);
  const Grid& grid = *out.grid;
  out.surface = grid.surface;
  out.latitude = grid.latitude;
  if (!is_closed(grid)) return;
  Array<Vertex> vertices(grid.cell_position.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    set_position(vertices[i], grid.cell_position[i]);
    vertices[i].spacing =
        grid.cell_spacing_m.empty() ? 0.0 : grid.cell_spacing_m[i] / grid.surface.scale_m();
  }
  out.mesh = mesh_from_triangles(std::move(vertices), grid.cells_on_vertex);
  read_spacing(out, *out.mesh, {grid.cells_on_edge, EdgeEnds::vertices, grid.edge_spacing_m});
}

/// Corners of triangular faces.
Corners face_corners(const FaceMesh& faces) {
  Corners corners(static_cast<std::size_t>(faces.nodes_on_face.offsets.n_rows()));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto row = faces.nodes_on_face.row(static_cast<std::int64_t>(i));
    std::copy(row.begin(), row.end(), corners[i].begin());
  }
  return corners;
}

/// The triangles of a Voronoi diagram: the three faces around each node, counter-clockwise.
Corners node_faces(const std::string& path, const FaceMesh& faces, const Array<Vertex>& centres) {
  Corners around(faces.node.size(), {kNone, kNone, kNone});
  for (std::int64_t face = 0; face < faces.nodes_on_face.offsets.n_rows(); ++face) {
    for (const Index node : faces.nodes_on_face.row(face)) {
      auto& row = around[static_cast<std::size_t>(node)];
      const auto slot = std::find(row.begin(), row.end(), kNone);
      DELOS_CHECK(slot != row.end(), ErrorKind::input, path, ": node ", node,
                  " belongs to more than three faces; this is no Voronoi diagram of points in "
                  "general position and can't be checked as one.");
      *slot = static_cast<Index>(face);
    }
  }
  for (auto& row : around) {
    if (row[2] == kNone) continue;  // a border; mesh_from_triangles is not asked then
    const auto at = [&](std::size_t k) {
      return centres[static_cast<std::size_t>(row[k])].position();
    };
    if (at(0).cross(at(1)).dot(at(2)) < 0.0) std::swap(row[1], row[2]);
  }
  return around;
}

Array<Vertex> surface_points(const GridFile& file, const std::vector<LonLat>& lon_lat) {
  Array<Vertex> out(lon_lat.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    set_position(out[i], file.surface.point(lon_lat[i], file.latitude));
    out[i].spacing = 0.0;
  }
  return out;
}

void take_triangles(GridFile& out, TriangleSet set) {
  out.surface = *set.surface;
  out.latitude = set.latitude;
  out.n_turned = orient(set);
  if (!is_closed(set)) {
    out.triangles = std::move(set);
    return;
  }
  Array<Vertex> vertices(set.position.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    set_position(vertices[i], set.position[i]);
    vertices[i].spacing = set.spacing_m.empty() ? 0.0 : set.spacing_m[i] / out.surface.scale_m();
  }
  out.mesh = mesh_from_triangles(std::move(vertices), set.corners);
  out.depth_m = std::move(set.depth_m);
  out.level_m = std::move(set.level_m);
}

/// The triangles of faces or their corners, where these leave a border.
void take_open(GridFile& out, const Array<Vertex>& points, const Corners& corners) {
  TriangleSet set;
  set.surface = out.surface;
  set.latitude = out.latitude;
  for (const Vertex& point : points) set.position.push_back(point.position());
  std::copy_if(corners.begin(), corners.end(), std::back_inserter(set.corners),
               [](const auto& row) { return row[2] != kNone; });
  drop_lone_points(set);
  take_triangles(out, std::move(set));
}

/// Voronoi cells with a border become a C-grid.
void take_cells(parallel::Executor& exec, GridFile& out, const FaceMesh& faces,
                const UgridMesh* edges) {
  try {
    FaceGrid made = face_grid(exec, out.surface, faces, edges);
    out.grid = std::move(made.grid);
    out.n_turned = made.n_turned;
  } catch (const Error& error) {
    throw Error(error.kind(), text(out.path, ": ", error.what()));
  }
}

/// Triangles become the mesh, or with a border a set of triangles, other polygons the Voronoi cells
/// of a mesh, or with a border a C-grid; `edges` when the file has the spacing there.
void take_faces(parallel::Executor& exec, GridFile& out, const FaceMesh& faces,
                const UgridMesh* edges = nullptr) {
  if (faces.ellipsoid) out.surface = *faces.ellipsoid;
  out.latitude = faces.latitude;
  const auto n_faces = static_cast<std::size_t>(faces.nodes_on_face.offsets.n_rows());
  bool all_triangles = true;
  for (std::size_t i = 0; i < n_faces && all_triangles; ++i) {
    all_triangles = faces.nodes_on_face.row(static_cast<std::int64_t>(i)).size() == 3;
  }
  if (all_triangles) {
    Array<Vertex> nodes = surface_points(out, faces.node);
    const Corners corners = face_corners(faces);
    const bool has_border = !is_closed(corners);
    if (has_border) take_open(out, nodes, corners);
    if (has_border && edges == nullptr) return;
    std::optional<Mesh>& mesh = has_border ? out.open_mesh : out.mesh;
    mesh = mesh_from_triangles(std::move(nodes), corners,
                               has_border ? Border::allowed : Border::refused);
    if (edges == nullptr) return;
    return read_spacing(out, *mesh,
                        {edges->nodes_on_edge, EdgeEnds::vertices, edges->edge_spacing_m});
  }
  DELOS_CHECK(
      faces.face_centre.size() == n_faces, ErrorKind::input, out.path,
      ": the faces are no triangles and have no centres (face_coordinates in UGRID), so the "
      "points of the Voronoi diagram are not known.");
  Array<Vertex> centres = surface_points(out, faces.face_centre);
  const Corners corners = node_faces(out.path, faces, centres);
  const bool has_border =
      std::any_of(corners.begin(), corners.end(), [](const auto& row) { return row[2] == kNone; });
  if (has_border) return take_cells(exec, out, faces, edges);
  out.mesh = mesh_from_triangles(std::move(centres), corners);
  if (edges == nullptr) return;
  read_spacing(out, *out.mesh, {edges->nodes_on_edge, EdgeEnds::triangles, edges->edge_spacing_m});
}

void read_vtu_into(parallel::Executor& exec, GridFile& out) {
  VtuMesh vtu = read_vtu(out.path);
  if (vtu.centre.empty()) {
    DELOS_CHECK(!vtu.points.corners.empty(), ErrorKind::input, out.path,
                ": the faces are no triangles and have no cell data `centre`.");
    take_triangles(out, std::move(vtu.points));
    return;
  }
  FaceMesh faces;
  faces.ellipsoid = vtu.points.surface;
  faces.latitude = vtu.points.latitude;
  const auto places_of = [&](const Array<Vec3>& points) {
    std::vector<LonLat> places;
    places.reserve(points.size());
    for (const Vec3& p : points) places.push_back(faces.ellipsoid->lon_lat(p, faces.latitude));
    return places;
  };
  faces.node = places_of(vtu.points.position);
  faces.face_centre = places_of(vtu.centre);
  faces.nodes_on_face = std::move(vtu.nodes_on_face);
  faces.face_ring = std::move(vtu.cell_ring);
  take_faces(exec, out, faces);
  if (out.grid) {
    out.grid->cell_spacing_m.assign(vtu.cell_spacing_m.begin(), vtu.cell_spacing_m.end());
  }
  if (!out.mesh || vtu.cell_spacing_m.empty()) return;
  for (std::size_t i = 0; i < vtu.cell_spacing_m.size(); ++i) {
    out.mesh->vertices[i].spacing = vtu.cell_spacing_m[i] / out.surface.scale_m();
  }
}

const char* netcdf_kind(const netcdf::Reader& file) {
  if (is_mpas(file)) return "MPAS";
  if (is_ugrid(file)) return "UGRID";
  if (is_scrip(file)) return "SCRIP";
  return is_esmf_mesh(file) ? "ESMF mesh" : "";
}

void read_netcdf_into(parallel::Executor& exec, GridFile& out) {
  std::string kind;
  {
    const netcdf::Reader file(out.path);
    kind = netcdf_kind(file);
    DELOS_CHECK(!kind.empty(), ErrorKind::input, out.path,
                ": neither MPAS (no cellsOnVertex) nor UGRID (no variable with cf_role = "
                "mesh_topology) nor SCRIP (no grid_corner_lat) nor an ESMF mesh (no elementConn). "
                "Give a grid file.");
    out.origin = read_origin(file, kind.c_str());
  }
  if (kind == "MPAS") return read_mpas_into(out);
  if (kind == "SCRIP") return take_faces(exec, out, read_scrip(out.path));
  if (kind == "ESMF mesh") return take_faces(exec, out, read_esmf_mesh(out.path));
  const UgridMesh ugrid = read_ugrid(out.path);
  take_faces(exec, out, ugrid, &ugrid);
}

/// The first bytes tell the kinds of text files apart; empty: none of them.
std::string text_kind(const std::string& path) {
  if (is_fesom(path)) return "FESOM2";
  constexpr std::size_t kEnough = 4096;  // comments may go first
  std::string head(kEnough, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(kEnough));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  if (head.rfind("$MeshFormat", 0) == 0) return "Gmsh";
  if (head.rfind("<?xml", 0) == 0 || head.rfind("<VTKFile", 0) == 0) return "VTU";
  const bool is_jigsaw =
      head.find("MSHID=") != std::string::npos || head.find("mshid=") != std::string::npos;
  return is_jigsaw ? "JIGSAW" : "";
}

bool is_grid_file(const fs::path& path) {
  const std::string kind = path.extension().string();
  if (kind == ".vtu" || kind == ".msh") return true;
  if (kind == ".out") return is_fesom(path.string());
  return kind == ".nc" && netcdf_kind(netcdf::Reader(path.string()))[0] != '\0';
}

}  // namespace

std::vector<std::string> grid_files(const std::string& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) return {path};
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(path)) {
    if (is_grid_file(entry.path())) out.push_back(entry.path().string());
  }
  std::sort(out.begin(), out.end());
  DELOS_CHECK(!out.empty(), ErrorKind::input, "the folder ", path,
              " has no MPAS, UGRID, SCRIP or ESMF file (*.nc), and no *.vtu, *.msh or "
              "nod2d.out.");
  return out;
}

GridFile read_grid_file(Context& context, const std::string& path) {
  const Phase phase(context.monitor, "read", 0);
  GridFile out;
  out.path = path;
  out.origin.format = text_kind(path);
  const std::string& kind = out.origin.format;
  if (kind == "FESOM2") {
    take_triangles(out, read_fesom(path));
  } else if (kind == "Gmsh") {
    take_triangles(out, read_gmsh(path));
  } else if (kind == "JIGSAW") {
    take_triangles(out, read_jigsaw(path));
  } else if (kind == "VTU") {
    read_vtu_into(context.exec, out);
  } else {
    read_netcdf_into(context.exec, out);
  }
  return out;
}

Mesh mesh_from_triangles(Array<Vertex> vertices, std::span<const std::array<Index, 3>> corners,
                         Border border) {
  struct Side {
    Index low, high, tri, side;
    bool operator<(const Side& other) const {
      return std::tie(low, high, tri) < std::tie(other.low, other.high, other.tri);
    }
  };
  Mesh mesh;
  mesh.vertices = std::move(vertices);
  mesh.triangles.resize(corners.size());
  std::vector<Side> sides;
  sides.reserve(3 * corners.size());
  for (std::size_t tri = 0; tri < corners.size(); ++tri) {
    mesh.triangles[tri] = {corners[tri], {kNone, kNone, kNone}};
    for (int k = 0; k < 3; ++k) {
      const Index a = corners[tri][static_cast<std::size_t>(next_corner(k))];
      const Index b = corners[tri][static_cast<std::size_t>(previous_corner(k))];
      DELOS_CHECK(std::min(a, b) >= 0 && std::max(a, b) < mesh.n_vertices(), ErrorKind::input,
                  "triangle ", tri, " names a vertex that is not there.");
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(tri), k});
    }
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool is_pair = i + 1 < sides.size() && sides[i].low == sides[i + 1].low &&
                         sides[i].high == sides[i + 1].high;
    const bool is_triple = is_pair && i + 2 < sides.size() && sides[i].low == sides[i + 2].low &&
                           sides[i].high == sides[i + 2].high;
    if (!is_pair && border == Border::allowed) continue;
    DELOS_CHECK(is_pair && !is_triple, ErrorKind::input, "the edge of vertices ", sides[i].low,
                " and ", sides[i].high, " has ",
                is_pair ? "more than two triangles" : "one triangle",
                ": the triangles do not close to a surface.");
    const auto link = [&](const Side& from, const Side& to) {
      mesh.triangle(from.tri).neighbour[static_cast<std::size_t>(from.side)] = to.tri;
    };
    link(sides[i], sides[i + 1]);
    link(sides[i + 1], sides[i]);
    ++i;
  }
  return mesh;
}

}  // namespace delos
