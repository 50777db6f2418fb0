// SPDX-License-Identifier: BSD-3-Clause
// Vertex counts of published recipes on the sphere of 6371.22 km, against the counts of published
// meshes (uniform, EC, RRS) and of an independent implementation (the data-driven ones).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include "io/rasters.hpp"
#include "sizing/sources.hpp"

using namespace delos;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);
const std::string kFerret = "/usr/share/ferret-vis/data/";

template <class Source>
SpacingSource named(Source source) {
  SpacingSource result;
  result.name = "recipe";
  result.source = std::move(source);
  return result;
}

double count(const SpacingRecipe& recipe) {
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  return expected_vertices(exec, kEarth, build_spacing(context, kEarth, recipe));
}

void check_count(const SpacingRecipe& recipe, double expected, double tolerance = 0.03) {
  const double n = count(recipe);
  CAPTURE(expected);
  CAPTURE(n);
  CHECK(std::abs(n / expected - 1.0) < tolerance);
}

LatitudeProfileSource profile(const std::function<double(double)>& spacing_km) {
  LatitudeProfileSource source;
  for (int lat = -90; lat <= 90; ++lat) {
    source.lat_deg.push_back(lat);
    source.spacing_m.push_back(1e3 * spacing_km(std::abs(lat)));
  }
  source.cubic = true;
  return source;
}

/// Eddy closure: two tanh steps in the density h^-4 (MPAS-Tools, EC60to30 defaults).
double eddy_closure_km(double lat) {
  const auto density = [](double h) { return std::pow(30.0 / h, 4); };
  const auto step = [](double x) { return 0.5 * (1.0 + std::tanh(x)); };
  const double middle = density(60.0), pole = density(35.0);
  const double rho = lat < 40.0 ? middle + (1.0 - middle) * step((15.0 - lat) / 6.0)
                                : pole + (middle - pole) * step((73.0 - lat) / 9.0);
  return 30.0 / std::pow(rho, 0.25);
}

/// Rossby radius scaling: density between the equator's and the pole's by sin^4 (MPAS-Tools, RRS).
double rossby_scaling_km(double lat, double equator, double pole) {
  const double gamma = std::pow(pole / equator, 4);
  return pole / std::pow((1.0 - gamma) * std::pow(std::sin(lat * kRadPerDeg), 4) + gamma, 0.25);
}

std::string data_folder() {
  const char* folder = std::getenv("DELOS_TEST_DATA");
  return folder ? std::string(folder) + "/" : "";
}

bool has_file(const std::string& path) {
  if (std::filesystem::exists(path)) return true;
  MESSAGE("skipped: no " << path << " (set DELOS_TEST_DATA, install ferret-datasets)");
  return false;
}

std::shared_ptr<const Raster> read(const std::string& path, const std::string& variable,
                                   std::optional<std::size_t> time = {}) {
  RasterRequest request;
  request.variable = variable;
  request.time_index = time;
  return std::make_shared<Raster>(read_raster(path, request));
}

EddySource eddies(std::shared_ptr<const Raster> field, double quiet_m, double energetic_m,
                  double smooth_deg) {
  EddySource source;
  source.field = std::move(field);
  source.form = EddyLinear{0.05, quiet_m, 0.45, energetic_m};
  source.smooth_rad = smooth_deg * kRadPerDeg;
  return source;
}

std::shared_ptr<const Raster> etopo5() { return read(kFerret + "etopo5.cdf", "ROSE"); }

}  // namespace

TEST_CASE("uniform spacings have the vertex counts of published meshes") {
  for (const auto& [spacing_km, expected] : std::vector<std::pair<double, double>>{
           {240, 10.2e3}, {120, 40.9e3}, {60, 164e3}, {30, 654e3}, {15, 2.62e6}}) {
    SpacingRecipe recipe;
    recipe.sources = {named(ConstantSource{1e3 * spacing_km})};
    check_count(recipe, expected, 0.005);
  }
}

TEST_CASE("latitude profiles have the vertex counts of published meshes") {
  SpacingRecipe recipe;
  recipe.sources = {named(profile(eddy_closure_km))};
  check_count(recipe, 327e3, 0.01);
  recipe.sources = {named(profile([](double lat) { return rossby_scaling_km(lat, 30, 10); }))};
  check_count(recipe, 2.18e6, 0.01);
  recipe.sources = {named(profile([](double lat) { return rossby_scaling_km(lat, 18, 6); }))};
  check_count(recipe, 6.07e6, 0.01);
}

TEST_CASE("the Rossby recipe has its vertex count") {
  const std::string path = data_folder() + "rossby_radius_levitus94_1deg.nc";
  if (!has_file(path)) return;
  RossbySource rossby;
  rossby.radius_m = read(path, "rossby_radius");
  SpacingRecipe recipe;
  recipe.resolution_rad = 0.25 * kRadPerDeg;
  recipe.sources = {named(rossby)};
  recipe.clamp = ClampOptions{30e3, 150e3};
  recipe.gradient_limit = 0.15;
  check_count(recipe, 340e3);
}

TEST_CASE("slope and coast recipes from 5-minute bathymetry have their vertex counts") {
  if (!has_file(kFerret + "etopo5.cdf")) return;
  SpacingRecipe recipe;
  recipe.resolution_rad = 0.25 * kRadPerDeg;
  recipe.elevation_m = etopo5();
  recipe.land_spacing_m = 60e3;
  recipe.sources = {named(SlopeSource{})};
  recipe.clamp = ClampOptions{15e3, 60e3};
  recipe.gradient_limit = 0.15;
  check_count(recipe, 503e3);
  recipe.sources = {named(CoastSource{15e3, 0.1, 60e3, nullptr})};
  recipe.gradient_limit = 0.1;
  check_count(recipe, 390e3);
}

TEST_CASE("eddy recipes from altimetry have their vertex counts") {
  const std::string mean = data_folder() + "eke_mean_1993-2022_0p25.nc";
  const std::string snapshots = data_folder() + "eke_snapshots_2016_2019_0p25.nc";
  if (!has_file(mean) || !has_file(snapshots)) return;
  SpacingRecipe recipe;
  recipe.gradient_limit = 0.1;
  recipe.resolution_rad = 1.5 * kRadPerDeg;
  recipe.sources = {named(eddies(read(mean, "eke"), 60e3, 10e3, 0.5))};
  check_count(recipe, 384e3);
  recipe.sources = {named(eddies(read(mean, "eke"), 240e3, 40e3, 0.5))};
  check_count(recipe, 34e3);
  recipe.gradient_limit = 0.15;
  recipe.resolution_rad = 0.25 * kRadPerDeg;
  recipe.clamp = ClampOptions{40e3, 240e3};
  recipe.sources = {named(eddies(read(snapshots, "eke", 0), 240e3, 40e3, 1.5))};
  check_count(recipe, 27.8e3);
  recipe.sources = {named(eddies(read(snapshots, "eke", 1), 240e3, 40e3, 1.5))};
  check_count(recipe, 28.2e3);
}

TEST_CASE("the least of eddies, Rossby radius, coast and slope has its vertex count") {
  const std::string mean = data_folder() + "eke_mean_1993-2022_0p25.nc";
  const std::string radius = data_folder() + "rossby_radius_levitus94_1deg.nc";
  if (!has_file(mean) || !has_file(radius) || !has_file(kFerret + "etopo20.cdf")) return;
  for (const auto& [scale, expected] : {std::pair{1.0, 2.73e6}, std::pair{4.0, 195e3}}) {
    RossbySource rossby;
    rossby.radius_m = read(radius, "rossby_radius");
    rossby.factor = scale;
    SlopeSource slope;
    slope.cells = 20.0 / scale;
    SpacingRecipe recipe;
    recipe.resolution_rad = kRadPerDeg / 3.0;
    recipe.elevation_m = read(kFerret + "etopo20.cdf", "ROSE");
    recipe.sources = {named(eddies(read(mean, "eke"), scale * 60e3, scale * 10e3, 2.0)),
                      named(rossby), named(CoastSource{scale * 15e3, 0.1, scale * 60e3, nullptr}),
                      named(slope)};
    recipe.clamp = ClampOptions{scale * 10e3, scale * 60e3};
    recipe.gradient_limit = 0.1;
    check_count(recipe, expected);
  }
}

TEST_CASE("the computed Rossby radius agrees with one from another equation of state") {
  const std::string path = data_folder() + "rossby_radius_levitus94_1deg.nc";
  const std::string levitus = kFerret + "levitus_climatology.cdf";
  if (!has_file(path) || !has_file(levitus)) return;
  parallel::Executor exec(2);
  RasterRequest request;
  request.variable = "TEMP";
  const RasterStack temperature = read_raster_stack(levitus, request);
  request.variable = "SALT";
  const RasterStack salinity = read_raster_stack(levitus, request);
  LatLonField ours = make_table(kRadPerDeg), theirs = ours;
  sample(exec, rossby_radius(exec, temperature, salinity), ours);
  sample(exec, *read(path, "rossby_radius"), theirs);
  std::vector<double> ratios;
  for (std::size_t k = 0; k < ours.values.size(); ++k) {
    if (theirs.values[k] > 2e3 && std::isfinite(ours.values[k])) {
      ratios.push_back(ours.values[k] / theirs.values[k]);
    }
  }
  REQUIRE(ratios.size() > 30000);
  std::sort(ratios.begin(), ratios.end());
  const double median = ratios[ratios.size() / 2];
  const double low = ratios[ratios.size() / 20], high = ratios[ratios.size() * 19 / 20];
  MESSAGE("median ratio " << median << ", 5 % " << low << ", 95 % " << high);
  CHECK(std::abs(median - 1.0) < 0.04);
  CHECK(low > 0.9);
  CHECK(high < 1.1);
}
