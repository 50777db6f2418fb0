// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/rebuild.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "adapt/budget.hpp"
#include "core/error.hpp"

namespace delos {
namespace {

/// What the budget promises of the finished grid, and how near a forecast must come to be tried.
constexpr double kBudgetTolerance = 0.01, kForecastTolerance = 0.001;
/// Meshes made for one width of the region: one or two for a large grid. A grid of some hundred
/// cells answers to its spacing with steps of a few per cent.
constexpr int kMeshRounds = 10;
/// Steps of the recipe's scale, by forecasts alone.
constexpr int kRecipeRounds = 12;
/// Of the spacing of what is made anew: a step that neither quality nor the policy's tau notices.
constexpr double kMostLocalScale = 1.05;
/// Cells got for a cell asked of the recipe, where the last two steps say something else.
constexpr double kLeastSlope = 0.1, kMostSlope = 2.0;
/// Eddies are everywhere: one ring around what is off at first, and steps that a gradient limit
/// would allow. Rings are added as long as the certificate is missed.
constexpr int kPassingRings = 1, kMostPassingRings = 3;
constexpr double kPassingStep = 1.1;
/// Up to this share of the vertices the others are kept; a model loses less than by a whole remap.
constexpr double kMostAnew = 0.8;
/// No recipe can be asked for less.
constexpr double kFewestCells = 12.0;

ReportSection remesh_section(const RemeshReport& report) {
  return {"remesh",
          {{"kind", std::string(to_string(report.kind))},
           {"reason", report.reason},
           {"n_wanted", report.n_wanted},
           {"n_held", report.n_held},
           {"n_regions", report.n_regions},
           {"n_kept", report.n_kept},
           {"n_moved", report.n_moved},
           {"n_removed", report.n_removed},
           {"n_inserted", report.n_inserted},
           {"changed_area", report.changed_area}}};
}

/// What a forecast has to come to for the mesh to have so many cells, by the meshes made so far.
class Aim {
 public:
  explicit Aim(double cells) : cells_(cells), now_(cells), below_(0.0), above_(4.0 * cells) {}
  double now() const { return now_; }
  void learn(double count) {
    ++n_tries_;
    const double missing = cells_ - count;
    if (n_tries_ == 1 || std::abs(missing) < std::abs(least_missing_)) {
      least_missing_ = missing;
      nearest_ = now_;
    }
    (missing > 0.0 ? below_ : above_) = now_;
    now_ += missing;
    if (now_ > below_ && now_ < above_ && above_ - below_ > kJump * cells_) return;
    now_ = 0.5 * (below_ + above_);
    if (above_ - below_ > kJump * cells_) return;
    // The count jumps between the two: other aims near the best one so far, on both sides in turn.
    const int n_steps = n_tries_ / 2 + 1;
    const double step = 0.5 * kJump * cells_ * n_steps;
    now_ = nearest_ + (n_tries_ % 2 == 0 ? step : -step);
  }

 private:
  /// A bracket this narrow, as a share of the cells, has a jump of the count in it.
  static constexpr double kJump = 0.01;
  double cells_, now_;
  double below_, above_;  ///< aims that gave too few and too many cells
  double nearest_ = 0.0, least_missing_ = 0.0;
  int n_tries_ = 0;
};

class Rebuild {
 public:
  Rebuild(Context& context, const RebuildInput& input, Sized& sized)
      : context_(context),
        old_(input.old),
        whole_(input.whole),
        settings_(input.old.settings),
        recipe_(input.recipe),
        cells_(static_cast<double>(input.cells)),
        is_fixed_(input.is_fixed),
        sized_(sized) {
    options_.refine = settings_.refine;
    options_.relax = settings_.relax;
  }

  Mesh run() {
    for (const double tolerance : widths()) {
      set_tolerance(tolerance);
      const SpacingField wanted = sized_.field;
      const RemeshPlan plan = plan_remesh(context_, input(), options_);
      if (cells_ == 0.0) return follow_wanted(plan, wanted);
      follow(plan, wanted);
      if (plan.kind == RemeshKind::full || tolerance == 1.0) break;
      if (scale_where_anew(plan) && is_certified()) return std::move(mesh_);
      set_spacing(wanted);
    }
    scale_recipe();
    return std::move(mesh_);
  }
  const RemeshReport& report() const { return report_; }

 private:
  RemeshInput input() const { return {settings_.surface, sized_.field, old_.mesh, is_fixed_}; }
  bool meets(double count, double tolerance) const {
    return std::abs(count - cells_) <= tolerance * cells_;
  }
  std::array<double, 4> widths() const;
  void set_tolerance(double tolerance);
  void set_meeting();
  void set_spacing(const SpacingField& field);
  bool is_certified() const { return report_.n_obtuse == 0 && report_.n_short == 0; }
  void follow(const RemeshPlan& plan, const SpacingField& wanted);
  Mesh follow_wanted(RemeshPlan plan, const SpacingField& wanted);
  bool make(const RemeshPlan& plan);
  bool scale_where_anew(const RemeshPlan& plan);
  void scale_recipe();
  RemeshPlan follow_recipe(double aim);
  [[noreturn]] void give_up(double count) const;

  Context& context_;
  const Product& old_;
  const Grid& whole_;
  const Settings& settings_;
  SpacingRecipe recipe_;
  double cells_;
  const std::vector<char>& is_fixed_;
  Sized& sized_;
  RemeshOptions options_;
  RemeshReport report_;
  Mesh mesh_;  ///< the last one made
};

/// From which ratio of old and new spacing on a vertex is made anew, step by step. Square roots are
/// the same to the last bit everywhere.
std::array<double, 4> Rebuild::widths() const {
  const double tau = settings_.remesh->policy.tau, root = std::sqrt(tau);
  return {tau, root, std::sqrt(root), 1.0};
}

void Rebuild::set_tolerance(double tolerance) {
  options_.region.tolerance = tolerance;
  if (tolerance == 1.0) return set_meeting();
  options_.region.passes = true;
  options_.region.blend = std::min(kPassingStep, tolerance);
  options_.region.rings = kPassingRings;
  options_.full_share = kMostAnew;
}

/// The mesh is made anew until the wanted spacing meets that of the old one.
void Rebuild::set_meeting() {
  const RemeshOptions usual;
  options_.full_share = usual.full_share;
  options_.region.passes = usual.region.passes;
  options_.region.rings = usual.region.rings;
  options_.region.blend = std::min(usual.region.blend, options_.region.tolerance);
}

/// What is kept keeps its spacing, too, and what is made anew leads over to it.
void Rebuild::follow(const RemeshPlan& plan, const SpacingField& wanted) {
  if (plan.kind != RemeshKind::local || !options_.region.passes) return;
  set_spacing(followed_spacing(context_.exec, whole_, plan.region, old_.spacing, wanted));
}

/// Without a budget: where the mesh that is kept stands against the certificate less of it is.
Mesh Rebuild::follow_wanted(RemeshPlan plan, const SpacingField& wanted) {
  for (;;) {
    follow(plan, wanted);
    Mesh mesh = remesh(context_, input(), options_, plan, report_).mesh;
    if (!options_.region.passes || is_certified()) return mesh;
    set_spacing(wanted);
    if (++options_.region.rings > kMostPassingRings) set_meeting();
    plan = plan_remesh(context_, input(), options_);
  }
}

void Rebuild::set_spacing(const SpacingField& field) {
  sized_.field = field;
  if (sized_.table_m) sized_.table_m = field.to_table();
}

/// Whether the mesh that the plan comes to meets the budget.
bool Rebuild::make(const RemeshPlan& plan) {
  mesh_ = remesh(context_, input(), options_, plan, report_).mesh;
  context_.monitor.log(
      LogLevel::debug,
      text("remesh, ", to_string(plan.kind), ": ", mesh_.n_vertices(), " cells for a budget of ",
           cells_, ", tolerance ", options_.region.tolerance, ", ", report_.n_kept, " kept"));
  return meets(mesh_.n_vertices(), kBudgetTolerance);
}

void Rebuild::give_up(double count) const {
  const bool has_fixed = std::any_of(is_fixed_.begin(), is_fixed_.end(), [](char c) { return c; });
  throw Error(ErrorKind::config,
              text("cell budget ", cells_, ": the nearest count reached is ", std::round(count),
                   has_fixed ? "; the fixed regions stand against it, make them smaller"
                             : "; the clamp or the gradient limit stands against it, widen them"));
}

/// The spacing of what the plan makes anew is changed, and of nothing else: the count follows.
/// False when more than kMostLocalScale would be needed; the spacing is then as before.
bool Rebuild::scale_where_anew(const RemeshPlan& plan) {
  const SpacingField wanted = sized_.field;
  CountForecast forecast(context_.exec, input(), plan);
  LatLonField share;
  Aim aim(cells_);
  for (int round = 0; round < kMeshRounds; ++round) {
    if (round > 0 || !meets(forecast.at(1.0), kForecastTolerance)) {
      if (share.values.empty()) {
        share = share_made_anew(context_.exec, whole_, plan.region, wanted);
        forecast.restrict_to(settings_.surface, wanted, share);
      }
      const std::optional<double> factor = forecast.factor_for(aim.now(), kMostLocalScale);
      if (!factor) break;
      set_spacing(scaled_where_anew(context_.exec, settings_.surface, wanted, share, *factor));
    }
    if (make(plan)) return true;
    aim.learn(mesh_.n_vertices());
  }
  set_spacing(wanted);
  return false;
}

/// Steps the recipe's own budget until the forecast of all that differs comes to `aim`.
RemeshPlan Rebuild::follow_recipe(double aim) {
  double slope = 1.0, last_asked = 0.0, last_count = 0.0, count = 0.0;
  for (int round = 0; round < kRecipeRounds; ++round) {
    RemeshPlan plan = plan_remesh(context_, input(), options_);
    count = CountForecast(context_.exec, input(), plan).at(1.0);
    if (std::abs(count / aim - 1.0) <= kForecastTolerance) return plan;
    const auto asked = static_cast<double>(recipe_.cells);
    if (round > 0 && asked != last_asked) {
      slope = std::clamp((count - last_count) / (asked - last_asked), kLeastSlope, kMostSlope);
    }
    last_asked = asked;
    last_count = count;
    const double next = std::round(asked + (aim - count) / slope);
    if (next == asked || next < kFewestCells) break;
    recipe_.cells = static_cast<std::int64_t>(next);
    try {
      sized_ = size(context_, settings_, recipe_);
    } catch (const Error& error) {
      // The recipe can't be scaled so far.
      if (error.kind() == ErrorKind::config) break;
      throw;
    }
  }
  give_up(count);
}

/// All that differs is made anew, for a spacing that the whole recipe is scaled to.
void Rebuild::scale_recipe() {
  set_meeting();
  Aim aim(cells_);
  for (int round = 0; round < kMeshRounds; ++round) {
    if (make(follow_recipe(aim.now()))) return;
    aim.learn(mesh_.n_vertices());
  }
  give_up(mesh_.n_vertices());
}

}  // namespace

Mesh rebuild_mesh(Context& context, const RebuildInput& input, Sized& sized,
                  std::vector<ReportSection>& sections) {
  Rebuild rebuild(context, input, sized);
  Mesh mesh = rebuild.run();
  const RemeshReport& report = rebuild.report();
  sections.push_back(remesh_section(report));
  context.monitor.log(LogLevel::info,
                      text("remesh, ", to_string(report.kind), ": ", report.reason));
  return mesh;
}

}  // namespace delos
