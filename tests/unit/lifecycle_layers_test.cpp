// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/layers.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "lifecycle/config_file.hpp"
#include "lifecycle/settings.hpp"
#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"

using namespace delos;
using delos::testing::expect_error;

namespace {

Settings settings_of(const std::string& layers) {
  return read_settings(
      parse_config("sizing: {sources: [{type: constant, spacing: 600 km}]}\nlayers: " + layers,
                   "a.yaml"),
      ".");
}

void refused(const std::string& layers, const std::string& message) {
  CAPTURE(layers);
  expect_error(ErrorKind::config, {message}, [&] { static_cast<void>(settings_of(layers)); });
}

/// Of one degree: 4000 m of sea with a basin of 7000 m, and a continent up to 3000 m.
Raster sample_elevation() {
  Raster out;
  out.source = "made up";
  out.periodic = true;
  for (int i = 0; i < 360; ++i) out.lon_deg.push_back(i - 179.5);
  for (int j = 0; j < 180; ++j) out.lat_deg.push_back(j - 89.5);
  for (const double lat : out.lat_deg) {
    for (const double lon : out.lon_deg) {
      const double from_land = std::hypot(lon - 60.0, lat - 10.0) / 35.0;
      const double from_basin = std::hypot(lon + 120.0, lat + 20.0) / 40.0;
      const double sea = from_basin < 1.0 ? -7000.0 + 3000.0 * from_basin : -4000.0;
      out.values.push_back(from_land < 1.0 ? 3000.0 * (1.0 - from_land) + 1.0 : sea);
    }
  }
  return out;
}

struct Run {
  Settings settings;
  Report report;
  Layers layers;
};

Grid sample_grid() {
  const Ellipsoid earth = Ellipsoid::sphere(6371220.0);
  return samples::grid_of(earth, samples::shaken(earth, 4, 0.2, 3));
}

Run run(const Grid& grid, const std::string& layers, int threads = 2, bool is_sea_only = false) {
  parallel::Executor exec(threads);
  Monitor monitor;
  Context context{exec, monitor};
  Run out{settings_of(layers), {}, {}};
  out.layers =
      make_layers(context, out.settings, {grid, sample_elevation(), is_sea_only}, out.report);
  return out;
}

double value(const Report& report, const std::string& key) {
  REQUIRE(report.sections.size() == 1);
  CHECK(report.sections[0].name == "layers");
  for (const auto& [name, value] : report.sections[0].values) {
    if (name != key) continue;
    const auto* const whole = std::get_if<std::int64_t>(&value);
    return whole != nullptr ? static_cast<double>(*whole) : std::get<double>(value);
  }
  FAIL("no " << key);
  return 0.0;
}

}  // namespace

TEST_CASE("the section layers is read with its defaults, and left out there is none") {
  CHECK_FALSE(read_settings(parse_config("generator: icosahedral\nsubdivisions: 4\n", "a"), ".")
                  .layers.has_value());
  const Settings ocean = settings_of("{kind: z_level}");
  REQUIRE(ocean.layers);
  CHECK(ocean.layers->n_levels() == 60);
  CHECK(ocean.layers->levels.depth_m() == 5500.0);
  CHECK(ocean.layers->bathymetry.min_depth_m == 10.0);
  CHECK(ocean.layers->bathymetry.max_depth_m == 5500.0);
  CHECK(ocean.layers->bathymetry.max_r_factor == 0.0);
  CHECK(ocean.layers->stack.min_levels == 3);
  CHECK(ocean.layers->stack.has_partial_bottom);
  CHECK(ocean.sizing.bathymetry.field.file == "auto");
  const Settings again = read_settings(parse_config(ocean.text, "b.yaml"), ".");
  CHECK(again.text == ocean.text);
  CHECK(settings_of("{kind: z_level, levels: {shape: ocean_80}}").layers->n_levels() == 80);
  CHECK(settings_of("{kind: z_level, levels: {shape: uniform, n: 4, depth: 4 km}}")
            .layers->levels.interface_m == std::vector<double>{0.0, 1e3, 2e3, 3e3, 4e3});
  CHECK(settings_of("{kind: z_level, levels: {shape: listed, interfaces: [10 m, 30 m, 0.1 km]}}")
            .layers->levels.interface_m == std::vector<double>{0.0, 10.0, 30.0, 100.0});
  const Settings land = settings_of("{kind: terrain_following, n: 40, top: 20 km}");
  CHECK(land.layers->n_levels() == 40);
  CHECK(land.layers->terrain.top_m == 20000.0);
  CHECK(land.layers->terrain.level_above_m == 20000.0);
}

TEST_CASE("mistakes in the section layers are named") {
  refused("{kind: sigma}", "'sigma' is not known");
  refused("{levels: {shape: ocean_60}}", "layers.kind: missing");
  refused("{kind: z_level, n: 10}", "layers.n: goes with kind: terrain_following");
  refused("{kind: terrain_following, r_factor: 0.2}", "layers.r_factor: goes with kind: z_level");
  refused("{kind: z_level, levels: {shape: ocean_60, n: 10}}", "layers.levels.n: goes with shape");
  refused("{kind: z_level, levels: {shape: ocean_60, depth: 50 km}}", "reach");
  refused("{kind: z_level, levels: {shape: listed, interfaces: [30 m, 10 m]}}",
          "the interface at 10 m follows one at 30 m");
  refused("{kind: z_level, levels: {shape: listed, interfaces: [30 m], depth: 9 m}}",
          "the last interface is the depth");
  refused("{kind: z_level, minimum_levels: 61}", "there are 60 levels only");
  refused("{kind: z_level, minimum_depth: 6 km}", "the lowest interface is at 5500 m");
  refused("{kind: z_level, partial_bottom: false, minimum_fraction: 0.2}", "partial_bottom: true");
  refused("{kind: z_level, r_factor: 2}", "between 0.01 and 1");
  refused("{kind: terrain_following, top: 10 km, level_above: 20 km}", "above the top");
}

TEST_CASE("a made up ocean has the volume of its elevation, and layers where it is sea") {
  const Grid grid = sample_grid();
  const Run ocean = run(grid, "{kind: z_level, levels: {shape: ocean_80, depth: 7 km}}");
  REQUIRE(ocean.layers.ocean);
  const domain::Stack& stack = *ocean.layers.ocean;
  std::int64_t n_land = 0;
  for (std::size_t i = 0; i < stack.n_layers.size(); ++i) {
    n_land += stack.n_layers[i] == 0 ? 1 : 0;
    CHECK((stack.n_layers[i] == 0) == (stack.bottom_depth_m[i] == 0.0));
  }
  CHECK(n_land > 50);
  CHECK(value(ocean.report, "n_wet") == static_cast<double>(grid.n_cells() - n_land));
  CHECK(value(ocean.report, "volume_ratio") == doctest::Approx(1.0).epsilon(0.005));
  CHECK(cell_weights(ocean.layers).size() == stack.n_layers.size());
  CHECK(cell_weights(ocean.layers)[5] == stack.n_layers[5]);
  // Below the usual 5500 m the basin is cut off.
  const Run shallow = run(grid, "{kind: z_level}");
  CHECK(value(shallow.report, "n_cut") > 0.0);
  CHECK(value(shallow.report, "volume_ratio") < value(ocean.report, "volume_ratio"));
  for (const int threads : {1, 5}) {
    const Run other = run(grid, "{kind: z_level, levels: {shape: ocean_80, depth: 7 km}}", threads);
    CHECK(std::ranges::equal(other.layers.ocean->bottom_depth_m, stack.bottom_depth_m));
  }
}

TEST_CASE("a culled grid is sea all over, and its floor no shallower than asked for") {
  const Grid grid = sample_grid();
  const Run sea = run(grid, "{kind: z_level, minimum_depth: 100 m, r_factor: 0.3}", 2, true);
  CHECK(value(sea.report, "n_wet") == static_cast<double>(grid.n_cells()));
  CHECK(value(sea.report, "r_factor") <= 0.3);
  CHECK(value(sea.report, "r_factor_before") > 0.3);
  for (const double depth_m : sea.layers.ocean->bottom_depth_m) CHECK(depth_m >= 90.0);
}

TEST_CASE("layers come back from what is saved of them, to the last bit") {
  const Grid grid = sample_grid();
  const Run ocean = run(grid, "{kind: z_level}");
  const Layers again = restored_layers(*ocean.settings.layers, saved_heights(ocean.layers));
  CHECK(std::ranges::equal(again.ocean->n_layers, ocean.layers.ocean->n_layers));
  CHECK(std::ranges::equal(again.ocean->bottom_depth_m, ocean.layers.ocean->bottom_depth_m));
  CHECK(again.ocean->levels.interface_m == ocean.layers.ocean->levels.interface_m);
  const Run land = run(grid, "{kind: terrain_following}");
  const Layers land_again = restored_layers(*land.settings.layers, saved_heights(land.layers));
  CHECK(std::ranges::equal(land_again.terrain->ground_m, land.layers.terrain->ground_m));
  CHECK(land_again.terrain->zeta_m == land.layers.terrain->zeta_m);
  CHECK(land_again.terrain->influence == land.layers.terrain->influence);
  CHECK(cell_weights(land.layers).empty());
  CHECK(value(land.report, "ground_max_m") > 1000.0);
  CHECK(value(land.report, "ground_max_m") < 3001.0);
}
