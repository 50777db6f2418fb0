// SPDX-License-Identifier: BSD-3-Clause
#include "io/rasters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/types.hpp"
#include "io/names.hpp"
#include "io/netcdf.hpp"
#include "io/raster_axes.hpp"
#include "io/unpack.hpp"

namespace delos {
namespace {

/// Values of one level at most: 43 200 x 21 600 (30 arc seconds) fits, in 7.5 GB.
constexpr std::size_t kMaxValues = std::size_t{1} << 30;

/// Rows per block of a loop over them.
constexpr std::int64_t kRowGrain = 16;

/// A variable with its axes sorted out: what every level is read with.
struct Field {
  const netcdf::Reader& file;
  const netcdf::Variable& variable;
  std::vector<RasterAxis> axes;
  std::size_t lat, lon;  ///< which dimensions
  std::string where;     ///< how messages begin
  OrderedAxis rows, columns;
  Unpacking unpacking;
};

bool is_numeric(const netcdf::Variable& variable) {
  return variable.type != netcdf::Type::text && variable.type != netcdf::Type::other;
}

bool is_on_lat_lon(const netcdf::Reader& file, const netcdf::Variable& variable) {
  if (variable.rank() < 2 || !is_numeric(variable)) return false;
  const auto axes = identify_axes(file, variable);
  return find_axis(axes, AxisKind::latitude) && find_axis(axes, AxisKind::longitude);
}

/// The only field of the file, or Error(input) with the candidates.
const netcdf::Variable& only_field(const netcdf::Reader& file) {
  std::vector<const netcdf::Variable*> flat;
  std::vector<const netcdf::Variable*> deep;
  for (const netcdf::Variable& variable : file.variables()) {
    if (is_on_lat_lon(file, variable)) (variable.rank() == 2 ? flat : deep).push_back(&variable);
  }
  const auto& candidates = flat.empty() ? deep : flat;
  std::vector<std::string> names;
  names.reserve(candidates.size());
  for (const auto* candidate : candidates) names.push_back(candidate->shape_text());
  std::vector<std::string> others;
  others.reserve(file.variables().size());
  for (const auto& variable : file.variables()) others.push_back(variable.shape_text());
  DELOS_CHECK(!candidates.empty(), ErrorKind::input, file.path(),
              ": no variable on a latitude and a longitude. It has: ", join_names(others),
              ". Give a file on a regular lat-lon grid, with coordinate variables.");
  DELOS_CHECK(candidates.size() == 1, ErrorKind::input, file.path(), ": ", candidates.size(),
              " variables could be meant: ", join_names(names), ". Name one with `variable`.");
  return *candidates[0];
}

/// A coordinate variable of two dimensions among those the variable names.
bool is_curvilinear(const netcdf::Reader& file, const netcdf::Variable& variable) {
  const std::string names =
      " " + file.text_attribute(variable.name, "coordinates").value_or("") + " ";
  return std::any_of(file.variables().begin(), file.variables().end(), [&](const auto& other) {
    return other.rank() == 2 && names.find(" " + other.name + " ") != std::string::npos;
  });
}

/// The first that says so; empty: none.
std::string coordinate_in_radians(const netcdf::Reader& file, const std::vector<RasterAxis>& axes) {
  for (const RasterAxis& axis : axes) {
    if (axis.coordinate.empty()) continue;
    const std::string units = file.text_attribute(axis.coordinate, "units").value_or("");
    if (units.compare(0, 3, "rad") == 0) return axis.coordinate;
  }
  return "";
}

std::size_t lat_lon_axis(const netcdf::Reader& file, const netcdf::Variable& variable,
                         const std::vector<RasterAxis>& axes, AxisKind kind,
                         const std::string& where) {
  const char* name = kind == AxisKind::latitude ? "latitude" : "longitude";
  const auto found = find_axis(axes, kind);
  if (found && !axes[*found].coordinate.empty()) return *found;
  DELOS_CHECK(variable.rank() >= 2, ErrorKind::input, where, ": it has ", variable.rank(),
              " dimension(s) where a latitude and a longitude are needed: ", variable.shape_text(),
              ". Name a two-dimensional field.");
  DELOS_CHECK(!is_curvilinear(file, variable), ErrorKind::input, where,
              ": its coordinates are two-dimensional (a curvilinear grid). Interpolate it to a ",
              "regular grid first, e.g. with `cdo remapbil,r720x360`.");
  const std::string in_radians = coordinate_in_radians(file, axes);
  DELOS_CHECK(in_radians.empty(), ErrorKind::input, where, ": its coordinate '", in_radians,
              "' is in radians. Convert it to degrees, with units degrees_north or degrees_east.");
  throw Error(ErrorKind::input,
              text(where, ": none of its dimensions is a ", name, ": ", variable.shape_text(),
                   ". Give each dimension a coordinate variable with units degrees_north or ",
                   "degrees_east."));
}

/// Latitudes and longitudes of the whole globe in radians, whatever their units say: the columns
/// close a turn of 2 pi to three digits, with the first one again or without, and the rows end
/// within a step of the poles. A region in degrees hardly does.
void check_degrees(const Field& field) {
  constexpr double kTolerance = 1e-3;
  const std::vector<double>&lat = field.rows.values_deg, &lon = field.columns.values_deg;
  if (lat.size() < 2 || lon.size() < 2) return;
  const double turn = lon.back() - lon.front();
  const double lon_step = turn / static_cast<double>(lon.size() - 1);
  const double lat_step = (lat.back() - lat.front()) / static_cast<double>(lat.size() - 1);
  const auto is_turn = [](double angle) { return std::abs(angle - 2.0 * kPi) < kTolerance; };
  const auto is_pole = [lat_step](double angle) {
    return angle < 0.5 * kPi + kTolerance && angle > 0.5 * kPi - lat_step - kTolerance;
  };
  const bool is_radians =
      (is_turn(turn) || is_turn(turn + lon_step)) && is_pole(-lat.front()) && is_pole(lat.back());
  DELOS_CHECK(!is_radians, ErrorKind::input, field.where, ": latitudes from ", lat.front(), " to ",
              lat.back(), " and ", turn,
              " of longitude look like radians. Convert them to degrees.");
}

Field open_field(const netcdf::Reader& file, const RasterRequest& request) {
  const netcdf::Variable& variable =
      request.variable.empty() ? only_field(file) : file.variable(request.variable);
  const std::string where = file.path() + ": variable '" + variable.name + "'";
  DELOS_CHECK(
      is_numeric(variable), ErrorKind::input, where, ": it holds ",
      variable.type == netcdf::Type::text ? "text" : "strings or values of a type of its own",
      " where numbers are needed. Name a numeric field.");
  Field field{file, variable, identify_axes(file, variable), 0, 0, where, {}, {}, {}};
  field.lat = lat_lon_axis(file, variable, field.axes, AxisKind::latitude, where);
  field.lon = lat_lon_axis(file, variable, field.axes, AxisKind::longitude, where);
  const std::size_t n_lat = variable.dimensions[field.lat].length;
  const std::size_t n_lon = variable.dimensions[field.lon].length;
  DELOS_CHECK(n_lat == 0 || n_lon <= kMaxValues / n_lat, ErrorKind::input, where, ": ", n_lat,
              " x ", n_lon, " values are too many (at most ", kMaxValues,
              "). Average the file to a coarser grid first.");
  const auto coordinates = [&](std::size_t axis) {
    return file.read_double(field.axes[axis].coordinate);
  };
  field.rows = order_latitudes(coordinates(field.lat), where);
  field.columns = order_longitudes(coordinates(field.lon), where);
  check_degrees(field);
  field.unpacking = read_unpacking(file, variable);
  field.unpacking.units =
      file_unit_conversion(file, variable.name, request.file_units, request.units);
  return field;
}

/// Position along one of the further dimensions.
std::size_t index_along(const Field& field, std::size_t axis,
                        const std::optional<std::size_t>& asked, const char* key) {
  const netcdf::Dimension& dimension = field.variable.dimensions[axis];
  DELOS_CHECK(dimension.length > 0, ErrorKind::input, field.where, ": dimension '", dimension.name,
              "' is empty. Give a file with data in it.");
  DELOS_CHECK(asked || dimension.length == 1, ErrorKind::input, field.where, ": dimension '",
              dimension.name, "' has ", dimension.length, " entries. Say which with `", key,
              "`: 0 to ", dimension.length - 1, ".");
  const std::size_t index = asked.value_or(0);
  DELOS_CHECK(index < dimension.length, ErrorKind::input, field.where, ": `", key, "` = ", index,
              ", but dimension '", dimension.name, "' has the entries 0 to ", dimension.length - 1,
              ".");
  return index;
}

/// Where the level starts in each dimension.
std::vector<std::size_t> level_start(const Field& field, const RasterRequest& request) {
  const auto time = find_axis(field.axes, AxisKind::time);
  const auto level = find_axis(field.axes, AxisKind::vertical);
  DELOS_CHECK(time || request.time_index.value_or(0) == 0, ErrorKind::input, field.where,
              ": `time` = ", *request.time_index,
              ", but it has no time dimension: ", field.variable.shape_text(),
              ". Leave `time` out.");
  DELOS_CHECK(level || request.level_index.value_or(0) == 0, ErrorKind::input, field.where,
              ": `level` = ", *request.level_index,
              ", but it has no depth dimension: ", field.variable.shape_text(),
              ". Leave `level` out.");
  std::vector<std::size_t> start(field.variable.rank(), 0);
  for (std::size_t d = 0; d < start.size(); ++d) {
    if (d == field.lat || d == field.lon) continue;
    const netcdf::Dimension& dimension = field.variable.dimensions[d];
    if (d == time) {
      start[d] = index_along(field, d, request.time_index, "time");
    } else if (d == level) {
      start[d] = index_along(field, d, request.level_index, "level");
    } else {
      DELOS_CHECK(dimension.length == 1, ErrorKind::input, field.where, ": dimension '",
                  dimension.name, "' (", dimension.length,
                  " entries) is neither latitude, longitude, time nor depth. Select one entry, ",
                  "e.g. with `ncks -d ", dimension.name, ",0`.");
    }
  }
  return start;
}

bool is_in_file_order(const OrderedAxis& axis, std::size_t n_file) {
  return axis.file_rows.size() == n_file && axis.file_rows.front() == 0;
}

/// The values of one level, rows and columns in the raster's order.
Array<double> read_level(parallel::Executor& exec, const Field& field,
                         const std::vector<std::size_t>& start, std::size_t& n_valid) {
  const std::size_t n_lat_file = field.variable.dimensions[field.lat].length;
  const std::size_t n_lon_file = field.variable.dimensions[field.lon].length;
  std::vector<std::size_t> count(field.variable.rank(), 1);
  count[field.lat] = n_lat_file;
  count[field.lon] = n_lon_file;
  Array<double> stored(n_lat_file * n_lon_file);
  field.file.read(field.variable.name, start, count, stored);
  n_valid = unpack(exec, field.unpacking, stored);
  const bool lat_first = field.lat < field.lon;
  if (lat_first && is_in_file_order(field.rows, n_lat_file) &&
      is_in_file_order(field.columns, n_lon_file)) {
    return stored;
  }
  const std::size_t n_lon = field.columns.file_rows.size();
  Array<double> values(field.rows.file_rows.size() * n_lon);
  const std::size_t row_stride = lat_first ? n_lon_file : 1;
  const std::size_t column_stride = lat_first ? 1 : n_lat_file;
  const auto n_rows = static_cast<std::int64_t>(field.rows.file_rows.size());
  parallel::for_index(exec, n_rows, kRowGrain, [&](std::int64_t row) {
    const auto j = static_cast<std::size_t>(row);
    const double* from = stored.data() + field.rows.file_rows[j] * row_stride;
    double* to = values.data() + j * n_lon;
    for (const std::size_t column : field.columns.file_rows) *to++ = from[column * column_stride];
  });
  return values;
}

Raster make_raster(const Field& field, Array<double> values) {
  return {field.file.path() + ":" + field.variable.name, field.rows.values_deg,
          field.columns.values_deg, std::move(values), field.columns.periodic};
}

void check_not_all_missing(const Field& field, std::size_t n_valid) {
  DELOS_CHECK(n_valid > 0, ErrorKind::input, field.where,
              ": all values are missing. Check _FillValue, missing_value and valid_range, or ",
              "choose another time or level.");
}

/// Depths in metres, positive down, in the file's order.
std::vector<double> read_depths_m(const Field& field, std::size_t axis) {
  const std::string& name = field.axes[axis].coordinate;
  DELOS_CHECK(!name.empty(), ErrorKind::input, field.where, ": dimension '",
              field.variable.dimensions[axis].name,
              "' has no coordinate variable that gives the depths. Add one with units.");
  const UnitConversion to_m = file_unit_conversion(field.file, name, "", "m");
  const bool is_up = field.file.text_attribute(name, "positive").value_or("down") == "up";
  std::vector<double> depth_m = field.file.read_double(name);
  for (double& depth : depth_m) {
    depth = (is_up ? -1.0 : 1.0) * (to_m.scale * depth + to_m.offset);
    DELOS_CHECK(std::isfinite(depth) && depth >= 0.0, ErrorKind::input, field.where, ": level at ",
                depth, " m depth on '", name,
                "': must be >= 0. Set its attribute `positive` to \"up\" or \"down\" as it is.");
  }
  return depth_m;
}

}  // namespace

Raster read_raster(parallel::Executor& exec, const std::string& path,
                   const RasterRequest& request) {
  const netcdf::Reader file(path);
  const Field field = open_field(file, request);
  std::size_t n_valid = 0;
  Array<double> values = read_level(exec, field, level_start(field, request), n_valid);
  check_not_all_missing(field, n_valid);
  return make_raster(field, std::move(values));
}

RasterStack read_raster_stack(parallel::Executor& exec, const std::string& path,
                              const RasterRequest& request) {
  const netcdf::Reader file(path);
  const Field field = open_field(file, request);
  const auto vertical = find_axis(field.axes, AxisKind::vertical);
  DELOS_CHECK(vertical, ErrorKind::input, field.where,
              ": none of its dimensions is a depth: ", field.variable.shape_text(),
              ". Name a variable with a depth axis (axis = \"Z\").");
  const std::vector<double> depth_m = read_depths_m(field, *vertical);
  std::vector<std::size_t> order(depth_m.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return depth_m[a] < depth_m[b]; });
  RasterRequest one_level = request;
  RasterStack stack;
  std::size_t n_valid_in_all = 0;
  for (const std::size_t level : order) {
    DELOS_CHECK(stack.depth_m.empty() || depth_m[level] > stack.depth_m.back(), ErrorKind::input,
                field.where, ": two levels at ", depth_m[level], " m depth. Remove one.");
    one_level.level_index = level;
    std::size_t n_valid = 0;
    Array<double> values = read_level(exec, field, level_start(field, one_level), n_valid);
    n_valid_in_all += n_valid;
    stack.depth_m.push_back(depth_m[level]);
    stack.levels.push_back(make_raster(field, std::move(values)));
  }
  check_not_all_missing(field, n_valid_in_all);
  return stack;
}

Raster read_raster(const std::string& path, const RasterRequest& request) {
  parallel::Executor exec(1);
  return read_raster(exec, path, request);
}

RasterStack read_raster_stack(const std::string& path, const RasterRequest& request) {
  parallel::Executor exec(1);
  return read_raster_stack(exec, path, request);
}

}  // namespace delos
