// SPDX-License-Identifier: BSD-3-Clause
#include "domain/bathymetry.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/hash.hpp"
#include "support/sample_grids.hpp"

using namespace delos;
using domain::BathymetryOptions;
using domain::CellMeans;
using domain::ShapedDepth;

namespace {

const Ellipsoid kEarth = Ellipsoid::sphere(6371220.0);

/// Rough: every cell has a depth of its own, 20 to 6000 m, and each tenth is land.
struct Rough {
  Grid grid = samples::grid_of(kEarth, samples::shaken(kEarth, 4, 0.2, 3));
  CellMeans means;
  std::vector<std::uint8_t> is_wet;

  Rough() {
    for (std::uint64_t i = 0; i < grid.cell_area_m2.size(); ++i) {
      const double x = uniform01(1, i);
      const bool is_land = uniform01(2, i) < 0.1;
      is_wet.push_back(is_land ? 0 : 1);
      means.wet_fraction.push_back(is_land ? 0.0 : 1.0);
      means.wet_depth_m.push_back(is_land ? 0.0 : 20.0 + 5980.0 * x * x);
      means.elevation_m.push_back(is_land ? 100.0 : -means.wet_depth_m.back());
    }
  }
  ShapedDepth shaped(const BathymetryOptions& options, int threads = 1) const {
    parallel::Executor exec(threads);
    Monitor monitor;
    Context context{exec, monitor};
    return domain::shape_bathymetry(context, grid, means, is_wet, options);
  }
};

}  // namespace

TEST_CASE("depths are kept within their bounds, and land has none") {
  const Rough rough;
  const ShapedDepth shaped = rough.shaped({50.0, 5000.0, 0.0, 0});
  std::int64_t n_deepened = 0, n_cut = 0, n_wet = 0;
  for (std::size_t i = 0; i < shaped.depth_m.size(); ++i) {
    const double there = rough.means.wet_depth_m[i];
    CHECK(shaped.depth_m[i] == (rough.is_wet[i] ? std::clamp(there, 50.0, 5000.0) : 0.0));
    n_wet += rough.is_wet[i];
    n_deepened += rough.is_wet[i] && there < 50.0;
    n_cut += there > 5000.0;
  }
  CHECK(n_deepened > 0);
  CHECK(n_cut > 0);
  CHECK(shaped.report.n_wet == n_wet);
  CHECK(shaped.report.n_deepened == n_deepened);
  CHECK(shaped.report.n_cut == n_cut);
  CHECK(shaped.report.n_smoothed == 0);
  CHECK(shaped.report.r_factor == shaped.report.r_factor_before);
}

TEST_CASE("smoothing meets the r-factor, keeps the volume and adds no extremes") {
  const Rough rough;
  const BathymetryOptions unsmoothed{50.0, 5000.0, 0.0, 0};
  const ShapedDepth before = rough.shaped(unsmoothed);
  for (const double limit : {0.9, 0.4, 0.2}) {
    CAPTURE(limit);
    BathymetryOptions options = unsmoothed;
    options.max_r_factor = limit;
    options.max_rounds = 1000;
    const ShapedDepth after = rough.shaped(options);
    CHECK(after.report.r_factor_before > limit);
    CHECK(after.report.r_factor <= limit);
    CHECK(after.report.rounds < 1000);
    CHECK(after.report.n_smoothed > 0);
    CHECK(after.report.volume_m3 == doctest::Approx(before.report.volume_m3).epsilon(1e-12));
    for (std::size_t i = 0; i < after.depth_m.size(); ++i) {
      if (!rough.is_wet[i]) continue;
      CHECK(after.depth_m[i] >= 50.0);
      CHECK(after.depth_m[i] <= 5000.0);
    }
    for (const int threads : {2, 5}) {
      CHECK(std::ranges::equal(rough.shaped(options, threads).depth_m, after.depth_m));
    }
  }
}

TEST_CASE("rounds that do not suffice show in the report") {
  const Rough rough;
  const ShapedDepth shaped = rough.shaped({50.0, 5000.0, 0.05, 2});
  CHECK(shaped.report.rounds == 2);
  CHECK(shaped.report.r_factor > 0.05);
  CHECK(shaped.report.r_factor < shaped.report.r_factor_before);
}

TEST_CASE("the volume of the elevation counts the wet part of every cell") {
  Rough rough;
  rough.means.wet_fraction[0] = 0.25;
  rough.means.wet_depth_m[0] = 1000.0;
  rough.is_wet[0] = 0;
  double expected_m3 = 0.0;
  for (std::size_t i = 0; i < rough.is_wet.size(); ++i) {
    expected_m3 +=
        rough.grid.cell_area_m2[i] * rough.means.wet_fraction[i] * rough.means.wet_depth_m[i];
  }
  const ShapedDepth shaped = rough.shaped({1.0, 1e5, 0.0, 0});
  CHECK(shaped.report.wet_volume_m3 == doctest::Approx(expected_m3).epsilon(1e-13));
  CHECK(shaped.depth_m[0] == 0.0);
}
