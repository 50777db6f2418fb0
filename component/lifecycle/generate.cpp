// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/generate.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "dual/build.hpp"
#include "lifecycle/baselines.hpp"
#include "lifecycle/estimate.hpp"
#include "lifecycle/inputs.hpp"
#include "lifecycle/version.hpp"
#include "refine/refine.hpp"
#include "relax/relax.hpp"
#include "sizing/gradient_limit.hpp"
#include "sizing/sources.hpp"

namespace delos {
namespace {

struct Sized {
  SpacingField field;
  std::optional<LatLonField> table_m;
};

/// The spacing; its table is kept only when an output needs it.
Sized size(Context& context, const Settings& settings, const SpacingRecipe& recipe) {
  if (is_constant(recipe) && !settings.output.spacing) {
    const Phase phase(context.monitor, "spacing", 0);
    return {build_spacing(context, settings.surface, recipe), std::nullopt};
  }
  LatLonField table_m = build_spacing_table(context, settings.surface, recipe);
  Sized out{is_constant(recipe) ? build_spacing(context, settings.surface, recipe)
                                : SpacingField::table(settings.surface, recipe.latitude, table_m),
            std::nullopt};
  if (settings.output.spacing) out.table_m = std::move(table_m);
  return out;
}

void check_cost(Context& context, const Settings& settings, double n_cells,
                const GenerateScope& scope) {
  const Estimate estimate = estimate_cost(settings, n_cells, scope.with_dual);
  check_estimate(estimate, available_memory_bytes());
  if (!scope.directory.empty()) check_output_folder(scope.directory, estimate.disk_bytes);
  context.monitor.log(LogLevel::info, "expecting " + describe(estimate));
}

ReportSection refine_section(const RefineReport& report) {
  return {"refine",
          {{"n_tiles", report.n_tiles},
           {"n_skeleton_vertices", report.n_skeleton_vertices},
           {"n_inserted", report.n_inserted},
           {"n_flips", report.n_flips},
           {"n_over_size", report.n_over_size},
           {"n_over_radius_edge", report.n_over_radius_edge}}};
}

ReportSection relax_section(const RelaxReport& report) {
  return {"relax",
          {{"spring_rounds", static_cast<std::int64_t>(report.spring_rounds)},
           {"polish_rounds", static_cast<std::int64_t>(report.polish_rounds)},
           {"n_flips", report.n_flips},
           {"n_removed", report.n_removed},
           {"n_inserted", report.n_inserted},
           {"n_below_target", report.n_below_target}}};
}

Mesh triangulate(Context& context, const Settings& settings, const SpacingField& spacing,
                 std::vector<ReportSection>& sections) {
  if (settings.generator != Generator::frontal) {
    const Phase phase(context.monitor, "refine",
                      baseline_vertices(settings.generator, settings.subdivisions));
    Mesh mesh =
        build_baseline(context, settings.generator, settings.surface, settings.subdivisions);
    context.monitor.advance(mesh.n_vertices());
    spacing.evaluate(mesh.vertices);
    return mesh;
  }
  RefineReport refined;
  Mesh mesh = refine(context, settings.surface, spacing, settings.refine, refined);
  sections.push_back(refine_section(refined));
  context.monitor.check_cancelled();
  sections.push_back(
      relax_section(relax(context, settings.surface, spacing, settings.relax, mesh)));
  return mesh;
}

void describe_inputs(const Settings& settings, const Inputs& inputs, Report& report) {
  for (const InputRecord& file : inputs.files) report.inputs.push_back({file.path, file.sha256});
  ReportSection section{"config", {{"text", settings.text}}};
  if (!inputs.bathymetry.empty()) section.values.emplace_back("bathymetry", inputs.bathymetry);
  for (const std::string& name : inputs.left_out) section.values.emplace_back("left_out", name);
  report.sections.push_back(std::move(section));
}

void build_dual(Context& context, Product& product) {
  const Phase phase(context.monitor, "dual", product.mesh.n_vertices());
  product.grid =
      build_grid(context, product.settings.surface, product.settings.latitude, product.mesh);
  product.report.sections.push_back({"dual", {{"digest", digest(*product.grid)}}});
}

std::string place(const Extreme& extreme) {
  return text(extreme.value, " at ", extreme.other == kNone ? "element " : "edge of cell ",
              extreme.id, " (lon ", extreme.where.lon_rad * kDegPerRad, ", lat ",
              extreme.where.lat_rad * kDegPerRad, " deg)");
}

}  // namespace

FileNotes file_notes(const Product& product, const std::string& command) {
  FileNotes notes;
  notes.digest = product.report.digest;
  for (const ReportInput& file : product.report.inputs) {
    notes.inputs.push_back({file.path, file.sha256});
  }
  notes.command = command;
  notes.well_centred = product.report.quality.well_centred;
  notes.min_relative_edge = product.report.quality.relative_edge_min.value;
  notes.min_dual_ratio = product.report.quality.dual_ratio_min.value;
  notes.report_text = report_text(product.report);
  notes.report_json = report_json(product.report);
  return notes;
}

OutputContent output_content(const Product& product, const std::string& command) {
  return {product.settings,
          product.mesh,
          product.grid ? &*product.grid : nullptr,
          product.spacing_table_m ? &*product.spacing_table_m : nullptr,
          file_notes(product, command),
          {}};
}

void check_requirements(const RequireSettings& require, const Quality& quality) {
  std::string missed;
  if (require.well_centred && quality.n_obtuse > 0) {
    missed += text(" well_centred: ", quality.n_obtuse, " triangles are obtuse, largest angle ",
                   place(quality.angle_max_deg), ".");
  }
  if (require.max_angle_deg && quality.angle_max_deg.value > *require.max_angle_deg) {
    missed +=
        text(" max_angle ", *require.max_angle_deg, " deg: ", place(quality.angle_max_deg), ".");
  }
  if (require.min_relative_edge && quality.relative_edge_min.value < *require.min_relative_edge) {
    missed += text(" min_relative_edge ", *require.min_relative_edge, ": ",
                   place(quality.relative_edge_min), ".");
  }
  if (require.min_dual_ratio && quality.dual_ratio_min.value < *require.min_dual_ratio) {
    missed +=
        text(" min_dual_ratio ", *require.min_dual_ratio, ": ", place(quality.dual_ratio_min), ".");
  }
  DELOS_CHECK(missed.empty(), ErrorKind::quality,
              "the grid misses what `require` asks for:", missed,
              " Lower sizing.gradient_limit, raise relax.polish_rounds, or set "
              "require.keep: true to have it all the same.");
}

Product generate(Context& context, const Settings& settings, const GenerateScope& scope) {
  if (!scope.directory.empty()) check_output_folder(scope.directory, 0.0);
  Product product;
  product.settings = settings;
  Report& report = product.report;
  report.title = settings.title.empty() ? settings.output.name : settings.title;
  report.version = library_version();
  report.surface = settings.surface;
  report.n_threads = context.exec.n_threads();

  const Inputs inputs = read_inputs(context, settings);
  describe_inputs(settings, inputs, report);
  product.elevation_m = inputs.recipe.elevation_m;
  Sized sized = size(context, settings, inputs.recipe);
  report.expected_vertices = expected_vertices(context.exec, settings.surface, sized.field);
  check_cost(context, settings, report.expected_vertices, scope);

  product.mesh = triangulate(context, settings, sized.field, report.sections);
  product.spacing_table_m = std::move(sized.table_m);
  report.digest = digest(product.mesh);
  {
    const Phase phase(context.monitor, "quality", product.mesh.n_vertices());
    report.quality =
        measure_quality(context, settings.surface, sized.field, product.mesh, settings.latitude);
  }
  try {
    check_requirements(settings.require, report.quality);
  } catch (const Error& error) {
    if (!settings.require.keep) throw;
    context.monitor.log(LogLevel::warning, error.what());
  }
  if (scope.with_dual) build_dual(context, product);
  report.phases = context.monitor.phases();
  return product;
}

}  // namespace delos
