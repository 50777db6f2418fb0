// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/domain.hpp"

#include <algorithm>

#include "domain/cell_means.hpp"
#include "domain/cull.hpp"
#include "domain/fit.hpp"
#include "domain/ocean.hpp"
#include "domain/transects.hpp"

namespace delos {
namespace {

/// The table that says what is sea. Land polygons are drawn on one finer than the cells, the finest
/// of which have this spacing in radii, and than maps of the world.
LatLonField elevation_table(Context& context, const Inputs& inputs, double finest) {
  if (inputs.land == nullptr) return domain::table_of(context.exec, *inputs.elevation_m);
  constexpr double kFinest = 1.0 / 60.0, kCoarsest = 0.25;  // degrees
  const double tenth_deg = 0.1 * finest * kDegPerRad;
  return domain::elevation_of(context.exec, *inputs.land,
                              std::clamp(tenth_deg, kFinest, kCoarsest) * kRadPerDeg);
}

/// Of the table: polygons are drawn about 0.
double sea_level_m(const Settings& settings, const Inputs& inputs) {
  return inputs.land == nullptr ? settings.domain->options.sea_level_m : 0.0;
}

Array<double> wet_fraction(Context& context, const Settings& settings, const Inputs& inputs,
                           const Grid& grid) {
  const auto& lengths_m = grid.cell_distance_m;
  const double finest =
      *std::min_element(lengths_m.begin(), lengths_m.end()) / grid.surface.scale_m();
  return std::move(domain::mean_over_cells(context, grid, elevation_table(context, inputs, finest),
                                           sea_level_m(settings, inputs))
                       .wet_fraction);
}

/// Outside of a region there is no sea, and lines there are nothing to it.
void restrict_to_region(const Grid& grid, Array<double>& wet, domain::OceanOptions& options) {
  for (std::size_t cell = 0; cell < wet.size(); ++cell) {
    if (grid.cell_ring[cell] == kNone) wet[cell] = 0.0;
  }
  const auto is_outside = [&](const LonLatLine& line) {
    const std::vector<Index> cells = domain::cells_along(grid, line);
    return std::any_of(cells.begin(), cells.end(),
                       [&](Index cell) { return grid.cell_ring[at(cell)] == kNone; });
  };
  std::erase_if(options.passages, is_outside);
  std::erase_if(options.blockages, is_outside);
}

struct LineTotals {
  std::int64_t n_holding = 0, n_changed = 0, n_shared = 0;
  std::string failed;  ///< names, "; " between them
};

LineTotals totals_of(const std::vector<domain::LineReport>& lines) {
  LineTotals out;
  for (const domain::LineReport& line : lines) {
    out.n_holding += line.holds;
    out.n_changed += line.n_changed;
    out.n_shared += line.n_shared;
    if (!line.holds) out.failed += (out.failed.empty() ? "" : "; ") + line.name;
  }
  return out;
}

void warn(const Context& context, const std::vector<domain::LineReport>& lines, const char* what) {
  for (const domain::LineReport& line : lines) {
    if (line.holds) continue;
    context.monitor.log(LogLevel::warning, text("the ", what, " '", line.name, "' of ",
                                                line.n_cells, " cells does not hold."));
  }
}

ReportSection section_of(const domain::OceanReport& report) {
  const LineTotals passages = totals_of(report.passages), blockages = totals_of(report.blockages);
  return {"domain",
          {{"n_cells", report.n_cells},
           {"n_edges", report.n_edges},
           {"n_border_edges", report.n_border_edges},
           {"n_vertices", report.n_vertices},
           {"area_m2", report.area_m2},
           {"n_bodies", report.n_bodies},
           {"n_bodies_kept", report.n_bodies_kept},
           {"n_cells_of_other_bodies", report.n_cells_of_other_bodies},
           {"n_bay_cells_removed", report.pruned.n_bays},
           {"n_channel_cells_removed", report.pruned.n_channels},
           {"n_cells_given_back", report.n_cells_given_back},
           {"n_passages", static_cast<std::int64_t>(report.passages.size())},
           {"n_passages_open", passages.n_holding},
           {"n_cells_opened", passages.n_changed},
           {"passages_not_open", passages.failed},
           {"n_blockages", static_cast<std::int64_t>(report.blockages.size())},
           {"n_blockages_shut", blockages.n_holding},
           {"n_cells_shut", blockages.n_changed},
           {"n_cells_shared", blockages.n_shared},
           {"blockages_not_shut", blockages.failed}}};
}

ReportSection section_of(const domain::CoastReport& coast) {
  ReportSection section{"coast", {{"n_edges", coast.n_edges}, {"length_m", coast.length_m}}};
  if (coast.n_edges == 0) return section;
  const auto add = [&](const char* key, const ReportValue& value) {
    section.values.emplace_back(key, value);
  };
  const auto add_corner = [&](const std::string& name, const domain::Corner& corner) {
    section.values.emplace_back(name + "_deg", corner.angle_deg);
    section.values.emplace_back(name + "_lon_deg", corner.where.lon_rad * kDegPerRad);
    section.values.emplace_back(name + "_lat_deg", corner.where.lat_rad * kDegPerRad);
  };
  add("line_m", coast.line_m);
  add("length_over_line", coast.length_m / coast.line_m);
  add("offset_m", coast.offset_m);
  add("mean_turn_deg", coast.mean_turn_deg);
  add("step_m", coast.step_m);
  add("stair_share", coast.stair_share);
  add("n_sea_tips", coast.n_sea_tips);
  add("n_land_tips", coast.n_land_tips);
  add_corner("sharpest_sea", coast.sharpest_sea);
  add_corner("sharpest_land", coast.sharpest_land);
  return section;
}

}  // namespace

void fit_mesh_to_coast(Context& context, const Settings& settings, const Inputs& inputs, Mesh& mesh,
                       Report& report) {
  const Phase phase(context.monitor, "fit_coast", mesh.n_vertices());
  const auto finest =
      std::min_element(mesh.vertices.begin(), mesh.vertices.end(),
                       [](const Vertex& a, const Vertex& b) { return a.spacing < b.spacing; });
  const LatLonField elevation_m = elevation_table(context, inputs, finest->spacing);
  const domain::FitReport fit = domain::fit_to_coast(
      context,
      {elevation_m, sea_level_m(settings, inputs), settings.domain->options.least_wet,
       settings.domain->options.tip_margin},
      {settings.surface, settings.latitude}, mesh);
  context.monitor.log(
      LogLevel::info,
      text("coast: ", fit.n_moved, " vertices moved, ", fit.misplaced_before_m2 * 1e-12,
           " million km2 on its wrong side before, ", fit.misplaced_after_m2 * 1e-12, " after"));
  report.sections.push_back({"fit_coast",
                             {{"n_moved", fit.n_moved},
                              {"misplaced_before_m2", fit.misplaced_before_m2},
                              {"misplaced_after_m2", fit.misplaced_after_m2}}});
}

DomainIds cull_to_domain(Context& context, const Settings& settings, const Inputs& inputs,
                         Grid& grid, Report& report) {
  const Phase phase(context.monitor, "domain", grid.n_cells());
  domain::OceanOptions options = settings.domain->options;
  options.passages = inputs.passages;
  options.blockages = inputs.blockages;
  const std::int64_t n_before = grid.n_cells();
  Array<double> wet = wet_fraction(context, settings, inputs, grid);
  if (!grid.cell_ring.empty()) restrict_to_region(grid, wet, options);
  domain::Ocean ocean = domain::select_ocean(context.exec, grid, wet, options);
  warn(context, ocean.report.passages, "passage");
  warn(context, ocean.report.blockages, "blockage");
  context.monitor.log(LogLevel::info,
                      text("domain: ", ocean.report.n_cells, " of ", n_before, " cells, ",
                           ocean.report.area_m2 * 1e-12, " million km2, ",
                           ocean.report.n_bodies_kept, " of ", ocean.report.n_bodies, " bodies"));
  report.sections.push_back(section_of(ocean.report));
  if (settings.domain->fits_coast) {
    report.sections.back().values.emplace_back("n_tips_cleared", ocean.report.n_tips_cleared);
  }
  report.sections.push_back(section_of(ocean.report.coast));
  grid = std::move(ocean.culled.grid);
  return {std::move(ocean.culled.old_cell), std::move(ocean.culled.old_vertex)};
}

DomainIds cull_to_cells(Context& context, std::span<const Index> cells, Grid& grid) {
  const Phase phase(context.monitor, "domain", grid.n_cells());
  domain::Culled culled = domain::cull(context.exec, grid, cells);
  grid = std::move(culled.grid);
  return {std::move(culled.old_cell), std::move(culled.old_vertex)};
}

}  // namespace delos
