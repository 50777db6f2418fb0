// SPDX-License-Identifier: BSD-3-Clause
#include "io/weight_file.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/face_mesh.hpp"

namespace delos {
namespace {

using netcdf::DimensionId;
using netcdf::Type;
using netcdf::VariableId;

/// The variables of one grid while it is written: names end in _a (source) or _b (target).
struct GridVariables {
  VariableId dims, lat, lon, corner_lat, corner_lon, mask, area, fraction;
};

VariableId define_angle(netcdf::Writer& file, const std::string& name,
                        std::initializer_list<DimensionId> dimensions) {
  const VariableId id = file.define_variable(name, Type::float64, dimensions);
  file.attribute(id, "units", "degrees");
  return id;
}

GridVariables define_grid(netcdf::Writer& file, const WeightFileGrid& grid,
                          const std::string& end) {
  const std::string side = end == "_a" ? "src" : "dst";
  const DimensionId n = file.define_dimension("n" + end, at(grid.n()));
  const DimensionId rank = file.define_dimension(side + "_grid_rank", 1);
  GridVariables ids;
  ids.dims = file.define_variable(side + "_grid_dims", Type::int32, {rank});
  ids.lat = define_angle(file, "yc" + end, {n});
  ids.lon = define_angle(file, "xc" + end, {n});
  if (!grid.corner_lon_deg.empty()) {
    const DimensionId corners = file.define_dimension("nv" + end, at(grid.n_corners));
    ids.corner_lat = define_angle(file, "yv" + end, {n, corners});
    ids.corner_lon = define_angle(file, "xv" + end, {n, corners});
  }
  ids.mask = file.define_variable("mask" + end, Type::int32, {n});
  file.attribute(ids.mask, "units", "unitless");
  ids.area = file.define_variable("area" + end, Type::float64, {n});
  file.attribute(ids.area, "units", "square radians");
  ids.fraction = file.define_variable("frac" + end, Type::float64, {n});
  file.attribute(ids.fraction, "units", "unitless");
  return ids;
}

void put_grid(netcdf::Writer& file, const WeightFileGrid& grid, const GridVariables& ids) {
  const auto n = static_cast<std::int32_t>(grid.n());
  file.put(ids.dims, std::span(&n, 1));
  file.put(ids.lat, std::span<const double>(grid.lat_deg));
  file.put(ids.lon, std::span<const double>(grid.lon_deg));
  if (!grid.corner_lon_deg.empty()) {
    file.put(ids.corner_lat, std::span<const double>(grid.corner_lat_deg));
    file.put(ids.corner_lon, std::span<const double>(grid.corner_lon_deg));
  }
  std::vector<std::int32_t> mask(grid.area.size());
  std::transform(grid.fraction.begin(), grid.fraction.end(), mask.begin(),
                 [](double fraction) { return fraction > 0.0 ? 1 : 0; });
  file.put(ids.mask, std::span<const std::int32_t>(mask));
  file.put(ids.area, std::span<const double>(grid.area));
  file.put(ids.fraction, std::span<const double>(grid.fraction));
}

std::vector<std::int32_t> from_one(const Array<Index>& ids) {
  std::vector<std::int32_t> result(ids.size());
  std::transform(ids.begin(), ids.end(), result.begin(), [](Index id) { return id + 1; });
  return result;
}

void write(const std::string& path, const WeightFile& weights, const Provenance& provenance,
           netcdf::Format format) {
  netcdf::Writer file(path, format);
  const GridVariables source = define_grid(file, weights.source, "_a");
  const GridVariables target = define_grid(file, weights.target, "_b");
  // A dimension has at least one entry; between grids there is no empty matrix.
  const DimensionId n = file.define_dimension("n_s", weights.value.size());
  const VariableId value = file.define_variable("S", Type::float64, {n});
  const VariableId column = file.define_variable("col", Type::int32, {n});
  const VariableId row = file.define_variable("row", Type::int32, {n});
  file.attribute(netcdf::kGlobal, "title", "delos regridding weights");
  file.attribute(netcdf::kGlobal, "normalization", weights.is_of_covered ? "fracarea" : "destarea");
  file.attribute(netcdf::kGlobal, "map_method", "Conservative remapping");
  file.attribute(netcdf::kGlobal, "ESMF_regrid_method", weights.method);
  file.attribute(netcdf::kGlobal, "conventions", "NCAR-CSM");
  Provenance notes = provenance;
  notes.certificate.reset();  // of a grid, which this file does not hold
  write_provenance(file, notes, {});
  file.end_definitions();
  put_grid(file, weights.source, source);
  put_grid(file, weights.target, target);
  file.put(value, std::span<const double>(weights.value));
  file.put(column, std::span<const std::int32_t>(from_one(weights.column)));
  file.put(row, std::span<const std::int32_t>(from_one(weights.row)));
  file.close();
}

/// What the two layouts call things, for one grid.
struct GridNames {
  std::string lat, lon, corner_lat, corner_lon, area, fraction;
};
struct Names {
  std::string value, row, column, method;
  GridNames source, target;
};

GridNames esmf_grid(const std::string& end) {
  return {"yc" + end, "xc" + end, "yv" + end, "xv" + end, "area" + end, "frac" + end};
}
GridNames scrip_grid(const std::string& side) {
  return {side + "_grid_center_lat", side + "_grid_center_lon", side + "_grid_corner_lat",
          side + "_grid_corner_lon", side + "_grid_area",       side + "_grid_frac"};
}

Names names_in(const netcdf::Reader& file) {
  if (file.has_variable("S") && file.has_variable("row") && file.has_variable("col")) {
    return {"S", "row", "col", "ESMF_regrid_method", esmf_grid("_a"), esmf_grid("_b")};
  }
  DELOS_CHECK(file.has_variable("remap_matrix") && file.has_variable("dst_address") &&
                  file.has_variable("src_address"),
              ErrorKind::input, file.path(),
              ": no variables S, row and col (ESMF) or remap_matrix, dst_address and src_address "
              "(SCRIP). Give a file of regridding weights.");
  return {"remap_matrix", "dst_address",     "src_address",
          "map_method",   scrip_grid("src"), scrip_grid("dst")};
}

std::vector<double> degrees(const netcdf::Reader& file, const std::string& name) {
  if (!file.has_variable(name)) return {};
  std::vector<double> values = file.read_double(name);
  const std::string units = file.text_attribute(name, "units").value_or("degrees");
  if (units.find("rad") != std::string::npos) {
    for (double& value : values) value *= kDegPerRad;
  }
  return values;
}

WeightFileGrid read_grid(const netcdf::Reader& file, const GridNames& names) {
  WeightFileGrid grid;
  grid.lat_deg = degrees(file, names.lat);
  grid.lon_deg = degrees(file, names.lon);
  grid.corner_lat_deg = degrees(file, names.corner_lat);
  grid.corner_lon_deg = degrees(file, names.corner_lon);
  grid.area = file.read_double(names.area);
  grid.fraction = file.read_double(names.fraction);
  DELOS_CHECK(grid.lat_deg.size() == grid.area.size() && grid.lon_deg.size() == grid.area.size() &&
                  grid.fraction.size() == grid.area.size() &&
                  grid.corner_lat_deg.size() == grid.corner_lon_deg.size() &&
                  grid.corner_lat_deg.size() % std::max<std::size_t>(1, grid.area.size()) == 0,
              ErrorKind::input, file.path(), ": variables ", names.lat, ", ", names.lon, ", ",
              names.area, " and ", names.fraction,
              " must have one value for each cell. The file is damaged.");
  if (grid.n() > 0)
    grid.n_corners = static_cast<std::int64_t>(grid.corner_lat_deg.size()) / grid.n();
  return grid;
}

Array<Index> read_ids(const netcdf::Reader& file, const std::string& name, std::int64_t n) {
  const std::vector<std::int32_t> raw = file.read_int32(name);
  Array<Index> ids(raw.size());
  for (std::size_t k = 0; k < raw.size(); ++k) {
    DELOS_CHECK(raw[k] >= 1 && raw[k] <= n, ErrorKind::input, file.path(), ": variable '", name,
                "' names cell ", raw[k], " in entry ", k, " (from 0), outside 1..", n,
                ". The file is damaged.");
    ids[k] = raw[k] - 1;
  }
  return ids;
}

}  // namespace

WeightFileGrid weight_file_grid(const Grid& grid) {
  WeightFileGrid result;
  const double square_m = grid.surface.scale_m() * grid.surface.scale_m();
  for (std::int64_t i = 0; i < grid.n_cells(); ++i) {
    result.lon_deg.push_back(grid.cell_lon_lat[at(i)].lon_rad * kDegPerRad);
    result.lat_deg.push_back(grid.cell_lon_lat[at(i)].lat_rad * kDegPerRad);
    result.area.push_back(grid.cell_area_m2[at(i)] / square_m);
  }
  result.n_corners = static_cast<std::int64_t>(longest_row(grid.vertices_on_cell.offsets));
  result.fraction.assign(result.area.size(), 1.0);
  for (std::int64_t i = 0; i < grid.n_cells(); ++i) {
    const auto corners = grid.vertices_on_cell.row(i);
    for (std::size_t k = 0; k < at(result.n_corners); ++k) {
      const LonLat& place = grid.vertex_lon_lat[at(corners[std::min(k, corners.size() - 1)])];
      result.corner_lon_deg.push_back(place.lon_rad * kDegPerRad);
      result.corner_lat_deg.push_back(place.lat_rad * kDegPerRad);
    }
  }
  return result;
}

void write_weights(const std::string& path, const WeightFile& weights, const Provenance& provenance,
                   netcdf::Format format) {
  constexpr std::uint64_t kEntry = 16;  // bytes of a weight and its two ids
  DELOS_CHECK(!weights.value.empty() && weights.value.size() == weights.row.size() &&
                  weights.value.size() == weights.column.size(),
              ErrorKind::output, path, ": ", weights.value.size(), " weights, ", weights.row.size(),
              " rows and ", weights.column.size(),
              " columns: there must be as many of each, and at least one.");
  const auto reals = [](const WeightFileGrid& grid) {
    return 4 * grid.area.size() + 2 * grid.corner_lon_deg.size();
  };
  AtomicFile file(path, kEntry * weights.value.size() +
                            sizeof(double) * (reals(weights.source) + reals(weights.target)));
  file.fill([&](const std::string& temporary) { write(temporary, weights, provenance, format); });
  file.commit();
}

WeightFile read_weights(const std::string& path) {
  const netcdf::Reader file(path);
  const Names names = names_in(file);
  const netcdf::Variable& matrix = file.variable(names.value);
  DELOS_CHECK(matrix.rank() == 1 || (matrix.rank() == 2 && matrix.dimensions[1].length == 1),
              ErrorKind::input, path, ": variable ", matrix.shape_text(),
              " holds weights of gradients too. Make first-order weights, or a matrix of second "
              "order as ESMF does.");
  WeightFile weights;
  weights.source = read_grid(file, names.source);
  weights.target = read_grid(file, names.target);
  weights.row = read_ids(file, names.row, weights.target.n());
  weights.column = read_ids(file, names.column, weights.source.n());
  const std::vector<double> values = file.read_double(names.value);
  weights.value.assign(values.begin(), values.end());
  DELOS_CHECK(weights.row.size() == values.size() && weights.column.size() == values.size(),
              ErrorKind::input, path, ": ", values.size(), " weights, ", weights.row.size(),
              " rows and ", weights.column.size(), " columns. The file is damaged.");
  for (std::size_t k = 0; k < values.size(); ++k) {
    DELOS_CHECK(std::isfinite(values[k]), ErrorKind::input, path, ": variable '", names.value,
                "' is not a number at entry ", k, " (from 0). The file is damaged.");
  }
  weights.method = file.text_attribute("", names.method).value_or("");
  return weights;
}

}  // namespace delos
