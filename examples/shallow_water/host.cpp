// SPDX-License-Identifier: BSD-3-Clause
#include "host.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shallow_water {
namespace {

constexpr double kHour_s = 3600.0;
constexpr int kRehearsal_h = 24;  // of the component before the start: two alarms of 12 hours
constexpr char kImport[] = "remesh_indicator";

}  // namespace

std::vector<double> indicator(const Model& model) {
  const delos::Grid& grid = model.grid();
  const auto ends = grid.vertices_on_edge();
  const auto length_m = grid.vertex_distance_m();
  const auto offsets = grid.cell_offsets();
  const auto edges_on_cell = grid.edges_on_cell();
  const std::vector<double> vorticity_s = model.vertex_vorticity();
  std::vector<double> steepest(static_cast<std::size_t>(grid.n_cells()));
  for (std::size_t cell = 0; cell < steepest.size(); ++cell) {
    for (auto j = offsets[cell]; j < offsets[cell + 1]; ++j) {
      const auto edge = static_cast<std::size_t>(edges_on_cell[static_cast<std::size_t>(j)]);
      const double rise_s = vorticity_s[static_cast<std::size_t>(ends[2 * edge + 1])] -
                            vorticity_s[static_cast<std::size_t>(ends[2 * edge])];
      // A short side between two far cells has their slope, not its own.
      const double over_m = std::max(length_m[edge], 0.5 * grid.cell_distance_m()[edge]);
      steepest[cell] = std::max(steepest[cell], std::fabs(rise_s) / over_m);
    }
  }
  CompensatedSum squares, area_m2;
  for (std::size_t cell = 0; cell < steepest.size(); ++cell) {
    squares.add(grid.cell_area_m2()[cell] * steepest[cell] * steepest[cell]);
    area_m2.add(grid.cell_area_m2()[cell]);
  }
  const double usual = std::sqrt(squares.value() / area_m2.value());
  for (double& slope : steepest) slope = usual > 0.0 ? std::min(1.0, slope / usual) : 0.0;
  return steepest;
}

Host::Host(const Case& flow, const Physics& physics, const delos::Config& config, int threads)
    : case_(flow),
      physics_(physics),
      threads_(threads),
      component_(config, {.threads = threads}),
      clock_({.start = delos::Time::parse("2000-01-01"), .step = delos::TimeInterval::of_hours(1)}),
      model_(physics) {
  component_.initialize();
  begin();
  // The flow of the start asks for its own grid, where it can be made anew exactly.
  for (int hour = 0; hour < kRehearsal_h; ++hour) {
    if (run_component()) begin();
  }
}

void Host::begin() {
  Start start = case_.start(component_.grid(), physics_);
  model_.start(component_.grid(), std::move(start.ground_m), std::move(start.flow));
}

bool Host::run_component() {
  const std::int64_t generation = component_.generation();
  const delos::State imports = component_.import_state();
  if (imports.contains(kImport)) {
    delos::Field field = imports.field(kImport);
    field.store(indicator(model_));
    field.stamp(clock_.next());
  }
  component_.run(imports, component_.export_state(), clock_);
  clock_.advance();
  return component_.generation() != generation;
}

std::optional<Change> Host::advance_hour(double courant) {
  const double n = std::ceil(kHour_s / model_.step_s(courant));
  for (double step = 0.0; step < n; ++step) model_.advance(kHour_s / n);
  ++hour_;
  const delos::Grid before = model_.grid();
  if (!run_component()) return {};
  return carry(before, component_.grid());
}

// Depths as means of cells; the flow by its potentials, so that no waves are made and those that
// are there go on.
Change Host::carry(const delos::Grid& before, const delos::Grid& after) {
  Change change{
      .n_before = before.n_cells(), .n_after = after.n_cells(), .before = model_.totals()};
  const delos::Transfer transfer(before, after, {.threads = threads_});
  Flow flow;
  flow.depth_m.resize(static_cast<std::size_t>(after.n_cells()));
  flow.normal_m_s.resize(static_cast<std::size_t>(after.n_edges()));
  transfer.apply(model_.flow().depth_m, flow.depth_m);
  transfer.apply_velocity(model_.flow().normal_m_s, flow.normal_m_s,
                          delos::VelocityRoute::helmholtz);
  model_.start(after, case_.ground_m(after), std::move(flow));
  change.n_unchanged = transfer.n_unchanged();
  change.after = model_.totals();
  return change;
}

}  // namespace shallow_water
