// SPDX-License-Identifier: BSD-3-Clause
#include "io/raster_axes.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numeric>

#include "core/error.hpp"

namespace delos {
namespace {

/// Latitudes beyond the pole by less than this are poles in single precision.
constexpr double kPoleTolerance_deg = 1e-4;
/// Columns that repeat the first ones (a halo for interpolation) at most.
constexpr std::size_t kMaxRepeatedColumns = 4;
/// Coordinates this close to an even grid (in steps) are that grid, rounded when it was written.
constexpr double kEvenTolerance = 0.25;
/// The gap over the seam of a periodic axis, in steps.
constexpr double kMaxSeamSteps = 1.5;

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool begins_with(const std::string& text, const std::string& beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
}

template <std::size_t N>
bool is_one_of(const std::string& text, const std::array<const char*, N>& names) {
  return std::find(names.begin(), names.end(), text) != names.end();
}

constexpr std::array<const char*, 6> kNorth = {"degrees_north", "degree_north", "degrees_n",
                                               "degree_n",      "degreesn",     "degreen"};
constexpr std::array<const char*, 6> kEast = {"degrees_east", "degree_east", "degrees_e",
                                              "degree_e",     "degreese",    "degreee"};
constexpr std::array<const char*, 5> kAngle = {"", "1", "deg", "degree", "degrees"};
constexpr std::array<const char*, 6> kVerticalNames = {"depth", "z",      "lev",
                                                       "level", "deptht", "height"};

/// By units, standard name, axis, name, in this order of trust (CF conventions, section 4).
AxisKind kind_of(const netcdf::Reader& file, const std::string& name) {
  const auto attribute = [&](const char* key) {
    return lower(file.text_attribute(name, key).value_or(""));
  };
  const std::string units = attribute("units");
  if (is_one_of(units, kNorth)) return AxisKind::latitude;
  if (is_one_of(units, kEast)) return AxisKind::longitude;
  if (begins_with(units, "rad")) return AxisKind::other;  // never taken for degrees
  if (units.find(" since ") != std::string::npos) return AxisKind::time;
  const std::string standard_name = attribute("standard_name");
  if (standard_name == "latitude") return AxisKind::latitude;
  if (standard_name == "longitude") return AxisKind::longitude;
  if (standard_name == "time") return AxisKind::time;
  if (standard_name == "depth" || standard_name == "height") return AxisKind::vertical;
  const std::string axis = attribute("axis");
  // Metres along "X" or "Y" are a map projection, which is no lat-lon grid.
  const bool is_angle = is_one_of(units, kAngle);
  if (axis == "y" && is_angle) return AxisKind::latitude;
  if (axis == "x" && is_angle) return AxisKind::longitude;
  if (axis == "t") return AxisKind::time;
  if (axis == "z" || !attribute("positive").empty()) return AxisKind::vertical;
  const std::string lowered = lower(name);
  if (is_angle && (begins_with(lowered, "lat") || lowered == "y" || lowered == "nav_lat")) {
    return AxisKind::latitude;
  }
  if (is_angle && (begins_with(lowered, "lon") || lowered == "x" || lowered == "nav_lon")) {
    return AxisKind::longitude;
  }
  if (begins_with(lowered, "time") || lowered == "t") return AxisKind::time;
  return is_one_of(lowered, kVerticalNames) ? AxisKind::vertical : AxisKind::other;
}

bool is_coordinate_of(const netcdf::Variable& candidate, const netcdf::Dimension& dimension) {
  return candidate.rank() == 1 && candidate.dimensions[0].name == dimension.name &&
         candidate.type != netcdf::Type::text && candidate.type != netcdf::Type::other;
}

RasterAxis identify(const netcdf::Reader& file, const netcdf::Dimension& dimension) {
  for (const netcdf::Variable& candidate : file.variables()) {
    if (candidate.name == dimension.name && is_coordinate_of(candidate, dimension)) {
      return {kind_of(file, candidate.name), candidate.name};
    }
  }
  // No variable of the dimension's own name: an auxiliary coordinate on it will do.
  for (const netcdf::Variable& candidate : file.variables()) {
    if (!is_coordinate_of(candidate, dimension)) continue;
    const AxisKind kind = kind_of(file, candidate.name);
    if (kind != AxisKind::other) return {kind, candidate.name};
  }
  // Without values only what is indexed can be known, by the name of the dimension.
  const std::string name = lower(dimension.name);
  if (begins_with(name, "time") || name == "t") return {AxisKind::time, ""};
  return {is_one_of(name, kVerticalNames) ? AxisKind::vertical : AxisKind::other, ""};
}

void check_ascending(const std::vector<double>& values, const std::string& where,
                     const char* what) {
  DELOS_CHECK(values.size() >= 2, ErrorKind::input, where, ": it has ", values.size(), " ", what,
              " where at least 2 are needed to interpolate. Give a two-dimensional field.");
  for (std::size_t i = 0; i < values.size(); ++i) {
    DELOS_CHECK(std::isfinite(values[i]), ErrorKind::input, where, ": ", what, " ", i,
                " is not a number. Repair the coordinates.");
    DELOS_CHECK(i == 0 || values[i] > values[i - 1], ErrorKind::input, where, ": the ", what,
                " are not monotonic: ", values[i - (i > 0 ? 1 : 0)], " and then ", values[i],
                " degrees (entry ", i, "). Sort the file by its coordinates.");
  }
}

std::vector<std::size_t> counted_rows(std::size_t n, bool reversed) {
  std::vector<std::size_t> rows(n);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  if (reversed) std::reverse(rows.begin(), rows.end());
  return rows;
}

std::vector<double> gather(const std::vector<double>& values,
                           const std::vector<std::size_t>& rows) {
  std::vector<double> gathered;
  gathered.reserve(rows.size());
  for (const std::size_t row : rows) gathered.push_back(values[row]);
  return gathered;
}

/// Most neighbours descend (a jump of 360 degrees does not count).
bool is_descending(const std::vector<double>& values) {
  std::size_t n_down = 0;
  for (std::size_t i = 1; i < values.size(); ++i) n_down += values[i] < values[i - 1] ? 1 : 0;
  return 2 * n_down > values.size();
}

/// Undoes the one jump of an axis such as 0.5 ... 179.5, -179.5 ... -0.5.
void continue_longitudes(std::vector<double>& lon_deg) {
  double turn = 0.0;
  for (std::size_t i = 1; i < lon_deg.size(); ++i) {
    if (turn == 0.0 && lon_deg[i] < lon_deg[i - 1] - 180.0) turn = 360.0;
    lon_deg[i] += turn;
  }
}

double median_step(const std::vector<double>& values) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(values[i] - values[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

void make_even(std::vector<double>& lon_deg) {
  const auto n = static_cast<double>(lon_deg.size());
  const double step = 360.0 / n;
  const double first = lon_deg[0];
  for (std::size_t i = 0; i < lon_deg.size(); ++i) {
    const double even = first + 360.0 * static_cast<double>(i) / n;
    if (std::abs(lon_deg[i] - even) > kEvenTolerance * step) return;
  }
  for (std::size_t i = 0; i < lon_deg.size(); ++i) {
    lon_deg[i] = first + 360.0 * static_cast<double>(i) / n;
  }
}

}  // namespace

std::vector<RasterAxis> identify_axes(const netcdf::Reader& file,
                                      const netcdf::Variable& variable) {
  std::vector<RasterAxis> axes;
  for (const netcdf::Dimension& dimension : variable.dimensions) {
    axes.push_back(identify(file, dimension));
  }
  return axes;
}

std::optional<std::size_t> find_axis(const std::vector<RasterAxis>& axes, AxisKind kind) {
  std::optional<std::size_t> found;
  for (std::size_t d = 0; d < axes.size(); ++d) {
    if (axes[d].kind != kind) continue;
    if (found) return std::nullopt;
    found = d;
  }
  return found;
}

OrderedAxis order_latitudes(const std::vector<double>& lat_deg, const std::string& where) {
  OrderedAxis axis;
  axis.file_rows = counted_rows(lat_deg.size(), is_descending(lat_deg));
  axis.values_deg = gather(lat_deg, axis.file_rows);
  check_ascending(axis.values_deg, where, "latitudes");
  for (double& lat : axis.values_deg) {
    DELOS_CHECK(std::abs(lat) <= 90.0 + kPoleTolerance_deg, ErrorKind::input, where, ": latitude ",
                lat, " degrees is outside [-90, 90]. Repair the coordinates.");
    lat = std::clamp(lat, -90.0, 90.0);
  }
  check_ascending(axis.values_deg, where, "latitudes");
  return axis;
}

OrderedAxis order_longitudes(const std::vector<double>& lon_deg, const std::string& where) {
  OrderedAxis axis;
  axis.file_rows = counted_rows(lon_deg.size(), is_descending(lon_deg));
  std::vector<double>& lon = axis.values_deg;
  lon = gather(lon_deg, axis.file_rows);
  continue_longitudes(lon);
  check_ascending(lon, where, "longitudes");
  const double step = median_step(lon);
  const auto once_round = std::lower_bound(lon.begin(), lon.end(), lon[0] + 360.0 - 0.5 * step);
  const auto n_repeated = static_cast<std::size_t>(lon.end() - once_round);
  DELOS_CHECK(n_repeated <= kMaxRepeatedColumns, ErrorKind::input, where, ": the longitudes from ",
              lon.front(), " to ", lon.back(), " degrees go more than once round the globe (",
              n_repeated, " columns too many). Cut the file to 360 degrees.");
  lon.erase(once_round, lon.end());
  axis.file_rows.resize(lon.size());
  check_ascending(lon, where, "longitudes");
  axis.periodic = lon[0] + 360.0 - lon.back() <= kMaxSeamSteps * step;
  if (axis.periodic) make_even(lon);
  const double turns = std::floor((lon[0] + 180.0) / 360.0) * 360.0;
  for (double& value : lon) value -= turns;
  return axis;
}

}  // namespace delos
