// SPDX-License-Identifier: BSD-3-Clause
#include "domain/terrain.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/hash.hpp"
#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"

using namespace delos;
using delos::testing::expect_error;
using domain::TerrainLayers;
using domain::TerrainOptions;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);

Array<double> peaks(const Grid& grid, double highest_m) {
  Array<double> out;
  for (std::uint64_t i = 0; i < grid.cell_area_m2.size(); ++i) {
    out.push_back(std::max(0.0, highest_m * (2.0 * uniform01(4, i) - 1.0)));
  }
  return out;
}

TerrainLayers layers_of(const Grid& grid, Array<double> ground_m, const TerrainOptions& options,
                        int threads = 1) {
  parallel::Executor exec(threads);
  Monitor monitor;
  Context context{exec, monitor};
  return domain::build_terrain_layers(context, grid, std::move(ground_m), options);
}

double volume(const Grid& grid, const Array<double>& height_m) {
  double sum = 0.0;
  for (std::size_t i = 0; i < height_m.size(); ++i) sum += grid.cell_area_m2[i] * height_m[i];
  return sum;
}

}  // namespace

TEST_CASE("interfaces follow the ground below and are level above") {
  const Grid grid = samples::grid_of(kEarth, samples::shaken(kEarth, 3, 0.2, 9));
  const Array<double> ground_m = peaks(grid, 5000.0);
  TerrainOptions options;
  options.level_above_m = 20000.0;
  options.smoothing_rounds = 0;
  const TerrainLayers layers = layers_of(grid, ground_m, options);
  CHECK(layers.n_levels() == 55);
  CHECK(layers.zeta_m.front() == 0.0);
  CHECK(layers.zeta_m.back() == 30000.0);
  CHECK(layers.zeta_m[1] == doctest::Approx(30000.0 * std::pow(1.0 / 55.0, 1.5)).epsilon(1e-12));
  double thinnest = 1.0;
  for (std::int64_t i = 0; i < grid.n_cells(); ++i) {
    const double here_m = ground_m[static_cast<std::size_t>(i)];
    CHECK(layers.height_m(i, 0) == here_m);
    CHECK(layers.height_m(i, 55) == 30000.0);
    for (std::int64_t k = 0; k < 55; ++k) {
      const double zeta_m = layers.zeta_m[static_cast<std::size_t>(k)];
      const double thickness_m = layers.height_m(i, k + 1) - layers.height_m(i, k);
      const double flat_m = layers.zeta_m[static_cast<std::size_t>(k) + 1] - zeta_m;
      thinnest = std::min(thinnest, thickness_m / flat_m);
      const double decay =
          zeta_m < 20000.0 ? std::pow(std::cos(0.5 * kPi * zeta_m / 20000.0), 6) : 0.0;
      CHECK(layers.height_m(i, k) == doctest::Approx(zeta_m + decay * here_m).epsilon(1e-12));
    }
  }
  CHECK(thinnest > 0.0);
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  const auto report = domain::measure_terrain(context, grid, layers);
  CHECK(report.thinnest == doctest::Approx(thinnest).epsilon(1e-9));
  CHECK(report.ground_max_m == *std::max_element(ground_m.begin(), ground_m.end()));
  CHECK(report.ground_volume_m3 == doctest::Approx(volume(grid, ground_m)).epsilon(1e-13));
}

TEST_CASE("smoothing keeps the volume of the ground and adds no peaks, for any threads") {
  const Grid grid = samples::grid_of(kEarth, samples::shaken(kEarth, 4, 0.2, 9));
  const Array<double> ground_m = peaks(grid, 5000.0);
  TerrainOptions options;
  double highest_m = *std::max_element(ground_m.begin(), ground_m.end());
  for (const std::int64_t rounds : {1, 2, 20}) {
    options.smoothing_rounds = rounds;
    const TerrainLayers layers = layers_of(grid, ground_m, options);
    CHECK(volume(grid, layers.ground_m) == doctest::Approx(volume(grid, ground_m)).epsilon(1e-12));
    const auto [low, high] = std::minmax_element(layers.ground_m.begin(), layers.ground_m.end());
    CHECK(*low >= 0.0);
    CHECK(*high < highest_m);
    highest_m = *high;
    for (const int threads : {2, 5}) {
      CHECK(std::ranges::equal(layers_of(grid, ground_m, options, threads).ground_m,
                               layers.ground_m));
    }
  }
}

TEST_CASE("the ground is the land's part of the mean elevation") {
  domain::CellMeans means;
  //            all land  half land of 400 m, half sea of 1000 m  sea  nothing known
  means.wet_fraction = {0.0, 0.5, 1.0, 0.0};
  means.wet_depth_m = {0.0, 1000.0, 3000.0, 0.0};
  means.elevation_m = {300.0, -300.0, -3000.0, std::numeric_limits<double>::quiet_NaN()};
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  CHECK(std::ranges::equal(domain::ground_of(context, means),
                           std::vector<double>{300.0, 200.0, 0.0, 0.0}));
}

TEST_CASE("layers that would cross are refused with the height and a remedy") {
  const Grid grid = samples::grid_of(kEarth, samples::shaken(kEarth, 2, 0.1, 9));
  TerrainOptions options;
  options.level_above_m = 5000.0;
  options.smoothing_rounds = 0;
  expect_error(ErrorKind::input, {"layers cross over ground of", "layers.level_above"},
               [&] { static_cast<void>(layers_of(grid, peaks(grid, 8000.0), options)); });
  options.level_above_m = 40000.0;
  expect_error(ErrorKind::config, {"no higher than the top"},
               [&] { static_cast<void>(layers_of(grid, peaks(grid, 10.0), options)); });
  options = {};
  options.stretching = 0.5;
  expect_error(ErrorKind::config, {"the stretching >= 1"},
               [&] { static_cast<void>(layers_of(grid, peaks(grid, 10.0), options)); });
}
