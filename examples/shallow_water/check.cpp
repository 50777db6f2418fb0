// SPDX-License-Identifier: BSD-3-Clause
// The test of the model, in seconds: it says what it finds, and fails where that is too much.
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "cases.hpp"
#include "host.hpp"
#include "model.hpp"
#include "norms.hpp"

namespace {

using shallow_water::Case;
using shallow_water::Model;

class Checks {
 public:
  void expect(bool holds, const char* what, double found) {
    std::printf("%s %-60s %.3e\n", holds ? "ok  " : "FAIL", what, found);
    if (!holds) ++n_failed_;
  }
  int n_failed() const { return n_failed_; }

 private:
  int n_failed_ = 0;
};

delos::Grid icosahedral(int subdivisions) {
  return delos::generate(delos::Config::from_text(
      "generator: icosahedral\nsubdivisions: " + std::to_string(subdivisions) +
      "\nrelax: {centroidal_rounds: 100}\n"));
}

// Follows the jet, with some 2500 cells, at every alarm.
constexpr char kFollowing[] = R"(
sizing:
  sources: [{type: constant, spacing: 480 km}]
  cells: 2500
remesh:
  interval: PT6H
  sources: [{type: indicator, quiet: [0.1, 900 km], energetic: [1, 250 km], fill: 0, smooth: 1 deg}]
  with_static: false
  threshold: 0.002
  hysteresis: 0
  tau: 1.05
)";

Model started(const char* name, const delos::Grid& grid, double anticipation = 0.0) {
  const shallow_water::Physics physics{.anticipation = anticipation};
  shallow_water::Start start = Case::named(name).start(grid, physics);
  Model model(physics);
  model.start(grid, std::move(start.ground_m), std::move(start.flow));
  return model;
}

void run(Model& model, double hours, double courant) {
  const double n = std::ceil(hours * 3600.0 / model.step_s(courant));
  for (double step = 0.0; step < n; ++step) model.advance(hours * 3600.0 / n);
}

double steady_error(int subdivisions) {
  Model model = started("tc2", icosahedral(subdivisions));
  const auto truth_m = model.flow().depth_m;
  run(model, 24.0, 0.7);
  return shallow_water::error_norms(model.grid(), model.flow().depth_m, truth_m).l2;
}

// The scheme keeps energy, the time step loses it with its fifth power over the time.
void check_energy(Checks& checks, const delos::Grid& grid, double anticipation) {
  double lost[2];
  for (int i = 0; i < 2; ++i) {
    Model model = started("galewsky", grid, anticipation);
    const double start = model.totals().energy;
    run(model, 12.0, i == 0 ? 0.8 : 0.4);
    lost[i] = std::fabs(model.totals().energy / start - 1.0);
  }
  checks.expect(lost[0] < 1e-7, "energy changes in half a day of the jet by", lost[0]);
  checks.expect(lost[1] < lost[0] / 6.0, "and with half the step by", lost[1]);
}

// A day on grids that change; then the steepest slopes have small cells.
void check_remeshes(Checks& checks) {
  shallow_water::Host host(Case::named("galewsky"), {.anticipation = 0.5},
                           delos::Config::from_text(kFollowing), 2);
  const double mass = host.model().totals().mass;
  int n_changes = 0;
  double lost = 0.0;
  while (host.hour() < 24) {
    const auto change = host.advance_hour(0.7);
    if (!change) continue;
    ++n_changes;
    lost = std::max(lost, std::fabs(change->after.energy / change->before.energy - 1.0));
  }
  checks.expect(n_changes >= 3, "new grids for the jet in a day", n_changes);
  checks.expect(std::fabs(host.model().totals().mass / mass - 1.0) < 1e-13,
                "they change the mass by", host.model().totals().mass / mass - 1.0);
  checks.expect(lost < 1e-4, "each changes the energy by at most", lost);
  const auto wants = shallow_water::indicator(host.model());
  const auto area_m2 = host.model().grid().cell_area_m2();
  double steep_m2 = 0.0, all_m2 = 0.0, n_steep = 0.0;
  for (std::size_t cell = 0; cell < wants.size(); ++cell) {
    all_m2 += area_m2[cell];
    if (wants[cell] < 0.6) continue;
    steep_m2 += area_m2[cell];
    ++n_steep;
  }
  const double share = steep_m2 / n_steep / (all_m2 / static_cast<double>(wants.size()));
  checks.expect(share < 0.5, "a cell's area where vorticity is steep, over the mean", share);
}

}  // namespace

int main() {
  Checks checks;
  constexpr int kCoarse = 16, kFine = 32;
  const double coarse = steady_error(kCoarse), fine = steady_error(kFine);
  const double order = std::log(coarse / fine) / std::log(1.0 * kFine / kCoarse);
  checks.expect(fine < 4.5e-5, "L2 error of steady flow after a day, 10242 cells", fine);
  checks.expect(order > 1.9, "order of convergence from 2562 to 10242 cells", order);

  const delos::Grid grid = icosahedral(16);
  Model mountain = started("tc5", grid);
  const double mass = mountain.totals().mass;
  run(mountain, 2 * 24.0, 0.7);
  const double lost = std::fabs(mountain.totals().mass / mass - 1.0);
  checks.expect(lost < 1e-14, "mass changes in two days over the mountain by", lost);
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    Model alone = started("tc5", grid);
    run(alone, 2 * 24.0, 0.7);
    const bool same = alone.flow().depth_m == mountain.flow().depth_m &&
                      alone.flow().normal_m_s == mountain.flow().normal_m_s;
    checks.expect(same, "one thread comes to the same bits (1: yes)", same ? 1.0 : 0.0);
  }
  check_energy(checks, grid, 0.0);
  check_energy(checks, grid, 0.5);
  check_remeshes(checks);
  return checks.n_failed() == 0 ? 0 : 1;
}
