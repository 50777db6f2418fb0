// SPDX-License-Identifier: BSD-3-Clause
#include "io/scrip.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/put_rows.hpp"

namespace delos {
namespace {

using netcdf::DimensionId;
using netcdf::Type;
using netcdf::VariableId;

struct CellColumns {
  DimensionId size;
  VariableId dims, centre_lat, centre_lon, corner_lat, corner_lon, mask, area;
};

CellColumns define(netcdf::Writer& file, const Grid& grid, std::size_t width) {
  const DimensionId size = file.define_dimension("grid_size", at(grid.n_cells()));
  const DimensionId corners = file.define_dimension("grid_corners", width);
  const DimensionId rank = file.define_dimension("grid_rank", 1);
  const auto angle = [&](const char* name, std::initializer_list<DimensionId> shape) {
    const VariableId id = file.define_variable(name, Type::float64, shape);
    file.attribute(id, "units", "degrees");
    return id;
  };
  CellColumns out;
  out.size = size;
  out.dims = file.define_variable("grid_dims", Type::int32, {rank});
  out.centre_lat = angle("grid_center_lat", {size});
  out.centre_lon = angle("grid_center_lon", {size});
  out.mask = file.define_variable("grid_imask", Type::int32, {size});
  file.attribute(out.mask, "units", "unitless");
  out.area = file.define_variable("grid_area", Type::float64, {size});
  file.attribute(out.area, "units", "square radians");
  out.corner_lat = angle("grid_corner_lat", {size, corners});
  out.corner_lon = angle("grid_corner_lon", {size, corners});
  return out;
}

double corner_lat_deg(const LonLat& place) {
  return std::clamp(place.lat_rad * kDegPerRad, -90.0, 90.0);
}
double corner_lon_deg(const LonLat& place) { return place.lon_rad * kDegPerRad; }

void put(parallel::Executor& exec, netcdf::Writer& file, const CellColumns& columns,
         const Grid& grid, std::size_t width) {
  const std::int64_t n = grid.n_cells();
  const auto dims = static_cast<std::int32_t>(n);
  file.put(columns.dims, std::span(&dims, 1));
  using Reals = std::span<double>;
  const auto corner = [&](std::int64_t cell, std::size_t k) -> const LonLat& {
    const auto row = grid.vertices_on_cell.row(cell);
    return grid.vertex_lon_lat[at(row[std::min(k, row.size() - 1)])];
  };
  put_rows<double>(exec, file, {columns.centre_lat, n}, [&](std::int64_t cell, Reals out) {
    out[0] = corner_lat_deg(grid.cell_lon_lat[at(cell)]);
  });
  put_rows<double>(exec, file, {columns.centre_lon, n}, [&](std::int64_t cell, Reals out) {
    out[0] = corner_lon_deg(grid.cell_lon_lat[at(cell)]);
  });
  put_rows<std::int32_t>(exec, file, {columns.mask, n},
                         [](std::int64_t, std::span<std::int32_t> out) { out[0] = 1; });
  const double factor = square_radians_in_m2(grid.surface);
  put_rows<double>(exec, file, {columns.area, n}, [&](std::int64_t cell, Reals out) {
    out[0] = factor * grid.cell_area_m2[at(cell)];
  });
  put_rows<double>(exec, file, {columns.corner_lat, n, width}, [&](std::int64_t cell, Reals out) {
    for (std::size_t k = 0; k < width; ++k) out[k] = corner_lat_deg(corner(cell, k));
  });
  put_rows<double>(exec, file, {columns.corner_lon, n, width}, [&](std::int64_t cell, Reals out) {
    for (std::size_t k = 0; k < width; ++k) out[k] = corner_lon_deg(corner(cell, k));
  });
}

/// Ids of equal places, in order of their first use; the places.
std::vector<Index> merge(const std::vector<LonLat>& corners, std::vector<LonLat>& nodes) {
  const auto less = [&](std::int64_t a, std::int64_t b) {
    const LonLat& p = corners[at(a)];
    const LonLat& q = corners[at(b)];
    return p.lat_rad != q.lat_rad   ? p.lat_rad < q.lat_rad
           : p.lon_rad != q.lon_rad ? p.lon_rad < q.lon_rad
                                    : a < b;
  };
  std::vector<std::int64_t> order(corners.size());
  std::iota(order.begin(), order.end(), std::int64_t{0});
  std::sort(order.begin(), order.end(), less);
  std::vector<std::int64_t> first(corners.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const LonLat& here = corners[at(order[i])];
    const bool is_same = i > 0 && corners[at(order[i - 1])].lat_rad == here.lat_rad &&
                         corners[at(order[i - 1])].lon_rad == here.lon_rad;
    first[at(order[i])] = is_same ? first[at(order[i - 1])] : order[i];
  }
  std::vector<Index> id(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (at(first[i]) == i) {
      id[i] = static_cast<Index>(nodes.size());
      nodes.push_back(corners[i]);
    } else {
      id[i] = id[at(first[i])];
    }
  }
  return id;
}

/// Without those that repeat the one before them, or the first.
Ragged<Index> distinct(const std::string& path, const std::vector<Index>& id, std::size_t width) {
  Ragged<Index> out;
  Array<std::int64_t> offsets(1, 0);
  for (std::size_t cell = 0; cell < id.size() / width; ++cell) {
    const auto begin = out.values.size();
    for (std::size_t k = 0; k < width; ++k) {
      const Index node = id[cell * width + k];
      if (out.values.size() == begin || out.values.back() != node) out.values.push_back(node);
    }
    while (out.values.size() > begin + 1 && out.values.back() == out.values[begin]) {
      out.values.pop_back();
    }
    DELOS_CHECK(out.values.size() >= begin + 3, ErrorKind::input, path, ": cell ", cell + 1,
                " (from 1) has ", out.values.size() - begin,
                " different corners; a cell needs three. The file is damaged.");
    offsets.push_back(static_cast<std::int64_t>(out.values.size()));
  }
  out.offsets = RowOffsets(std::move(offsets));
  return out;
}

/// At a pole every longitude is the same place.
void settle_poles(std::vector<LonLat>& corners) {
  for (LonLat& place : corners) {
    if (std::abs(place.lat_rad) >= kPi / 2.0) place.lon_rad = 0.0;
  }
}

}  // namespace

void write_scrip(const std::string& path, const Grid& grid, const Provenance& provenance,
                 const ScripOptions& options) {
  const std::size_t width = longest_row(grid.vertices_on_cell.offsets);
  const std::uint64_t row_bytes = 3 * sizeof(double) + 4 + 2 * width * sizeof(double);
  AtomicFile target(path, static_cast<std::uint64_t>(grid.n_cells()) * row_bytes);
  parallel::Executor alone(1);
  target.fill([&](const std::string& temporary) {
    netcdf::Writer file(temporary, options.format);
    const CellColumns columns = define(file, grid, width);
    file.attribute(netcdf::kGlobal, "title", "Voronoi cells");
    file.attribute(netcdf::kGlobal, "Conventions", "SCRIP");
    file.attribute(netcdf::kGlobal, "source", "delos " + provenance.version);
    write_surface(file, grid.surface, grid.latitude);
    Provenance notes = provenance;
    notes.certificate.reset();
    write_provenance(file, notes, {});
    netcdf::VariableId rings;
    if (!grid.cell_ring.empty()) rings = define_rings(file, columns.size);
    file.end_definitions();
    if (!grid.cell_ring.empty()) file.put(rings, std::span<const std::int32_t>(grid.cell_ring));
    put(options.exec != nullptr ? *options.exec : alone, file, columns, grid, width);
    file.close();
  });
  target.commit();
}

FaceMesh read_scrip(const std::string& path) {
  const netcdf::Reader file(path);
  FaceMesh mesh;
  read_surface(file, mesh);
  mesh.face_centre =
      places(file, "grid_center_lon and grid_center_lat", read_radians(file, "grid_center_lon"),
             read_radians(file, "grid_center_lat"));
  const netcdf::Variable& shape = file.variable("grid_corner_lat");
  DELOS_CHECK(shape.rank() == 2 && shape.dimensions[0].length == mesh.face_centre.size() &&
                  shape.dimensions[1].length > 0,
              ErrorKind::input, path, ": variable ", shape.shape_text(),
              " must have a row of corners for each of the ", mesh.face_centre.size(),
              " cells of grid_center_lat. The file is no SCRIP grid, or damaged.");
  std::vector<LonLat> corners =
      places(file, "grid_corner_lon and grid_corner_lat", read_radians(file, "grid_corner_lon"),
             read_radians(file, "grid_corner_lat"));
  settle_poles(corners);
  const std::vector<Index> ids = merge(corners, mesh.node);
  mesh.nodes_on_face = distinct(path, ids, shape.dimensions[1].length);
  read_areas(file, "grid_area", mesh);
  mesh.face_ring = read_rings(file, mesh.face_centre.size());
  return mesh;
}

}  // namespace delos
