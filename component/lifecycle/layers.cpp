// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/layers.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "domain/bathymetry.hpp"
#include "domain/cell_means.hpp"

namespace delos {
namespace {

std::vector<std::uint8_t> sea_cells(const domain::CellMeans& means, double least_wet,
                                    bool is_sea_only) {
  std::vector<std::uint8_t> out(means.wet_fraction.size(), 1);
  if (is_sea_only) return out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = means.wet_depth_m[i] > 0.0 && means.wet_fraction[i] >= least_wet;
  }
  return out;
}

double share(double part, double whole) { return whole > 0.0 ? part / whole : 0.0; }

ReportSection section_of(const domain::Stack& stack, const domain::BathymetryReport& depth,
                         const domain::StackReport& report) {
  return {"layers",
          {{"kind", std::string("z_level")},
           {"levels", stack.levels.n_levels()},
           {"depth_m", stack.levels.depth_m()},
           {"n_wet", report.n_wet},
           {"mean_levels",
            share(static_cast<double>(report.n_layers), static_cast<double>(report.n_wet))},
           {"n_full_bottoms", report.n_full},
           {"min_bottom_layer_m", report.min_bottom_layer_m},
           {"volume_m3", report.volume_m3},
           {"elevation_volume_m3", depth.wet_volume_m3},
           {"volume_ratio", share(report.volume_m3, depth.wet_volume_m3)},
           {"n_deepened", depth.n_deepened},
           {"n_cut", depth.n_cut},
           {"r_factor_before", depth.r_factor_before},
           {"r_factor", depth.r_factor},
           {"n_smoothed", depth.n_smoothed},
           {"smoothing_rounds", static_cast<std::int64_t>(depth.rounds)}}};
}

ReportSection section_of(const domain::TerrainLayers& layers, const domain::TerrainReport& report) {
  return {"layers",
          {{"kind", std::string("terrain_following")},
           {"levels", layers.n_levels()},
           {"top_m", layers.zeta_m.back()},
           {"ground_max_m", report.ground_max_m},
           {"ground_volume_m3", report.ground_volume_m3},
           {"thinnest", report.thinnest},
           {"thinnest_layer_m", report.thinnest_layer_m}}};
}

domain::Stack make_ocean(Context& context, const LayerSettings& settings,
                         const LayerSources& sources, const domain::CellMeans& means,
                         Report& report) {
  const domain::ShapedDepth shaped = domain::shape_bathymetry(
      context, sources.grid, means, sea_cells(means, settings.least_wet, sources.is_sea_only),
      settings.bathymetry);
  const domain::BathymetryReport& depth = shaped.report;
  if (settings.bathymetry.max_r_factor > 0.0 && depth.r_factor > settings.bathymetry.max_r_factor) {
    context.monitor.log(
        LogLevel::warning,
        text("the r-factor of the sea floor is ", depth.r_factor, " after ", depth.rounds,
             " rounds, above layers.r_factor = ", settings.bathymetry.max_r_factor, "."));
  }
  domain::Stack stack =
      domain::build_stack(context, settings.levels, shaped.depth_m, settings.stack);
  report.sections.push_back(
      section_of(stack, depth, domain::measure_stack(context, sources.grid, stack)));
  return stack;
}

}  // namespace

Layers make_layers(Context& context, const Settings& settings, const LayerSources& sources,
                   Report& report) {
  const Grid& grid = sources.grid;
  const Phase phase(context.monitor, "layers", grid.n_cells());
  const LayerSettings& wanted = *settings.layers;
  const bool is_ocean = wanted.kind == LayerKind::z_level;
  const double sea_level_m =
      is_ocean && settings.domain ? settings.domain->options.sea_level_m : 0.0;
  const domain::CellMeans means =
      domain::mean_over_cells(context, grid, sources.elevation_m, sea_level_m);
  Layers out;
  if (is_ocean) {
    out.ocean = make_ocean(context, wanted, sources, means, report);
  } else {
    out.terrain = domain::build_terrain_layers(context, grid, domain::ground_of(context, means),
                                               wanted.terrain);
    report.sections.push_back(
        section_of(*out.terrain, domain::measure_terrain(context, grid, *out.terrain)));
  }
  return out;
}

std::span<const double> saved_heights(const Layers& layers) {
  return layers.ocean ? layers.ocean->bottom_depth_m : layers.terrain->ground_m;
}

Layers restored_layers(const LayerSettings& settings, std::span<const double> saved) {
  Array<double> heights;
  heights.assign(saved.begin(), saved.end());
  Layers out;
  if (settings.kind == LayerKind::z_level) {
    out.ocean = domain::stack_above(settings.levels, std::move(heights));
  } else {
    out.terrain = domain::terrain_over(std::move(heights), settings.terrain);
  }
  return out;
}

std::vector<double> cell_weights(const std::optional<Layers>& layers) {
  if (!layers || !layers->ocean) return {};
  const Array<Index>& n_layers = layers->ocean->n_layers;
  return {n_layers.begin(), n_layers.end()};
}

}  // namespace delos
