// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/sources.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "sizing/nodes.hpp"

namespace delos {
namespace {

constexpr double kCoarsestDefault = 0.5 * kRadPerDeg;
constexpr double kFinestDefault = kRadPerDeg / 12.0;
/// The budget is met to 0.1 %; the iteration aims at half of it.
constexpr double kBudgetTolerance = 0.5e-3;
constexpr int kBudgetRounds = 60;
constexpr double kLargestScale = 1.0e4;
/// Cells of a region a step of its table: rings around it are not much wider than they need to be.
constexpr double kCellsPerRegionStep = 4.0;

template <class... Bodies>
struct Overloaded : Bodies... {
  using Bodies::operator()...;
};
template <class... Bodies>
Overloaded(Bodies...) -> Overloaded<Bodies...>;

bool needs_elevation(const SpacingSource& source) {
  if (const auto* coast = std::get_if<CoastSource>(&source.source)) return !coast->land;
  return std::holds_alternative<SlopeSource>(source.source) ||
         std::holds_alternative<TidalSource>(source.source);
}

/// Where a formula tells; else more than any table's step.
double least_spacing_m(const SpacingSource& source) {
  const auto of_edge = [](const RegionEdge& edge) {
    return std::min(edge.spacing_m, edge.outside_m);
  };
  return std::visit(Overloaded{[](const ConstantSource& s) { return s.spacing_m; },
                               [](const LatitudeProfileSource& s) {
                                 double least = std::numeric_limits<double>::max();
                                 for (const double h : s.spacing_m) least = std::min(least, h);
                                 return least;
                               },
                               [&](const DiscSource& s) { return of_edge(s.edge); },
                               [&](const BoxSource& s) { return of_edge(s.edge); },
                               [&](const PolygonSource& s) { return of_edge(s.edge); },
                               [](const CoastSource& s) { return s.spacing_m; },
                               [](const auto&) { return std::numeric_limits<double>::max(); }},
                    source.source);
}

const Raster* gridded(const SpacingSource& source) {
  return std::visit(Overloaded{[](const RasterSource& s) { return s.raster.get(); },
                               [](const EddySource& s) { return s.field.get(); },
                               [](const RossbySource& s) -> const Raster* {
                                 if (s.radius_m) return s.radius_m.get();
                                 const RasterStack* stack = s.temperature_degc.get();
                                 return stack && !stack->levels.empty() ? &stack->levels[0]
                                                                        : nullptr;
                               },
                               [](const auto&) -> const Raster* { return nullptr; }},
                    source.source);
}

void check_recipe(const SpacingRecipe& recipe) {
  check(recipe.combine, recipe.sources.size());
  if (recipe.region) check_region(*recipe.region);
  if (recipe.clamp) check(*recipe.clamp);
  for (const SpacingSource& source : recipe.sources) {
    DELOS_CHECK(!needs_elevation(source) || recipe.elevation_m, ErrorKind::config, source.name,
                ": needs a bathymetry; give `bathymetry:`");
  }
  DELOS_CHECK(!recipe.land_spacing_m || recipe.elevation_m, ErrorKind::config,
              "land spacing: needs a bathymetry to know where land is; give `bathymetry:`");
  const double land = recipe.land_spacing_m.value_or(1.0);
  DELOS_CHECK(std::isfinite(land) && land > 0.0, ErrorKind::config, "land spacing is ", land,
              " m: it must be finite and > 0");
  DELOS_CHECK(std::isfinite(recipe.gradient_limit) && recipe.gradient_limit >= 0.0,
              ErrorKind::config, "gradient limit is ", recipe.gradient_limit,
              ": it must be > 0, or 0 for none");
  DELOS_CHECK(recipe.cells >= 0, ErrorKind::config, "cell budget is ", recipe.cells,
              ": it must be > 0");
}

void check_values(parallel::Executor& exec, const std::string& name, const LatLonField& field) {
  const std::size_t node = first_not_positive(exec, field);
  DELOS_CHECK(node == field.values.size(), ErrorKind::input, name, ": spacing is ",
              field.values[node], " m at ", place_of(field, node),
              ": it must be finite and > 0; check the variable, its units and the value for "
              "missing data");
}

void fill_raster(parallel::Executor& exec, const RasterSource& source, LatLonField& field) {
  DELOS_CHECK(source.raster != nullptr, ErrorKind::config, "raster source has no raster");
  sample(exec, *source.raster, field);
  scale_into(exec, source.metres_per_unit, field, field);
  source.missing_m ? fill_value(exec, *source.missing_m, field)
                   : fill_nearest(exec, source.raster->source, field);
}

/// Builds the table step by step; the elevation on its nodes is made once.
class Builder {
 public:
  Builder(Context& context, const Ellipsoid& surface, const SpacingRecipe& recipe)
      : context_(context),
        exec_(context.exec),
        surface_(surface),
        recipe_(recipe),
        combined_(unset_table(recipe.resolution_rad > 0.0
                                  ? recipe.resolution_rad
                                  : default_resolution_rad(surface, recipe))) {}

  LatLonField build() {
    sample_elevation();
    combine_sources();
    smooth(exec_, recipe_.smooth_rad, combined_);
    if (recipe_.region) {
      resize_like(combined_, distance_);
      distance_to_region(exec_, *recipe_.region, distance_);
    }
    recipe_.cells > 0 ? meet_budget() : finish(1.0);
    if (recipe_.region) coarsen_outside(exec_, surface_, distance_, recipe_.outside, finished_);
    return std::move(finished_);
  }

 private:
  void sample_elevation();
  void combine_sources();
  void fill(const SpacingSource& source, LatLonField& field);
  void finish(double scale);
  void meet_budget();
  double count() const {
    const auto expected = [&](const LatLonField& field) {
      return expected_vertices(exec_, surface_,
                               SpacingField::table(exec_, surface_, recipe_.latitude, field));
    };
    if (!recipe_.region) return expected(finished_);
    LatLonField counted = finished_;
    drop_outside(exec_, surface_, distance_, recipe_.outside, counted);
    return expected(counted);
  }

  Context& context_;
  parallel::Executor& exec_;
  const Ellipsoid& surface_;
  const SpacingRecipe& recipe_;
  LatLonField combined_;
  LatLonField elevation_;
  LatLonField distance_;  // from the region (rad), when there is one
  LatLonField finished_;
};

void Builder::sample_elevation() {
  const bool is_used = recipe_.land_spacing_m ||
                       std::any_of(recipe_.sources.begin(), recipe_.sources.end(), needs_elevation);
  if (!is_used) return;
  resize_like(combined_, elevation_);
  sample(exec_, *recipe_.elevation_m, elevation_);
  fill_nearest(exec_, recipe_.elevation_m->source, elevation_);
}

void Builder::fill(const SpacingSource& source, LatLonField& field) {
  std::visit(Overloaded{
                 [&](const ConstantSource& s) { fill_constant(exec_, s, field); },
                 [&](const LatitudeProfileSource& s) { fill_latitude_profile(exec_, s, field); },
                 [&](const RasterSource& s) { fill_raster(exec_, s, field); },
                 [&](const DiscSource& s) { fill_disc(exec_, s, field); },
                 [&](const BoxSource& s) { fill_box(exec_, s, field); },
                 [&](const PolygonSource& s) { fill_polygon(exec_, s, field); },
                 [&](const SlopeSource& s) {
                   scale_into(exec_, 1.0, elevation_, field);
                   fill_slope(exec_, surface_, recipe_.latitude, s, field);
                 },
                 [&](const TidalSource& s) {
                   scale_into(exec_, 1.0, elevation_, field);
                   fill_tidal(exec_, s, field);
                 },
                 [&](const CoastSource& s) {
                   fill_coast(exec_, surface_, s, recipe_.elevation_m.get(), field);
                 },
                 [&](const RossbySource& s) { fill_rossby(exec_, s, field); },
                 [&](const EddySource& s) { fill_eddies(exec_, s, field); },
             },
             source.source);
}

void Builder::combine_sources() {
  LatLonField next;
  resize_like(combined_, next);
  for (std::size_t k = 0; k < recipe_.sources.size(); ++k) {
    const SpacingSource& source = recipe_.sources[k];
    context_.monitor.check_cancelled();
    try {
      fill(source, next);
    } catch (const Error& error) {
      throw Error(error.kind(), text(source.name, ": ", error.what()));
    }
    check_values(exec_, source.name, next);
    combine_into(exec_, recipe_.combine, k, next, combined_);
    context_.monitor.advance(1);
  }
}

void Builder::finish(double scale) {
  resize_like(combined_, finished_);
  scale_into(exec_, scale, combined_, finished_);
  if (recipe_.clamp) clamp(exec_, *recipe_.clamp, finished_);
  // A budget may make land finer than asked, never coarser.
  if (recipe_.land_spacing_m) {
    set_land(exec_, elevation_, *recipe_.land_spacing_m * std::min(scale, 1.0), finished_);
  }
  if (recipe_.gradient_limit > 0.0) {
    limit_gradient(context_, surface_, recipe_.latitude, recipe_.gradient_limit, finished_);
  }
}

/// The count falls with the scale, about as its inverse square: steps by that law, kept inside the
/// bracket known so far.
void Builder::meet_budget() {
  const auto wanted = static_cast<double>(recipe_.cells);
  double low = 1.0 / kLargestScale, high = kLargestScale, scale = 1.0, n = 0.0;
  for (int round = 0; round < kBudgetRounds; ++round) {
    finish(scale);
    n = count();
    if (std::abs(n / wanted - 1.0) <= kBudgetTolerance) return;
    (n > wanted ? low : high) = scale;
    const double next = scale * std::sqrt(n / wanted);
    const bool is_inside = next > low && next < high;
    // Every third step halves the bracket, so that clamps can't stall the law of the square.
    scale = is_inside && round % 3 != 2 ? next : std::sqrt(low * high);
  }
  throw Error(ErrorKind::config,
              text("cell budget ", wanted, ": the nearest count reached is ", n,
                   "; the clamp or the gradient limit stands against it, widen them"));
}

double constant_spacing_m(const SpacingRecipe& recipe) {
  parallel::Executor exec(1);
  LatLonField total = make_table(0.5 * kPi), next = total;
  for (std::size_t k = 0; k < recipe.sources.size(); ++k) {
    fill_constant(exec, std::get<ConstantSource>(recipe.sources[k].source), next);
    combine_into(exec, recipe.combine, k, next, total);
  }
  if (recipe.clamp) clamp(exec, *recipe.clamp, total);
  return total.values[0];
}

}  // namespace

double default_resolution_rad(const Ellipsoid& surface, const SpacingRecipe& recipe) {
  double finest = kCoarsestDefault;
  bool uses_elevation = recipe.land_spacing_m.has_value();
  for (const SpacingSource& source : recipe.sources) {
    if (const Raster* raster = gridded(source)) finest = std::min(finest, resolution_rad(*raster));
    if (recipe.region) {
      finest = std::min(finest, kCellsPerRegionStep * least_spacing_m(source) / surface.scale_m());
    }
    uses_elevation = uses_elevation || needs_elevation(source);
  }
  if (uses_elevation && recipe.elevation_m) {
    finest = std::min(finest, resolution_rad(*recipe.elevation_m));
  }
  const double least_m = recipe.clamp ? recipe.clamp->min_m : 0.0;
  finest = std::max(finest, 0.5 * least_m / surface.scale_m());
  return std::clamp(finest, kFinestDefault, kCoarsestDefault);
}

bool is_constant(const SpacingRecipe& recipe) {
  return !recipe.land_spacing_m && !recipe.region &&
         std::all_of(recipe.sources.begin(), recipe.sources.end(), [](const SpacingSource& source) {
           return std::holds_alternative<ConstantSource>(source.source);
         });
}

LatLonField build_spacing_table(Context& context, const Ellipsoid& surface,
                                const SpacingRecipe& recipe) {
  check_recipe(recipe);
  const Phase phase(context.monitor, "spacing", static_cast<std::int64_t>(recipe.sources.size()));
  return Builder(context, surface, recipe).build();
}

SpacingField build_spacing(Context& context, const Ellipsoid& surface,
                           const SpacingRecipe& recipe) {
  check_recipe(recipe);
  if (!is_constant(recipe)) {
    return SpacingField::table(context.exec, surface, recipe.latitude,
                               build_spacing_table(context, surface, recipe));
  }
  SpacingField field = SpacingField::constant(surface, constant_spacing_m(recipe));
  if (recipe.cells == 0) return field;
  const double n = expected_vertices(context.exec, surface, field);
  const double scale = std::sqrt(n / static_cast<double>(recipe.cells));
  const double spacing_m = field.max() * surface.scale_m() * scale;
  DELOS_CHECK(
      !recipe.clamp || (spacing_m >= recipe.clamp->min_m && spacing_m <= recipe.clamp->max_m),
      ErrorKind::config, "cell budget ", recipe.cells, " needs a spacing of ", spacing_m,
      " m, outside the clamp: widen it");
  return SpacingField::constant(surface, spacing_m);
}

}  // namespace delos
