// SPDX-License-Identifier: BSD-3-Clause
// What makes the grid fine: each kind of source, from YAML to the cells.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "lifecycle/remesh.hpp"
#include "support/remesh_model.hpp"

using namespace delos;
using delos::samples::kRemeshConfig;
using Model = delos::samples::RemeshModel;

namespace {

/// Degrees from -180 to 180.
double lon_deg_of(const LonLat& place) {
  const double lon_deg = place.lon_rad * kDegPerRad;
  return lon_deg > 180.0 ? lon_deg - 360.0 : lon_deg;
}

/// A host that gives one field of values in the cells, of its own making.
template <class Value>
void run_with(Model& model, int day, const std::string& name, const Value& value) {
  const Array<LonLat>& places = model.component->product()->grid->cell_lon_lat;
  model.u.assign(places.size(), 0.0);
  for (std::size_t i = 0; i < model.u.size(); ++i) {
    model.u[i] = value(lon_deg_of(places[i]), places[i].lat_rad * kDegPerRad);
  }
  model.component->imports()->item(name)->bind(model.u);
  model.run_without_values(day);
}

/// Cells whose generators lie in a box.
std::int64_t cells_in(const Model& model, double west, double east, double south, double north) {
  std::int64_t n = 0;
  for (const LonLat& place : model.component->product()->grid->cell_lon_lat) {
    const double lon = lon_deg_of(place), lat = place.lat_rad * kDegPerRad;
    if (lon > west && lon < east && lat > south && lat < north) ++n;
  }
  return n;
}

Settings with_sources(const std::string& sources) {
  const std::string all = kRemeshConfig;
  return read_settings(parse_config(all.substr(0, all.find("  sources: [{type: eke")) +
                                        "  sources: [" + sources + "]\n",
                                    "remesh.yaml"),
                       ".");
}

}  // namespace

TEST_CASE("the variability of the sea surface makes the grid fine from YAML on") {
  Model model(
      with_sources("{type: ssh_variability, form: threshold, threshold: 0.1 m, "
                   "spacing_below: 1200 km, spacing_above: 500 km}"));
  const std::int64_t before = cells_in(model, -60, 60, 0, 60);
  for (int day = 0; day < 10; ++day) {
    run_with(model, day, "sea_surface_height_above_geoid", [&](double lon, double lat) {
      const bool is_lively = std::abs(lon) < 60.0 && lat > 0.0 && lat < 60.0;
      return 0.5 + (is_lively ? (day % 2 == 0 ? 0.3 : -0.3) : 0.0);
    });
  }
  REQUIRE(model.component->generation() == 2);
  CHECK(cells_in(model, -60, 60, 0, 60) > 2 * before);
}

TEST_CASE("the gradient of vorticity makes the grid fine from YAML on") {
  Model model(
      with_sources("{type: vorticity_gradient, quiet: [1e-14, 1200 km], "
                   "energetic: [1e-13, 500 km]}"));
  const std::int64_t before = cells_in(model, -180, 180, 0, 60);
  for (int day = 0; day < 10; ++day) {
    const Array<LonLat>& places = model.component->product()->grid->cell_lon_lat;
    model.v.assign(places.size(), 0.0);
    model.component->imports()->item("surface_northward_sea_water_velocity")->bind(model.v);
    // A jet in the north: its vorticity changes sign over some 20 degrees.
    run_with(model, day, "surface_eastward_sea_water_velocity", [](double, double lat) {
      const double d = (lat - 30.0) / 15.0;
      return std::exp(-d * d);
    });
  }
  REQUIRE(model.component->generation() == 2);
  CHECK(cells_in(model, -180, 180, 0, 60) > 2 * before);
}

TEST_CASE("the host's own spacing is taken as it is") {
  const std::string source = "{type: wanted_spacing, missing: 900 km}";
  // Farther from the 1200 km of the start than tau everywhere: within it the old spacing stays.
  const auto wanted = [](double, double lat) { return lat > 0.0 ? 450e3 : 900e3; };
  Model model(with_sources(source));
  for (int day = 0; day < 10; ++day) run_with(model, day, "wanted_spacing", wanted);
  REQUIRE(model.component->generation() == 2);
  const SpacingField& spacing = model.component->product()->spacing;
  const double scale_m = model.component->product()->settings.surface.scale_m();
  CHECK(spacing.at(0.0, 0.6, 0.8) * scale_m == doctest::Approx(450e3).epsilon(0.01));
  CHECK(spacing.at(0.0, 0.6, -0.8) * scale_m == doctest::Approx(900e3).epsilon(0.01));

  // On the host's own table, where a value may be missing.
  Model gridded(with_sources(source));
  LatLonAxes axes;
  for (double lon = 0.0; lon < 360.0; lon += 5.0) axes.lon_deg.push_back(lon);
  for (double lat = 87.5; lat > -90.0; lat -= 5.0) axes.lat_deg.push_back(lat);
  std::vector<double> values;
  for (const double lat : axes.lat_deg) {
    for (const double lon : axes.lon_deg) {
      values.push_back(lat < -40.0 ? std::nan("") : wanted(lon, lat));
    }
  }
  for (int day = 0; day < 10; ++day) {
    const auto item = gridded.component->imports()->item("wanted_spacing");
    item->place_on(axes);
    item->bind(values);
    gridded.run_without_values(day);
  }
  REQUIRE(gridded.component->generation() == 2);
  CHECK(gridded.component->product()->spacing.at(0.0, 0.6, 0.8) * scale_m ==
        doctest::Approx(450e3).epsilon(0.01));
  // What is no spacing leaves the grid.
  Model wrong(with_sources(source));
  for (int day = 0; day < 10; ++day) {
    run_with(wrong, day, "wanted_spacing",
             [](double, double lat) { return lat > 0.0 ? -5.0 : 1e6; });
  }
  CHECK(wrong.component->generation() == 1);
  CHECK(wrong.component->remesh_failure().find("wanted_spacing") != std::string::npos);
}

TEST_CASE("what lies upstream of the eddies becomes fine when it is asked for") {
  const auto cells_upstream = [](const std::string& more) {
    Model model(
        with_sources("{type: eke, form: threshold, threshold: 0.2 m/s, spacing_below: "
                     "1200 km, spacing_above: 500 km" +
                     more + "}"));
    for (int day = 0; day < 10; ++day) {
      const Array<LonLat>& places = model.component->product()->grid->cell_lon_lat;
      model.v.assign(places.size(), 0.0);
      for (std::size_t i = 0; i < model.v.size(); ++i) {
        const double lon = places[i].lon_rad * kDegPerRad, lat = places[i].lat_rad * kDegPerRad;
        const bool is_lively = lon > 0.0 && lon < 60.0 && std::abs(lat) < 30.0;
        model.v[i] = is_lively ? (day % 2 == 0 ? 2.0 : -2.0) : 0.0;
      }
      model.component->imports()->item("surface_northward_sea_water_velocity")->bind(model.v);
      run_with(model, day, "surface_eastward_sea_water_velocity",
               [](double, double) { return 0.5; });
    }
    REQUIRE(model.component->generation() == 2);
    return std::pair(cells_in(model, -50, -15, -25, 25), cells_in(model, 75, 110, -25, 25));
  };
  const auto plain = cells_upstream("");
  const auto spread = cells_upstream(", upstream: {length: 6000 km}");
  CHECK(spread.first > 2 * plain.first);
  CHECK(spread.second < 1.3 * static_cast<double>(plain.second));
}
