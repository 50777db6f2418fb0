// SPDX-License-Identifier: BSD-3-Clause
#include "io/esmf_mesh.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/put_rows.hpp"

namespace delos {
namespace {

using netcdf::DimensionId;
using netcdf::Type;
using netcdf::VariableId;

constexpr std::int32_t kFirstNode = 1;
constexpr std::int32_t kNoNode = -1;

struct ElementColumns {
  DimensionId elements;
  VariableId nodes, connection, n_connected, centres, area, mask;
};

ElementColumns define_elements(netcdf::Writer& file, const Grid& grid, std::size_t width) {
  const DimensionId nodes = file.define_dimension("nodeCount", at(grid.n_vertices()));
  const DimensionId elements = file.define_dimension("elementCount", at(grid.n_cells()));
  const DimensionId corners = file.define_dimension("maxNodePElement", width);
  const DimensionId two = file.define_dimension("coordDim", 2);
  ElementColumns out;
  out.elements = elements;
  out.nodes = file.define_variable("nodeCoords", Type::float64, {nodes, two});
  file.attribute(out.nodes, "units", "degrees");
  out.connection = file.define_variable("elementConn", Type::int32, {elements, corners});
  file.attribute(out.connection, "long_name", "Node indices that define the element connectivity");
  file.attribute(out.connection, "_FillValue", kNoNode);
  file.attribute(out.connection, "start_index", kFirstNode);
  out.n_connected = file.define_variable("numElementConn", Type::int32, {elements});
  file.attribute(out.n_connected, "long_name", "Number of nodes per element");
  out.centres = file.define_variable("centerCoords", Type::float64, {elements, two});
  file.attribute(out.centres, "units", "degrees");
  out.area = file.define_variable("elementArea", Type::float64, {elements});
  file.attribute(out.area, "units", "radians^2");
  out.mask = file.define_variable("elementMask", Type::int32, {elements});
  return out;
}

void put_place(const LonLat& place, std::span<double> out) {
  out[0] = place.lon_rad * kDegPerRad;
  out[1] = std::clamp(place.lat_rad * kDegPerRad, -90.0, 90.0);
}

void put_elements(parallel::Executor& exec, netcdf::Writer& file, const ElementColumns& columns,
                  const Grid& grid, std::size_t width) {
  using Reals = std::span<double>;
  using Ids = std::span<std::int32_t>;
  const std::int64_t n = grid.n_cells();
  put_rows<double>(
      exec, file, {columns.nodes, grid.n_vertices(), 2},
      [&](std::int64_t node, Reals out) { put_place(grid.vertex_lon_lat[at(node)], out); });
  put_rows<std::int32_t>(exec, file, {columns.connection, n, width},
                         [&](std::int64_t cell, Ids out) {
                           const auto row = grid.vertices_on_cell.row(cell);
                           for (std::size_t k = 0; k < width; ++k) {
                             out[k] = k < row.size() ? row[k] + kFirstNode : kNoNode;
                           }
                         });
  put_rows<std::int32_t>(exec, file, {columns.n_connected, n}, [&](std::int64_t cell, Ids out) {
    out[0] = static_cast<std::int32_t>(grid.vertices_on_cell.row(cell).size());
  });
  put_rows<double>(exec, file, {columns.centres, n, 2}, [&](std::int64_t cell, Reals out) {
    put_place(grid.cell_lon_lat[at(cell)], out);
  });
  const double factor = square_radians_in_m2(grid.surface);
  put_rows<double>(exec, file, {columns.area, n}, [&](std::int64_t cell, Reals out) {
    out[0] = factor * grid.cell_area_m2[at(cell)];
  });
  put_rows<std::int32_t>(exec, file, {columns.mask, n}, [](std::int64_t, Ids out) { out[0] = 1; });
}

/// A table [rows, 2] of longitude and latitude.
std::vector<LonLat> read_places(const netcdf::Reader& file, const std::string& name) {
  const netcdf::Variable& shape = file.variable(name);
  DELOS_CHECK(shape.rank() == 2 && shape.dimensions[1].length == 2, ErrorKind::input, file.path(),
              ": variable ", shape.shape_text(),
              " must have two coordinates a row, longitude and latitude.");
  const std::vector<double> values = read_radians(file, name);
  std::vector<double> lon(values.size() / 2), lat(values.size() / 2);
  for (std::size_t i = 0; i < lon.size(); ++i) {
    lon[i] = values[2 * i];
    lat[i] = values[2 * i + 1];
  }
  return places(file, name, lon, lat);
}

Ragged<Index> read_connection(const netcdf::Reader& file, std::size_t n_nodes) {
  const netcdf::Variable& shape = file.variable("elementConn");
  const std::vector<std::int32_t> counts = file.read_int32("numElementConn");
  DELOS_CHECK(shape.rank() == 2 && shape.dimensions[0].length == counts.size(), ErrorKind::input,
              file.path(), ": variable ", shape.shape_text(), " must have a row for each of the ",
              counts.size(), " elements of numElementConn. The file is damaged.");
  const std::vector<std::int32_t> nodes = file.read_int32("elementConn");
  const auto first = file.number_attribute("elementConn", "start_index");
  const std::int64_t start = first ? static_cast<std::int64_t>(first->front()) : 1;
  const auto width = static_cast<std::int32_t>(shape.dimensions[1].length);
  Ragged<Index> out;
  Array<std::int64_t> offsets(1, 0);
  for (std::size_t row = 0; row < counts.size(); ++row) {
    DELOS_CHECK(counts[row] >= 3 && counts[row] <= width, ErrorKind::input, file.path(),
                ": numElementConn is ", counts[row], " for element ", row + 1,
                " (from 1), must be in [3, ", width, "]. The file is damaged.");
    for (std::int32_t k = 0; k < counts[row]; ++k) {
      const std::int64_t node = nodes[row * at(width) + at(k)] - start;
      DELOS_CHECK(node >= 0 && node < static_cast<std::int64_t>(n_nodes), ErrorKind::input,
                  file.path(), ": elementConn names node ", node + start, " in element ", row + 1,
                  " (from 1), outside ", start, "..",
                  start + static_cast<std::int64_t>(n_nodes) - 1, ". Check start_index.");
      out.values.push_back(static_cast<Index>(node));
    }
    offsets.push_back(static_cast<std::int64_t>(out.values.size()));
  }
  out.offsets = RowOffsets(std::move(offsets));
  return out;
}

}  // namespace

void write_esmf_mesh(const std::string& path, const Grid& grid, const Provenance& provenance,
                     const EsmfMeshOptions& options) {
  const std::size_t width = longest_row(grid.vertices_on_cell.offsets);
  constexpr std::uint64_t kReal = 8, kId = 4;
  AtomicFile target(path,
                    static_cast<std::uint64_t>(grid.n_cells()) * (3 * kReal + (2 + width) * kId) +
                        static_cast<std::uint64_t>(grid.n_vertices()) * 2 * kReal);
  parallel::Executor alone(1);
  target.fill([&](const std::string& temporary) {
    netcdf::Writer file(temporary, options.format);
    const ElementColumns columns = define_elements(file, grid, width);
    file.attribute(netcdf::kGlobal, "gridType", "unstructured mesh");
    file.attribute(netcdf::kGlobal, "version", "0.9");
    file.attribute(netcdf::kGlobal, "source", "delos " + provenance.version);
    write_surface(file, grid.surface, grid.latitude);
    Provenance notes = provenance;
    notes.certificate.reset();  // of triangles and edges, which the file does not name
    write_provenance(file, notes, {});
    VariableId rings;
    if (!grid.cell_ring.empty()) rings = define_rings(file, columns.elements);
    file.end_definitions();
    if (!grid.cell_ring.empty()) file.put(rings, std::span<const std::int32_t>(grid.cell_ring));
    put_elements(options.exec != nullptr ? *options.exec : alone, file, columns, grid, width);
    file.close();
  });
  target.commit();
}

FaceMesh read_esmf_mesh(const std::string& path) {
  const netcdf::Reader file(path);
  FaceMesh mesh;
  read_surface(file, mesh);
  mesh.node = read_places(file, "nodeCoords");
  mesh.nodes_on_face = read_connection(file, mesh.node.size());
  const auto n_faces = static_cast<std::size_t>(mesh.nodes_on_face.offsets.n_rows());
  if (file.has_variable("centerCoords")) {
    mesh.face_centre = read_places(file, "centerCoords");
    DELOS_CHECK(mesh.face_centre.size() == n_faces, ErrorKind::input, path, ": centerCoords has ",
                mesh.face_centre.size(), " rows for ", n_faces, " elements. The file is damaged.");
  }
  read_areas(file, "elementArea", mesh);
  mesh.face_ring = read_rings(file, n_faces);
  return mesh;
}

}  // namespace delos
