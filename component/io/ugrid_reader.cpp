// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "io/ugrid.hpp"

namespace delos {
namespace {

/// Reads what the attributes of one topology variable point to.
class TopologyReader {
 public:
  explicit TopologyReader(const std::string& path) : file_(path) {
    for (const netcdf::Variable& variable : file_.variables()) {
      const bool mesh = file_.text_attribute(variable.name, "cf_role") == "mesh_topology";
      const auto dimension = file_.number_attribute(variable.name, "topology_dimension");
      if (mesh && dimension && dimension->front() == 2.0) {
        topology_ = variable.name;
        return;
      }
    }
    throw Error(ErrorKind::input,
                text(path,
                     ": no variable has cf_role = mesh_topology and topology_dimension = 2. "
                     "Give a UGRID file with faces."));
  }

  UgridMesh read() const;

 private:
  std::vector<LonLat> coordinates(const char* role) const;
  std::vector<double> radians(const std::string& variable) const;
  Ragged<Index> nodes_on_face(std::size_t n_nodes) const;
  void read_surface(UgridMesh& mesh) const;
  std::vector<double> face_areas(std::size_t n_faces) const;
  void read_edge_spacing(UgridMesh& mesh) const;
  std::string required(const char* attribute) const {
    const auto value = file_.text_attribute(topology_, attribute);
    DELOS_CHECK(value, ErrorKind::input, file_.path(), ": the mesh topology '", topology_,
                "' has no attribute ", attribute, ". Add it to the file.");
    return *value;
  }

  netcdf::Reader file_;
  std::string topology_;
};

std::vector<double> TopologyReader::radians(const std::string& variable) const {
  std::vector<double> values = file_.read_double(variable);
  const std::string units = file_.text_attribute(variable, "units").value_or("degrees");
  const double factor = units.find("rad") == std::string::npos ? kRadPerDeg : 1.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    DELOS_CHECK(std::isfinite(values[i]), ErrorKind::input, file_.path(), ": variable '", variable,
                "' is not a number at entry ", i, " (from 0). The file is damaged.");
    values[i] *= factor;
  }
  return values;
}

std::vector<LonLat> TopologyReader::coordinates(const char* role) const {
  std::istringstream names(required(role));
  std::vector<double> lon, lat;
  for (std::string name; names >> name;) {
    const std::string meaning = file_.text_attribute(name, "standard_name").value_or("") + " " +
                                file_.text_attribute(name, "units").value_or("");
    if (meaning.find("longitude") != std::string::npos ||
        meaning.find("east") != std::string::npos) {
      lon = radians(name);
    } else if (meaning.find("latitude") != std::string::npos ||
               meaning.find("north") != std::string::npos) {
      lat = radians(name);
    }
  }
  DELOS_CHECK(!lon.empty() && lon.size() == lat.size(), ErrorKind::input, file_.path(), ": ", role,
              " = '", required(role),
              "' does not name a longitude and a latitude of one length. Give them a "
              "standard_name.");
  std::vector<LonLat> result(lon.size());
  for (std::size_t i = 0; i < lon.size(); ++i) {
    const double turns = std::ceil((lon[i] - kPi) / (2.0 * kPi));
    result[i] = {turns == 0.0 ? lon[i] : lon[i] - turns * 2.0 * kPi, lat[i]};
  }
  return result;
}

Ragged<Index> TopologyReader::nodes_on_face(std::size_t n_nodes) const {
  const std::string name = required("face_node_connectivity");
  const netcdf::Variable& variable = file_.variable(name);
  DELOS_CHECK(variable.rank() == 2, ErrorKind::input, file_.path(), ": variable ",
              variable.shape_text(), " must have two dimensions to be a face connectivity.");
  const std::vector<std::int32_t> raw = file_.read_int32(name);
  const auto first = file_.number_attribute(name, "start_index");
  const auto fill = file_.number_attribute(name, "_FillValue");
  const std::int64_t start = first ? static_cast<std::int64_t>(first->front()) : 0;
  const auto face_dimension = file_.text_attribute(topology_, "face_dimension");
  const bool transposed = face_dimension && variable.dimensions[0].name != *face_dimension &&
                          variable.dimensions[1].name == *face_dimension;
  const std::size_t n_faces = variable.dimensions[transposed ? 1 : 0].length;
  const std::size_t width = variable.dimensions[transposed ? 0 : 1].length;
  Ragged<Index> result;
  Array<std::int64_t> offsets(1, 0);
  for (std::size_t face = 0; face < n_faces; ++face) {
    for (std::size_t k = 0; k < width; ++k) {
      const std::int32_t value = raw[transposed ? k * n_faces + face : face * width + k];
      if (fill && static_cast<double>(value) == fill->front()) continue;
      const std::int64_t node = value - start;
      DELOS_CHECK(node >= 0 && node < static_cast<std::int64_t>(n_nodes), ErrorKind::input,
                  file_.path(), ": variable '", name, "' names node ", value, " in face ", face,
                  " (from 0), outside ", start, "..",
                  start + static_cast<std::int64_t>(n_nodes) - 1,
                  ". Check start_index and _FillValue.");
      result.values.push_back(static_cast<Index>(node));
    }
    offsets.push_back(static_cast<std::int64_t>(result.values.size()));
  }
  result.offsets = RowOffsets(std::move(offsets));
  return result;
}

void TopologyReader::read_surface(UgridMesh& mesh) const {
  for (const netcdf::Variable& variable : file_.variables()) {
    const std::string& name = variable.name;
    if (!file_.text_attribute(name, "grid_mapping_name")) continue;
    const auto number = [&](const char* attribute) {
      return file_.number_attribute(name, attribute).value_or(std::vector<double>());
    };
    const std::vector<double> radii = number("delos_radii_m"), major = number("semi_major_axis"),
                              minor = number("semi_minor_axis"),
                              inverse = number("inverse_flattening"),
                              radius = number("earth_radius");
    if (radii.size() == 3) {
      mesh.ellipsoid = Ellipsoid(Vec3(radii[0], radii[1], radii[2]), Vec3::Zero());
    } else if (!radius.empty()) {
      mesh.ellipsoid = Ellipsoid::sphere(radius[0]);
    } else if (!major.empty() && (!minor.empty() || !inverse.empty())) {
      const double c = !minor.empty()      ? minor[0]
                       : inverse[0] == 0.0 ? major[0]
                                           : major[0] * (1.0 - 1.0 / inverse[0]);
      mesh.ellipsoid = Ellipsoid(Vec3(major[0], major[0], c), Vec3::Zero());
    }
    const std::string latitude = file_.text_attribute(name, "delos_latitude").value_or("geodetic");
    mesh.latitude = latitude == "geocentric"   ? LatitudeKind::geocentric
                    : latitude == "parametric" ? LatitudeKind::parametric
                                               : LatitudeKind::geodetic;
    return;
  }
}

std::vector<double> TopologyReader::face_areas(std::size_t n_faces) const {
  for (const netcdf::Variable& variable : file_.variables()) {
    if (file_.text_attribute(variable.name, "standard_name") == "cell_area" &&
        file_.text_attribute(variable.name, "units") == "m2" && variable.rank() == 1 &&
        variable.n_values() == n_faces) {
      return file_.read_double(variable.name);
    }
  }
  return {};
}

// Only our own files have it, so the tables have the shape that we write.
void TopologyReader::read_edge_spacing(UgridMesh& mesh) const {
  const std::string nodes_name = required("edge_node_connectivity");
  mesh.edge_spacing_m = file_.read_double("delos_edge_spacing");
  const std::vector<std::int32_t> nodes = file_.read_int32(nodes_name);
  const std::size_t n_edges = mesh.edge_spacing_m.size();
  DELOS_CHECK(nodes.size() == 2 * n_edges, ErrorKind::input, file_.path(), ": variable '",
              nodes_name, "' has ", nodes.size(), " values, expected two for each of the ", n_edges,
              " of delos_edge_spacing. The file is damaged.");
  const auto first = file_.number_attribute(nodes_name, "start_index");
  const std::int64_t start = first ? static_cast<std::int64_t>(first->front()) : 0;
  const auto n_nodes = static_cast<std::int64_t>(mesh.node.size());
  mesh.nodes_on_edge.resize(n_edges);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::int64_t node = nodes[i] - start;
    DELOS_CHECK(node >= 0 && node < n_nodes, ErrorKind::input, file_.path(), ": variable '",
                nodes_name, "' names node ", nodes[i], " in edge ", i / 2,
                " (from 0), which is not there. The file is damaged.");
    mesh.nodes_on_edge[i / 2][i % 2] = static_cast<Index>(node);
  }
}

UgridMesh TopologyReader::read() const {
  UgridMesh mesh;
  mesh.topology = topology_;
  mesh.node = coordinates("node_coordinates");
  mesh.nodes_on_face = nodes_on_face(mesh.node.size());
  if (file_.text_attribute(topology_, "face_coordinates")) {
    mesh.face_centre = coordinates("face_coordinates");
  }
  const auto n_faces = static_cast<std::size_t>(mesh.nodes_on_face.offsets.n_rows());
  mesh.face_area_m2 = face_areas(n_faces);
  read_surface(mesh);
  mesh.face_ring = read_rings(file_, n_faces);
  if (file_.has_variable("delos_edge_spacing")) read_edge_spacing(mesh);
  return mesh;
}

}  // namespace

UgridMesh read_ugrid(const std::string& path) { return TopologyReader(path).read(); }

}  // namespace delos
