// SPDX-License-Identifier: BSD-3-Clause
#include "io/ugrid_file.hpp"

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/blocks.hpp"

namespace delos {
namespace {

using netcdf::DimensionId;
using netcdf::Type;
using netcdf::VariableId;

// Faces that are gathered before they go to the file: a few megabytes.
constexpr std::int64_t kBlockRows = 65536;
constexpr std::int32_t kStartIndex = 1;  // as the Fortran readers count
constexpr std::int32_t kFill = -1;

double lat_deg(const LonLat& place) { return std::clamp(place.lat_rad * kDegPerRad, -90.0, 90.0); }

/// In (-180, 180].
double lon_deg(const LonLat& place) {
  const double lon_rad = place.lon_rad > kPi ? place.lon_rad - 2.0 * kPi : place.lon_rad;
  return std::clamp(lon_rad * kDegPerRad, -180.0, 180.0);
}

/// The same longitude within half a turn of `centre`.
double near_lon_deg(double lon, double centre) {
  return lon - centre > 180.0 ? lon - 360.0 : lon - centre < -180.0 ? lon + 360.0 : lon;
}

class UgridFile {
 public:
  UgridFile(parallel::Executor& exec, const std::string& path, const UgridTopology& topology,
            const UgridOptions& options)
      : exec_(exec), topology_(topology), options_(options), file_(path, options.format) {}

  void define(const UgridSurface& surface, const Provenance& provenance);
  void put();

 private:
  struct Block;
  struct Rows {
    std::int64_t begin, end;
  };
  VariableId define_coordinate(const std::string& name, const char* standard_name,
                               DimensionId dimension, const std::string& bounds);
  void define_area();
  void define_topology();
  void define_surface(const UgridSurface& surface);
  void put_nodes();
  void put_faces();
  void convert_faces(Block& block, std::int64_t first, Rows rows) const;
  void put_block(const Block& block, std::int64_t begin, std::int64_t rows);
  void put_edges();
  std::string prefixed(const char* suffix) const { return topology_.name + "_" + suffix; }

  parallel::Executor& exec_;
  const UgridTopology& topology_;
  UgridOptions options_;
  netcdf::Writer file_;
  DimensionId nodes_, faces_, edges_, corners_, two_;
  VariableId area_, crs_, node_lon_, node_lat_, face_lon_, face_lat_, lon_bounds_, lat_bounds_;
  VariableId nodes_on_face_, nodes_on_edge_, edge_spacing_, rings_;
  std::vector<double> node_lon_deg_, node_lat_deg_;  // the corners' bounds come from here
};

void UgridFile::define(const UgridSurface& surface, const Provenance& provenance) {
  nodes_ = file_.define_dimension(prefixed("nodes"), at(topology_.n_nodes));
  faces_ = file_.define_dimension(prefixed("faces"), at(topology_.n_faces));
  edges_ = file_.define_dimension(prefixed("edges"), at(topology_.n_edges));
  corners_ = file_.define_dimension(prefixed("max_corners"), topology_.max_corners);
  two_ = file_.define_dimension("two", 2);
  define_area();
  define_surface(surface);
  define_topology();
  file_.attribute(netcdf::kGlobal, "Conventions", "CF-1.8 UGRID-1.0");
  file_.attribute(netcdf::kGlobal, "source", "delos " + provenance.version);
  write_provenance(file_, provenance, topology_.elements);
  file_.end_definitions();
}

// CDO knows no topologies: it takes the grid from the first variable with coordinates and bounds,
// so this one must come first in the file.
void UgridFile::define_area() {
  area_ = file_.define_variable("area", Type::float64, {faces_});
  file_.attribute(area_, "standard_name", "cell_area");
  file_.attribute(area_, "units", "m2");
  file_.attribute(area_, "coordinates", prefixed("face_lon") + " " + prefixed("face_lat"));
  file_.attribute(area_, "mesh", topology_.name);
  file_.attribute(area_, "location", "face");
  file_.attribute(area_, "grid_mapping", "crs");
}

void UgridFile::define_surface(const UgridSurface& surface) {
  const Ellipsoid& body = surface.ellipsoid;
  const Vec3 radii_m = body.radii() * body.scale_m();
  crs_ = file_.define_variable("crs", Type::int32, {});
  file_.attribute(crs_, "grid_mapping_name", "latitude_longitude");
  if (body.is_sphere()) {
    file_.attribute(crs_, "earth_radius", radii_m[0]);
  } else if (radii_m[0] == radii_m[1]) {
    file_.attribute(crs_, "semi_major_axis", radii_m[0]);
    file_.attribute(crs_, "semi_minor_axis", radii_m[2]);
    file_.attribute(crs_, "inverse_flattening", radii_m[0] / (radii_m[0] - radii_m[2]));
  }
  const char* latitude = surface.latitude == LatitudeKind::geodetic     ? "geodetic"
                         : surface.latitude == LatitudeKind::geocentric ? "geocentric"
                                                                        : "parametric";
  file_.attribute(crs_, "delos_radii_m", std::span(radii_m.data(), 3));
  file_.attribute(crs_, "delos_latitude", latitude);
}

VariableId UgridFile::define_coordinate(const std::string& name, const char* standard_name,
                                        DimensionId dimension, const std::string& bounds) {
  const VariableId id = file_.define_variable(name, Type::float64, {dimension});
  file_.attribute(id, "standard_name", standard_name);
  file_.attribute(id, "units",
                  std::string(standard_name) == "longitude" ? "degrees_east" : "degrees_north");
  if (!bounds.empty()) file_.attribute(id, "bounds", bounds);
  return id;
}

void UgridFile::define_topology() {
  const VariableId mesh = file_.define_variable(topology_.name, Type::int32, {});
  file_.attribute(mesh, "cf_role", "mesh_topology");
  file_.attribute(mesh, "long_name", topology_.long_name);
  file_.attribute(mesh, "topology_dimension", std::int32_t{2});
  // Longitude first: ESMF refuses the other order.
  file_.attribute(mesh, "node_coordinates", prefixed("node_lon") + " " + prefixed("node_lat"));
  file_.attribute(mesh, "face_coordinates", prefixed("face_lon") + " " + prefixed("face_lat"));
  file_.attribute(mesh, "face_node_connectivity", prefixed("face_nodes"));
  file_.attribute(mesh, "edge_node_connectivity", prefixed("edge_nodes"));
  file_.attribute(mesh, "face_dimension", prefixed("faces"));
  file_.attribute(mesh, "edge_dimension", prefixed("edges"));
  node_lon_ = define_coordinate(prefixed("node_lon"), "longitude", nodes_, "");
  node_lat_ = define_coordinate(prefixed("node_lat"), "latitude", nodes_, "");
  const bool bounds = options_.bounds;
  face_lon_ = define_coordinate(prefixed("face_lon"), "longitude", faces_,
                                bounds ? prefixed("face_lon_bounds") : "");
  face_lat_ = define_coordinate(prefixed("face_lat"), "latitude", faces_,
                                bounds ? prefixed("face_lat_bounds") : "");
  nodes_on_face_ = file_.define_variable(prefixed("face_nodes"), Type::int32, {faces_, corners_});
  nodes_on_edge_ = file_.define_variable(prefixed("edge_nodes"), Type::int32, {edges_, two_});
  file_.attribute(nodes_on_face_, "cf_role", "face_node_connectivity");
  file_.attribute(nodes_on_edge_, "cf_role", "edge_node_connectivity");
  for (const VariableId id : {nodes_on_face_, nodes_on_edge_}) {
    file_.attribute(id, "start_index", kStartIndex);
    file_.attribute(id, "_FillValue", kFill);
  }
  if (topology_.edge_spacing_m) {
    edge_spacing_ = file_.define_variable("delos_edge_spacing", Type::float64, {edges_});
    file_.attribute(edge_spacing_, "long_name", "wanted edge length of the triangulation");
    file_.attribute(edge_spacing_, "units", "m");
    file_.attribute(edge_spacing_, "mesh", topology_.name);
    file_.attribute(edge_spacing_, "location", "edge");
  }
  if (!topology_.face_ring.empty()) {
    rings_ = define_rings(file_, faces_);
    file_.attribute(rings_, "mesh", topology_.name);
    file_.attribute(rings_, "location", "face");
  }
  if (!bounds) return;
  lon_bounds_ =
      file_.define_variable(prefixed("face_lon_bounds"), Type::float64, {faces_, corners_});
  lat_bounds_ =
      file_.define_variable(prefixed("face_lat_bounds"), Type::float64, {faces_, corners_});
}

void UgridFile::put() {
  const std::int32_t scalar = 0;
  file_.put(crs_, std::span(&scalar, 1));
  put_nodes();
  put_faces();
  put_edges();
  if (!topology_.face_ring.empty()) file_.put(rings_, topology_.face_ring);
  file_.close();
}

void UgridFile::put_nodes() {
  node_lon_deg_.resize(at(topology_.n_nodes));
  node_lat_deg_.resize(at(topology_.n_nodes));
  parallel::for_index(exec_, topology_.n_nodes, kConvertGrain, [&](std::int64_t node) {
    const LonLat place = topology_.node(node);
    node_lon_deg_[at(node)] = lon_deg(place);
    node_lat_deg_[at(node)] = lat_deg(place);
  });
  file_.put(node_lon_, std::span<const double>(node_lon_deg_));
  file_.put(node_lat_, std::span<const double>(node_lat_deg_));
}

/// What is said about a run of faces.
struct UgridFile::Block {
  void resize(std::size_t rows, std::size_t width) {
    for (std::vector<double>* const column : {&area_m2, &lon, &lat}) column->resize(rows);
    for (std::vector<double>* const table : {&lon_bounds, &lat_bounds}) table->resize(rows * width);
    nodes.resize(rows * width);
  }
  std::vector<double> area_m2, lon, lat, lon_bounds, lat_bounds;
  std::vector<std::int32_t> nodes;
};

void UgridFile::put_faces() {
  const std::int64_t n = topology_.n_faces;
  const auto rows_of = [n](std::int64_t k) { return std::min(kBlockRows, n - k * kBlockRows); };
  const auto convert = [&](Block& block, std::int64_t k) {
    block.resize(at(rows_of(k)), topology_.max_corners);
    parallel::for_range(exec_, rows_of(k), kConvertGrain,
                        [&](std::int64_t begin, std::int64_t end) {
                          convert_faces(block, k * kBlockRows, {begin, end});
                        });
  };
  const auto put = [&](const Block& block, std::int64_t k) {
    put_block(block, k * kBlockRows, rows_of(k));
  };
  stream_blocks<Block>(exec_, (n + kBlockRows - 1) / kBlockRows, convert, put);
}

/// The rows of a block whose first row is the face `first`.
void UgridFile::convert_faces(Block& block, std::int64_t first, Rows rows) const {
  const std::size_t width = topology_.max_corners;
  std::vector<Index> corner(width);
  for (std::int64_t row = rows.begin; row < rows.end; ++row) {
    const LonLat centre = topology_.face_centre(first + row);
    const std::size_t n_corners = topology_.corners(first + row, corner);
    block.area_m2[at(row)] = topology_.face_area_m2(first + row);
    block.lon[at(row)] = lon_deg(centre);
    block.lat[at(row)] = lat_deg(centre);
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t slot = at(row) * width + k;
      // Connectivity is padded with the fill value, bounds with the last corner (CF, CDO).
      const auto node = at(corner[std::min(k, n_corners - 1)]);
      block.nodes[slot] = k < n_corners ? static_cast<std::int32_t>(node) + kStartIndex : kFill;
      block.lon_bounds[slot] = near_lon_deg(node_lon_deg_[node], block.lon[at(row)]);
      block.lat_bounds[slot] = node_lat_deg_[node];
    }
  }
}

void UgridFile::put_block(const Block& block, std::int64_t begin, std::int64_t rows) {
  const std::array<std::size_t, 2> start = {at(begin), 0};
  const std::array<std::size_t, 2> count = {at(rows), topology_.max_corners};
  const auto put_column = [&](VariableId id, const std::vector<double>& values) {
    file_.put_block(id, std::span(start.data(), 1), std::span(count.data(), 1),
                    std::span(values.data(), count[0]));
  };
  const auto put_table = [&](VariableId id, const auto& values) {
    file_.put_block(id, start, count, std::span(values.data(), count[0] * count[1]));
  };
  put_column(area_, block.area_m2);
  put_column(face_lon_, block.lon);
  put_column(face_lat_, block.lat);
  put_table(nodes_on_face_, block.nodes);
  if (!options_.bounds) return;
  put_table(lon_bounds_, block.lon_bounds);
  put_table(lat_bounds_, block.lat_bounds);
}

void UgridFile::put_edges() {
  std::vector<std::int32_t> block;
  block.reserve(2 * at(kBlockRows));
  std::size_t written = 0;
  const auto flush = [&] {
    const std::array<std::size_t, 2> start = {written, 0}, count = {block.size() / 2, 2};
    if (topology_.edge_spacing_m) {
      const std::vector<double> spacing_m = topology_.edge_spacing_m(exec_, written, block);
      file_.put_block(edge_spacing_, std::span(start.data(), 1), std::span(count.data(), 1),
                      std::span<const double>(spacing_m));
    }
    for (std::int32_t& node : block) node += kStartIndex;
    file_.put_block(nodes_on_edge_, start, count, std::span<const std::int32_t>(block));
    written += block.size() / 2;
    block.clear();
  };
  topology_.for_each_edge([&](Index a, Index b) {
    block.push_back(a);
    block.push_back(b);
    if (block.size() == 2 * at(kBlockRows)) flush();
  });
  if (!block.empty()) flush();
  DELOS_ASSERT(written == at(topology_.n_edges));
}

}  // namespace

std::uint64_t ugrid_size_bytes(const UgridTopology& topology, const UgridOptions& options) {
  constexpr std::uint64_t kReal = 8, kId = 4;
  const std::uint64_t face =
      3 * kReal + topology.max_corners * (kId + (options.bounds ? 2 * kReal : 0));
  return static_cast<std::uint64_t>(topology.n_nodes) * 2 * kReal +
         static_cast<std::uint64_t>(topology.n_faces) * face +
         static_cast<std::uint64_t>(topology.n_edges) *
             (2 * kId + (topology.edge_spacing_m ? kReal : 0));
}

void write_ugrid_topology(const std::string& path, const UgridTopology& topology,
                          const UgridSurface& surface, const Provenance& provenance,
                          const UgridOptions& options) {
  AtomicFile target(path, ugrid_size_bytes(topology, options));
  parallel::Executor alone(1);
  parallel::Executor& exec = options.exec != nullptr ? *options.exec : alone;
  target.fill([&](const std::string& temporary) {
    UgridFile file(exec, temporary, topology, options);
    file.define(surface, provenance);
    file.put();
  });
  target.commit();
}

}  // namespace delos
