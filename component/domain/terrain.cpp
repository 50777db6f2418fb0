// SPDX-License-Identifier: BSD-3-Clause
#include "domain/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.hpp"
#include "core/error.hpp"

namespace delos::domain {
namespace {

constexpr std::int64_t kTerrainGrain = 4096;

double power(double base, double exponent) {
  return base <= 0.0 ? 0.0 : elementary::exp(exponent * elementary::log(base));
}

double influence_at(double zeta_m, double level_above_m) {
  if (zeta_m >= level_above_m) return 0.0;
  const double cosine = elementary::cos(0.5 * kPi * zeta_m / level_above_m);
  const double square = cosine * cosine;
  return square * square * square;
}

void check(const TerrainOptions& options) {
  DELOS_CHECK(options.n_levels >= 1 && options.top_m > 0.0 && options.stretching >= 1.0,
              ErrorKind::config, options.n_levels, " levels up to ", options.top_m,
              " m, stretching ", options.stretching,
              ": there must be one level at least, the top > 0 m, the stretching >= 1.");
  DELOS_CHECK(options.level_above_m > 0.0 && options.level_above_m <= options.top_m,
              ErrorKind::config, "interfaces become level at ", options.level_above_m,
              " m: that must be above 0 m and no higher than the top, ", options.top_m, " m.");
}

/// Every pair of neighbours exchanges a share of the smaller one's area, half of a hexagon's in
/// all: no cell passes the mean of its neighbours.
void smooth(Context& context, const Grid& grid, Array<double>& ground_m) {
  constexpr double kShare = 1.0 / 12.0;
  Array<double> next(ground_m.size());
  parallel::for_index(context.exec, grid.n_cells(), kTerrainGrain, [&](std::int64_t i) {
    const double area_m2 = grid.cell_area_m2[at(i)];
    double gain_m3 = 0.0;
    for (const Index other : grid.cells_on_cell.row(i)) {
      if (other == kNone) continue;
      gain_m3 += kShare * std::min(area_m2, grid.cell_area_m2[at(other)]) *
                 (ground_m[at(other)] - ground_m[at(i)]);
    }
    next[at(i)] = ground_m[at(i)] + gain_m3 / area_m2;
  });
  ground_m = std::move(next);
}

}  // namespace

Array<double> ground_of(Context& context, const CellMeans& means) {
  Array<double> out(means.elevation_m.size());
  parallel::for_index(
      context.exec, static_cast<std::int64_t>(out.size()), kTerrainGrain, [&](std::int64_t i) {
        // Without the sea floor's part, which is below 0.
        const double land_m =
            means.elevation_m[at(i)] + means.wet_fraction[at(i)] * means.wet_depth_m[at(i)];
        out[at(i)] = land_m > 0.0 ? land_m : 0.0;  // 0 for NaN, too
      });
  return out;
}

TerrainLayers terrain_over(Array<double> ground_m, const TerrainOptions& options) {
  check(options);
  TerrainLayers out;
  for (std::int64_t k = 0; k <= options.n_levels; ++k) {
    const double x = static_cast<double>(k) / static_cast<double>(options.n_levels);
    const double zeta_m =
        k == options.n_levels ? options.top_m : options.top_m * power(x, options.stretching);
    out.zeta_m.push_back(zeta_m);
    out.influence.push_back(influence_at(zeta_m, options.level_above_m));
  }
  out.ground_m = std::move(ground_m);
  return out;
}

TerrainLayers build_terrain_layers(Context& context, const Grid& grid, Array<double> ground_m,
                                   const TerrainOptions& options) {
  for (std::int64_t round = 0; round < options.smoothing_rounds; ++round) {
    context.monitor.check_cancelled();
    smooth(context, grid, ground_m);
  }
  TerrainLayers out = terrain_over(std::move(ground_m), options);
  const TerrainReport report = measure_terrain(context, grid, out);
  DELOS_CHECK(report.thinnest > 0.0, ErrorKind::input, "layers cross over ground of ",
              report.ground_max_m, " m: let the ground be felt higher up (layers.level_above), ",
              "or smooth it more (layers.smoothing_rounds).");
  return out;
}

TerrainReport measure_terrain(Context& context, const Grid& grid, const TerrainLayers& layers) {
  TerrainReport out;
  for (const double ground_m : layers.ground_m) {
    out.ground_max_m = std::max(out.ground_max_m, ground_m);
  }
  out.ground_volume_m3 = parallel::sum(
      context.exec, grid.n_cells(), kTerrainGrain,
      [&](std::int64_t i) { return grid.cell_area_m2[at(i)] * layers.ground_m[at(i)]; });
  // The influence falls with height: layers are thinnest over the highest ground.
  out.thinnest_layer_m = std::numeric_limits<double>::infinity();
  for (std::int64_t k = 0; k < layers.n_levels(); ++k) {
    const double flat_m = layers.zeta_m[at(k + 1)] - layers.zeta_m[at(k)];
    const double loss = layers.influence[at(k)] - layers.influence[at(k + 1)];
    const double thickness_m = flat_m - loss * out.ground_max_m;
    out.thinnest = std::min(out.thinnest, thickness_m / flat_m);
    out.thinnest_layer_m = std::min(out.thinnest_layer_m, thickness_m);
  }
  return out;
}

}  // namespace delos::domain
