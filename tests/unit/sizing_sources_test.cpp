// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/sources.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/elementary.hpp"
#include "sizing/nodes.hpp"
#include "support/expect_error.hpp"

using namespace delos;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);

template <class Source>
SpacingSource named(Source source, const char* name = "sizing.sources[0]") {
  SpacingSource result;
  result.name = name;
  result.source = std::move(source);
  return result;
}

/// 2-degree cells; elevation -4000 m, and a continent of +500 m from 0 to 60 east, 30 S to 30 N.
std::shared_ptr<const Raster> box_continent() {
  auto raster = std::make_shared<Raster>();
  raster->source = "made:elevation";
  raster->periodic = true;
  for (int j = 0; j < 90; ++j) raster->lat_deg.push_back(-89.0 + 2.0 * j);
  for (int i = 0; i < 180; ++i) raster->lon_deg.push_back(1.0 + 2.0 * i);
  for (const double lat : raster->lat_deg) {
    for (const double lon : raster->lon_deg) {
      raster->values.push_back(lon < 60.0 && std::abs(lat) < 30.0 ? 4000.0 : -4000.0);
    }
  }
  return raster;
}

double value_at(const LatLonField& field, double lon_deg, double lat_deg) {
  const auto row = static_cast<Index>(std::lround((lat_deg + 90.0) / 180.0 * field.n_lat_cells));
  const auto column = static_cast<Index>(std::lround((lon_deg + 180.0) / 360.0 * field.n_lon));
  return field.values[field.at(row, column % field.n_lon)];
}

struct Bench {
  parallel::Executor exec{2};
  Monitor monitor;
  Context context{exec, monitor};
};

}  // namespace

TEST_CASE("sources combine by min, max and blend, then clamp") {
  Bench bench;
  SpacingRecipe recipe;
  recipe.sources = {named(ConstantSource{60e3}),
                    named(LatitudeProfileSource{{-90, 90}, {30e3, 90e3}})};
  const auto at = [&](double lat) {
    return value_at(build_spacing_table(bench.context, kEarth, recipe), 0.0, lat);
  };
  CHECK(at(-45) == doctest::Approx(45e3));
  CHECK(at(45) == doctest::Approx(60e3));
  recipe.combine.rule = CombineRule::max;
  CHECK(at(-45) == doctest::Approx(60e3));
  recipe.combine = {CombineRule::blend, {1.0, 3.0}};
  CHECK(at(45) == doctest::Approx(0.25 * 60e3 + 0.75 * 75e3));
  recipe.clamp = ClampOptions{50e3, 70e3};
  CHECK(at(45) == doctest::Approx(70e3));
  recipe.combine.weights = {1.0};
  testing::expect_error(ErrorKind::config, {"1 weights for 2 sources"}, [&] { at(0); });
}

TEST_CASE("constants need no table, with or without a budget") {
  Bench bench;
  SpacingRecipe recipe;
  recipe.sources = {named(ConstantSource{60e3}), named(ConstantSource{90e3})};
  SpacingField field = build_spacing(bench.context, kEarth, recipe);
  CHECK(field.is_constant());
  CHECK(field.min() * kEarth.scale_m() == doctest::Approx(60e3));
  recipe.cells = 10000;
  field = build_spacing(bench.context, kEarth, recipe);
  CHECK(field.is_constant());
  CHECK(expected_vertices(bench.exec, kEarth, field) == doctest::Approx(10000).epsilon(1e-9));
  recipe.clamp = ClampOptions{10e3, 100e3};
  testing::expect_error(ErrorKind::config, {"10000", "clamp"},
                        [&] { build_spacing(bench.context, kEarth, recipe); });
}

TEST_CASE("land has its own spacing before the limit, so the sea is graded towards it") {
  Bench bench;
  SpacingRecipe recipe;
  recipe.sources = {named(ConstantSource{60e3})};
  recipe.elevation_m = box_continent();
  recipe.land_spacing_m = 240e3;
  recipe.gradient_limit = 0.15;
  const LatLonField field = build_spacing_table(bench.context, kEarth, recipe);
  CHECK(value_at(field, -90, 0) == doctest::Approx(60e3));
  CHECK(value_at(field, 30, 0) == doctest::Approx(240e3));
  // Two degrees inland, two and a half from the last node at sea.
  CHECK(value_at(field, 2, 0) ==
        doctest::Approx(60e3 + 0.15 * 2.5 * kEarth.scale_m() * kRadPerDeg).epsilon(1e-3));
  recipe.elevation_m = nullptr;
  testing::expect_error(ErrorKind::config, {"land spacing", "bathymetry"},
                        [&] { build_spacing_table(bench.context, kEarth, recipe); });
}

TEST_CASE("the coast's spacing grows with the great-circle distance from it") {
  Bench bench;
  SpacingRecipe recipe;
  recipe.sources = {named(CoastSource{15e3, 0.1, 400e3, nullptr})};
  recipe.elevation_m = box_continent();
  recipe.resolution_rad = kRadPerDeg;
  const LatLonField field = build_spacing_table(bench.context, kEarth, recipe);
  const double per_degree = kEarth.scale_m() * kRadPerDeg;
  // The coast lies at 0 and 60 east and at 30 N: halfway between cells of opposite elevation.
  CHECK(value_at(field, -10, 0) == doctest::Approx(15e3 + 0.1 * 10 * per_degree).epsilon(0.01));
  CHECK(value_at(field, 80, 0) == doctest::Approx(15e3 + 0.1 * 20 * per_degree).epsilon(0.01));
  CHECK(value_at(field, 30, 50) == doctest::Approx(15e3 + 0.1 * 20 * per_degree).epsilon(0.01));
  CHECK(value_at(field, -170, 80) == doctest::Approx(400e3));
  CHECK(value_at(field, 30, 90) == doctest::Approx(400e3));
}

TEST_CASE("slope and tidal spacings have their formulas") {
  Bench bench;
  auto ramp = std::make_shared<Raster>(*box_continent());
  for (std::size_t j = 0; j < ramp->n_lat(); ++j) {
    for (std::size_t i = 0; i < ramp->n_lon(); ++i) {
      ramp->values[j * ramp->n_lon() + i] = -3000.0 + 20.0 * ramp->lat_deg[j];
    }
  }
  SpacingRecipe recipe;
  recipe.elevation_m = ramp;
  recipe.resolution_rad = kRadPerDeg;
  SlopeSource slope;
  slope.max_m = 1e9;
  recipe.sources = {named(slope)};
  const double gradient = 20.0 / (kEarth.scale_m() * kRadPerDeg);
  CHECK(value_at(build_spacing_table(bench.context, kEarth, recipe), 33, 10) ==
        doctest::Approx(2.0 * kPi * 2800.0 / (20.0 * gradient)).epsilon(1e-4));
  recipe.sources = {named(TidalSource{44712.0, 100.0, 10.0})};
  CHECK(value_at(build_spacing_table(bench.context, kEarth, recipe), 33, 10) ==
        doctest::Approx(447.12 * std::sqrt(9.80665 * 2800.0)).epsilon(1e-9));
}

TEST_CASE("eddy spacing is linear in the amplitude, or two-valued, and quiet where missing") {
  EddySource source;
  const auto at_speed = [&](double u) { return eddy_spacing_m(source, 0.5 * u * u); };
  CHECK(at_speed(0.01) == doctest::Approx(60e3));
  CHECK(at_speed(0.25) == doctest::Approx(35e3));
  CHECK(at_speed(0.9) == doctest::Approx(10e3));
  CHECK(eddy_spacing_m(source, std::nan("")) == doctest::Approx(60e3));
  source.form = EddyThreshold{0.2, 60e3, 15e3};
  CHECK(at_speed(0.199) == doctest::Approx(60e3));
  CHECK(at_speed(0.201) == doctest::Approx(15e3));
  source.quantity = EddyQuantity::height_variance;
  CHECK(eddy_spacing_m(source, 0.19 * 0.19) == doctest::Approx(60e3));
  CHECK(eddy_spacing_m(source, 0.21 * 0.21) == doctest::Approx(15e3));
  source.quantity = EddyQuantity::amplitude;
  CHECK(eddy_spacing_m(source, 0.19) == doctest::Approx(60e3));
  CHECK(eddy_spacing_m(source, 0.21) == doctest::Approx(15e3));
  CHECK(eddy_spacing_m(source, std::nan("")) == doctest::Approx(60e3));
}

TEST_CASE("a budget scales the spacing until the count is met") {
  Bench bench;
  SpacingRecipe recipe;
  DiscSource disc;
  disc.radius_rad = 0.3;
  disc.edge = {30e3, 150e3, 0.1, Transition::smooth};
  recipe.sources = {named(disc)};
  recipe.gradient_limit = 0.1;
  for (const std::int64_t cells : {5000, 40000, 1000000}) {
    recipe.cells = cells;
    const SpacingField field = build_spacing(bench.context, kEarth, recipe);
    CHECK(expected_vertices(bench.exec, kEarth, field) ==
          doctest::Approx(static_cast<double>(cells)).epsilon(1e-3));
  }
  recipe.clamp = ClampOptions{30e3, 150e3};
  recipe.cells = 10;
  testing::expect_error(ErrorKind::config, {"cell budget", "clamp"},
                        [&] { build_spacing(bench.context, kEarth, recipe); });
}

TEST_CASE("a source without usable values is an error with its name and a place") {
  Bench bench;
  SpacingRecipe recipe;
  auto raster = std::make_shared<Raster>(*box_continent());
  recipe.sources = {named(RasterSource{raster, 1.0, std::nullopt}, "sizing.sources[0] (h.nc)")};
  testing::expect_error(ErrorKind::input, {"h.nc", "-4000", "lon", "lat", "> 0"},
                        [&] { build_spacing_table(bench.context, kEarth, recipe); });
  for (double& value : raster->values) value = std::numeric_limits<double>::quiet_NaN();
  testing::expect_error(ErrorKind::input, {"h.nc", "no valid value"},
                        [&] { build_spacing_table(bench.context, kEarth, recipe); });
}

TEST_CASE("the default resolution is that of the finest grid in use") {
  SpacingRecipe recipe;
  recipe.sources = {named(ConstantSource{60e3})};
  recipe.elevation_m = box_continent();
  CHECK(default_resolution_rad(kEarth, recipe) == doctest::Approx(0.5 * kRadPerDeg));
  auto fine = std::make_shared<Raster>();
  for (int k = 0; k < 11; ++k) fine->lat_deg.push_back(0.25 * k);
  fine->lon_deg = fine->lat_deg;
  fine->values.assign(121, 1.0);
  recipe.sources.push_back(named(RasterSource{fine, 1.0, std::nullopt}));
  CHECK(default_resolution_rad(kEarth, recipe) == doctest::Approx(0.25 * kRadPerDeg));
  recipe.clamp = ClampOptions{100e3, 240e3};
  CHECK(default_resolution_rad(kEarth, recipe) == doctest::Approx(50e3 / 6371220.0));
}
