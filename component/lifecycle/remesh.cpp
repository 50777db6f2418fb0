// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/remesh.hpp"

#include <exception>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "lifecycle/inputs.hpp"
#include "lifecycle/rebuild.hpp"
#include "remap/transfer.hpp"
#include "time/iso8601.hpp"

namespace delos {
namespace {

/// The recipe of now, and its spacing.
struct Wanted {
  Inputs inputs;  ///< with the sources from the solution
  Sized sized;
  double n_expected = 0.0;
};

const RemeshSettings& settings_of(const Product& product) { return *product.settings.remesh; }

std::int64_t budget_of(const Settings& settings) {
  return settings.remesh->cells > 0 ? settings.remesh->cells : settings.sizing.recipe.cells;
}

Wanted wanted_now(Context& context, const Product& old, WholeGrid& whole, Remesh& remesh) {
  Wanted out;
  const Settings& settings = old.settings;
  // After a restart nothing has been read yet.
  if (!remesh.inputs) remesh.keep(read_inputs(context, settings), settings);
  out.inputs = *remesh.inputs;
  SpacingRecipe& recipe = out.inputs.recipe;
  for (SpacingSource& source : remesh.solution.sources(context.exec, whole)) {
    recipe.sources.push_back(std::move(source));
  }
  if (const std::int64_t cells = budget_of(settings); cells > 0) {
    recipe.cells = corrected_budget(cells, old.mesh.n_vertices(), old.report.expected_vertices);
  }
  out.sized = size(context, settings, recipe);
  out.n_expected = expected_vertices(context.exec, settings.surface, out.sized.field);
  return out;
}

Mismatch mismatch_of(Context& context, const Product& product, const Inputs& inputs,
                     const SpacingField& wanted) {
  const Grid& grid = *product.grid;
  return mismatch(context.exec, grid, wanted_at_cells(context.exec, grid, wanted),
                  settings_of(product).policy.tau,
                  in_fixed_regions(context.exec, inputs.fixed, grid.cell_lon_lat));
}

/// The statistics on the new grid. What begins anew, or is on the host's table, needs no transfer.
Solution moved(Context& context, const Solution& solution, const Product& old, WholeGrid& whole,
               const Product& product) {
  WholeGrid new_whole(context, product);
  std::optional<Phase> phase;
  std::optional<remap::Transfer> transfer;
  const remap::TransferOptions options{remap::Order::first, remap::Limiter::none};
  Solution out = solution;
  out.move(context.exec, *old.grid, *product.grid,
           [&](std::span<const double> from, std::span<double> to) {
             if (!transfer) {
               // Both are phases, and phases do not nest.
               const Grid &before = whole.grid(), &after = new_whole.grid();
               phase.emplace(context.monitor, "transfer", after.n_cells());
               transfer.emplace(context, remap::Tiling::cells(context.exec, before),
                                remap::Tiling::cells(context.exec, after), remap::Order::first);
             }
             if (!whole.is_culled()) return transfer->apply(context.exec, from, to, options);
             // A cell that was land has neighbours that were sea.
             Array<double> all(at(new_whole.grid().n_cells()));
             transfer->apply(context.exec, whole.flooded(from), all, options);
             new_whole.pick(all, to);
           });
  return out;
}

/// The old grid made to fit.
std::shared_ptr<const Product> rebuilt(Context& context, const Product& old, WholeGrid& whole,
                                       Wanted wanted) {
  const std::vector<char> is_fixed =
      in_fixed_regions(context.exec, wanted.inputs.fixed, whole.grid().cell_lon_lat);
  GenerateScope scope;
  scope.make_mesh = [&](Context& inner, Sized& sized, std::vector<ReportSection>& sections) {
    const RebuildInput input{old, whole.grid(), wanted.inputs.recipe, is_fixed,
                             budget_of(old.settings)};
    return rebuild_mesh(inner, input, sized, sections);
  };
  return std::make_shared<const Product>(
      generate(context, old.settings, wanted.inputs, std::move(wanted.sized), scope));
}

}  // namespace

void Remesh::keep(Inputs read, const Settings& settings) {
  if (!settings.remesh->with_static) read.recipe.sources.clear();
  inputs = std::move(read);
}

RemeshOutcome try_remesh(Context& context, const Product& old, const Time& now, Remesh& remesh) {
  RemeshOutcome out;
  PolicyInput input{now, true, remesh.solution.is_ready(), {}, 0.0};
  try {
    WholeGrid whole(context, old);
    std::optional<Wanted> wanted;
    if (input.has_statistics) {
      wanted = wanted_now(context, old, whole, remesh);
      input.mismatch = mismatch_of(context, old, wanted->inputs, wanted->sized.field);
      input.expected_cells = wanted->n_expected;
    }
    out.decision = decide(settings_of(old).policy, input, remesh.policy);
    context.monitor.log(LogLevel::info, out.decision.text);
    if (!out.decision.remesh) return out;
    std::shared_ptr<const Product> product = rebuilt(context, old, whole, std::move(*wanted));
    out.solution = moved(context, remesh.solution, old, whole, *product);
    const PolicyOptions& policy = settings_of(old).policy;
    out.has_followed = mismatch_of(context, *product, *remesh.inputs, product->spacing).total() <=
                       policy.threshold * (1.0 - policy.hysteresis);
    out.product = std::move(product);
  } catch (const std::exception& error) {
    out.failure = text("the remesh at ", iso_text(now), " failed, the grid stays: ", error.what());
    context.monitor.log(LogLevel::warning, out.failure);
  }
  return out;
}

}  // namespace delos
