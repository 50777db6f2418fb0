// SPDX-License-Identifier: BSD-3-Clause
#include "io/mpas_layers.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "io/mpas.hpp"
#include "io/netcdf.hpp"

namespace delos {
namespace {

std::vector<double> sized(const netcdf::Reader& file, const std::string& name, std::size_t n) {
  std::vector<double> values = file.read_double(name);
  DELOS_CHECK(values.size() == n, ErrorKind::input, file.path(), ": ", name, " has ", values.size(),
              " values, must have ", n, ". The file is no MPAS file, or damaged.");
  return values;
}

void read_ocean(const netcdf::Reader& file, const std::string& thickness, MpasVertical& out) {
  out.n_layers = read_mpas_layers(file.path());
  out.interface_m = file.read_double("refBottomDepth");
  out.interface_m.insert(out.interface_m.begin(), 0.0);
  const std::size_t n_cells = out.n_layers.size(), n_levels = out.interface_m.size() - 1;
  const auto deepest = std::max_element(out.n_layers.begin(), out.n_layers.end());
  DELOS_CHECK(deepest == out.n_layers.end() || at(*deepest) <= n_levels, ErrorKind::input,
              file.path(), ": maxLevelCell of cell ", deepest - out.n_layers.begin() + 1, " is ",
              *deepest, ", refBottomDepth has ", n_levels, " levels. The file is damaged.");
  out.thickness_m = sized(file, thickness, n_cells * n_levels);
  if (file.has_variable("bottomDepth")) {
    out.bottom_depth_m = sized(file, "bottomDepth", n_cells);
    return;
  }
  for (std::size_t cell = 0; cell < n_cells; ++cell) {
    double depth_m = 0.0;
    for (std::size_t k = 0; k < at(out.n_layers[cell]); ++k) {
      depth_m += out.thickness_m[cell * n_levels + k];
    }
    out.bottom_depth_m.push_back(depth_m);
  }
}

void read_terrain(const netcdf::Reader& file, MpasVertical& out) {
  const std::size_t n_cells = file.dimension("nCells").length;
  const std::size_t n_interfaces = file.dimension("nVertLevelsP1").length;
  out.height_m = sized(file, "zgrid", n_cells * n_interfaces);
  if (file.has_variable("ter")) {
    out.ground_m = sized(file, "ter", n_cells);
    return;
  }
  for (std::size_t cell = 0; cell < n_cells; ++cell) {
    out.ground_m.push_back(out.height_m[cell * n_interfaces]);
  }
}

}  // namespace

std::optional<MpasOceanLayers> MpasVertical::ocean() const {
  if (interface_m.empty()) return std::nullopt;
  const std::size_t n_levels = interface_m.size() - 1;
  return MpasOceanLayers{interface_m, n_layers, bottom_depth_m,
                         [this, n_levels](std::int64_t cell, std::int64_t level) {
                           return thickness_m[at(cell) * n_levels + at(level)];
                         }};
}

std::optional<MpasTerrainLayers> MpasVertical::terrain() const {
  if (ground_m.empty()) return std::nullopt;
  const std::size_t n_interfaces = height_m.size() / ground_m.size();
  return MpasTerrainLayers{static_cast<std::int64_t>(n_interfaces) - 1, ground_m,
                           [this, n_interfaces](std::int64_t cell, std::int64_t interface) {
                             return height_m[at(cell) * n_interfaces + at(interface)];
                           }};
}

MpasVertical read_mpas_vertical(const std::string& path) {
  const netcdf::Reader file(path);
  MpasVertical out;
  if (file.has_variable("refBottomDepth") && file.has_variable("maxLevelCell")) {
    for (const char* thickness : {"restingThickness", "layerThickness"}) {
      if (file.has_variable(thickness)) {
        read_ocean(file, thickness, out);
        return out;
      }
    }
  }
  if (file.has_variable("zgrid")) read_terrain(file, out);
  return out;
}

}  // namespace delos
