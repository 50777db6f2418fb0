// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/remesh.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "lifecycle/inputs.hpp"
#include "remap/transfer.hpp"
#include "time/iso8601.hpp"

namespace delos {
namespace {

/// What the budget promises of the finished grid.
constexpr double kBudgetTolerance = 0.01;
/// Tries to keep it, and the least share of a change that the grid is taken to answer with.
constexpr int kBudgetRounds = 6;
constexpr double kLeastSlope = 0.3;

/// The recipe of now, and its spacing.
struct Wanted {
  Inputs inputs;
  Sized sized;
  double n_expected = 0.0;
};

const RemeshSettings& settings_of(const Product& product) { return *product.settings.remesh; }

std::int64_t budget_of(const Settings& settings) {
  return settings.remesh->cells > 0 ? settings.remesh->cells : settings.sizing.recipe.cells;
}

Wanted wanted_now(Context& context, const Product& old, const Solution& solution) {
  Wanted out;
  const Settings& settings = old.settings;
  out.inputs = read_inputs(context, settings);
  SpacingRecipe& recipe = out.inputs.recipe;
  if (!settings.remesh->with_static) recipe.sources.clear();
  for (SpacingSource& source : solution.sources(context.exec, *old.grid)) {
    recipe.sources.push_back(std::move(source));
  }
  if (const std::int64_t cells = budget_of(settings); cells > 0) {
    recipe.cells = corrected_budget(cells, old.mesh.n_vertices(), old.report.expected_vertices);
  }
  out.sized = size(context, settings, recipe);
  out.n_expected = expected_vertices(context.exec, settings.surface, out.sized.field);
  return out;
}

Mismatch mismatch_of(Context& context, const Product& product, const SpacingField& wanted) {
  const RemeshSettings& settings = settings_of(product);
  const Grid& grid = *product.grid;
  return mismatch(context.exec, grid, wanted_at_cells(context.exec, grid, wanted),
                  settings.policy.tau,
                  in_fixed_regions(context.exec, settings.fixed, grid.cell_lon_lat));
}

/// The statistics on the new grid.
Solution moved(Context& context, const Solution& solution, const Product& old,
               const Product& product) {
  const Phase phase(context.monitor, "transfer", product.grid->n_cells());
  const remap::Transfer transfer(context, remap::Tiling::cells(context.exec, *old.grid),
                                 remap::Tiling::cells(context.exec, *product.grid),
                                 remap::Order::first);
  const remap::TransferOptions options{remap::Order::first, remap::Limiter::none};
  Solution out = solution;
  out.move(context.exec, *old.grid, *product.grid,
           [&](std::span<const double> from, std::span<double> to) {
             transfer.apply(context.exec, from, to, options);
           });
  return out;
}

/// How far the count is from the budget, as a share of it; 0 without one.
double off_budget(const Product& product) {
  const auto cells = static_cast<double>(budget_of(product.settings));
  return cells > 0.0 ? std::abs(static_cast<double>(product.mesh.n_vertices()) / cells - 1.0) : 0.0;
}

/// The old grid made to fit. What is kept of it does not answer to the scale, so the budget may
/// take several tries; the nearest counts.
std::shared_ptr<const Product> rebuilt(Context& context, const Product& old, Wanted wanted) {
  const RemeshSettings& settings = settings_of(old);
  const OldMeshScope from{old.mesh, settings.policy.tau,
                          in_fixed_regions(context.exec, settings.fixed, old.grid->cell_lon_lat)};
  GenerateScope scope;
  scope.old = &from;
  std::shared_ptr<const Product> best;
  double slope = 1.0, last_asked = 0.0, last_n = 0.0;
  for (int round = 0; round < kBudgetRounds; ++round) {
    auto product = std::make_shared<const Product>(
        generate(context, old.settings, wanted.inputs, wanted.sized, scope));
    const auto n = static_cast<double>(product->mesh.n_vertices());
    if (!best || off_budget(*product) < off_budget(*best)) best = std::move(product);
    if (off_budget(*best) <= kBudgetTolerance) return best;
    SpacingRecipe& recipe = wanted.inputs.recipe;
    const auto asked = static_cast<double>(recipe.cells);
    // Cells got for a cell asked: by the last two tries, at first 1; bounded where these are noise.
    if (round > 0 && asked != last_asked) {
      slope = std::clamp((n - last_n) / (asked - last_asked), kLeastSlope, 1.0);
    }
    last_asked = asked;
    last_n = n;
    const double missing = static_cast<double>(budget_of(old.settings)) - n;
    recipe.cells = static_cast<std::int64_t>(std::round(asked + missing / slope));
    wanted.sized = size(context, old.settings, recipe);
  }
  context.monitor.log(
      LogLevel::warning,
      text("the remeshed grid has ", best->mesh.n_vertices(), " cells, the budget is ",
           budget_of(old.settings), ": more than 1 % off, since too much of the old grid is kept"));
  return best;
}

}  // namespace

RemeshOutcome try_remesh(Context& context, const Product& old, const Time& now, Remesh& remesh) {
  RemeshOutcome out;
  PolicyInput input{now, true, remesh.solution.is_ready(), {}, 0.0};
  try {
    std::optional<Wanted> wanted;
    if (input.has_statistics) {
      wanted = wanted_now(context, old, remesh.solution);
      input.mismatch = mismatch_of(context, old, wanted->sized.field);
      input.expected_cells = wanted->n_expected;
    }
    out.decision = decide(settings_of(old).policy, input, remesh.policy);
    context.monitor.log(LogLevel::info, out.decision.text);
    if (!out.decision.remesh) return out;
    std::shared_ptr<const Product> product = rebuilt(context, old, std::move(*wanted));
    out.solution = moved(context, remesh.solution, old, *product);
    const PolicyOptions& policy = settings_of(old).policy;
    out.has_followed = mismatch_of(context, *product, product->spacing).total() <=
                       policy.threshold * (1.0 - policy.hysteresis);
    out.product = std::move(product);
  } catch (const std::exception& error) {
    out.failure = text("the remesh at ", iso_text(now), " failed, the grid stays: ", error.what());
    context.monitor.log(LogLevel::warning, out.failure);
  }
  return out;
}

}  // namespace delos
