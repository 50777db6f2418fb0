// SPDX-License-Identifier: BSD-3-Clause
#include "io/face_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace delos {
namespace {

constexpr char kRings[] = "bdyMaskCell";

double whole_m2(const Ellipsoid& surface) {
  return surface.area() * surface.scale_m() * surface.scale_m();
}

}  // namespace

void write_surface(netcdf::Writer& file, const Ellipsoid& surface, LatitudeKind latitude) {
  const Vec3 radii_m = surface.radii() * surface.scale_m();
  file.attribute(netcdf::kGlobal, "delos_radii_m", std::span(radii_m.data(), 3));
  file.attribute(netcdf::kGlobal, "delos_latitude",
                 latitude == LatitudeKind::geodetic     ? "geodetic"
                 : latitude == LatitudeKind::geocentric ? "geocentric"
                                                        : "parametric");
}

std::size_t longest_row(const RowOffsets& rows) {
  std::int64_t longest = 1;
  for (std::int64_t i = 0; i < rows.n_rows(); ++i) longest = std::max(longest, rows.length_of(i));
  return at(longest);
}

double square_radians_in_m2(const Ellipsoid& surface) { return 4.0 * kPi / whole_m2(surface); }

void read_areas(const netcdf::Reader& file, const std::string& variable, FaceMesh& mesh) {
  if (!file.has_variable(variable)) return;
  mesh.face_area_m2 = file.read_double(variable);
  const double factor = whole_m2(mesh.ellipsoid.value_or(Ellipsoid())) / (4.0 * kPi);
  for (double& area : mesh.face_area_m2) area *= factor;
}

void read_surface(const netcdf::Reader& file, FaceMesh& mesh) {
  if (const auto radii = file.number_attribute("", "delos_radii_m")) {
    const bool are_radii =
        radii->size() == 3 && std::all_of(radii->begin(), radii->end(), [](double radius) {
          return std::isfinite(radius) && radius > 0.0;
        });
    DELOS_CHECK(are_radii, ErrorKind::input, file.path(),
                ": attribute delos_radii_m must be three numbers > 0. The file is damaged.");
    mesh.ellipsoid = Ellipsoid(Vec3((*radii)[0], (*radii)[1], (*radii)[2]), Vec3::Zero());
  }
  const std::string latitude = file.text_attribute("", "delos_latitude").value_or("geodetic");
  if (latitude == "geocentric") mesh.latitude = LatitudeKind::geocentric;
  if (latitude == "parametric") mesh.latitude = LatitudeKind::parametric;
}

netcdf::VariableId define_rings(netcdf::Writer& file, netcdf::DimensionId faces) {
  const netcdf::VariableId id = file.define_variable(kRings, netcdf::Type::int32, {faces});
  file.attribute(id, "units", "1");
  file.attribute(id, "long_name", "ring of the cell: 0 inside, then from there to the border");
  return id;
}

std::vector<std::int32_t> read_rings(const netcdf::Reader& file, std::size_t n_faces) {
  if (!file.has_variable(kRings)) return {};
  std::vector<std::int32_t> rings = file.read_int32(kRings);
  DELOS_CHECK(rings.size() == n_faces, ErrorKind::input, file.path(), ": variable ",
              file.variable(kRings).shape_text(), " must have a value for each of the ", n_faces,
              " cells. The file is damaged.");
  const auto bad = std::find_if(rings.begin(), rings.end(), [](auto ring) { return ring < 0; });
  DELOS_CHECK(bad == rings.end(), ErrorKind::input, file.path(), ": ", kRings, " of cell ",
              bad - rings.begin() + 1, " (from 1) is ", *bad,
              ": rings count from 0. The file is damaged.");
  return rings;
}

std::vector<double> read_radians(const netcdf::Reader& file, const std::string& variable) {
  std::vector<double> values = file.read_double(variable);
  const std::string units = file.text_attribute(variable, "units").value_or("degrees");
  const double factor = units.find("rad") == std::string::npos ? kRadPerDeg : 1.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    DELOS_CHECK(std::isfinite(values[i]), ErrorKind::input, file.path(), ": variable '", variable,
                "' is not a number at entry ", i, " (from 0). The file is damaged.");
    values[i] *= factor;
  }
  return values;
}

std::vector<LonLat> places(const netcdf::Reader& file, const std::string& what,
                           const std::vector<double>& lon_rad, const std::vector<double>& lat_rad) {
  DELOS_CHECK(lon_rad.size() == lat_rad.size(), ErrorKind::input, file.path(), ": ", what, " have ",
              lon_rad.size(), " and ", lat_rad.size(),
              " values; they must have as many. The file is damaged.");
  constexpr double kPole = kPi / 2.0 + 1e-9;  // degrees rounded to single precision on the way
  std::vector<LonLat> out(lon_rad.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    DELOS_CHECK(std::abs(lat_rad[i]) <= kPole, ErrorKind::input, file.path(), ": ", what,
                ": latitude ", lat_rad[i] * kDegPerRad, " degrees at entry ", i,
                " (from 0) is beyond the poles. Check the units.");
    const double turns = std::ceil((lon_rad[i] - kPi) / (2.0 * kPi));
    out[i] = {turns == 0.0 ? lon_rad[i] : lon_rad[i] - turns * 2.0 * kPi, lat_rad[i]};
  }
  return out;
}

}  // namespace delos
