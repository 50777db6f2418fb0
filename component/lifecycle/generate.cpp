// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/generate.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "dual/build.hpp"
#include "dual/digest.hpp"
#include "lifecycle/baselines.hpp"
#include "lifecycle/culled.hpp"
#include "lifecycle/edge_spacing.hpp"
#include "lifecycle/estimate.hpp"
#include "lifecycle/inputs.hpp"
#include "lifecycle/mesh_order.hpp"
#include "lifecycle/outline.hpp"
#include "lifecycle/region.hpp"
#include "lifecycle/require.hpp"
#include "lifecycle/version.hpp"
#include "metrics/certificate.hpp"
#include "metrics/kept_lines.hpp"
#include "refine/refine.hpp"
#include "relax/relax.hpp"
#include "sizing/gradient_limit.hpp"
#include "sizing/sources.hpp"

namespace delos {
namespace {

void check_cost(Context& context, const Settings& settings, double n_cells,
                const GenerateScope& scope) {
  DELOS_CHECK(std::isfinite(n_cells), ErrorKind::input, "the spacing is so large or small that ",
              "its cells can't be counted (", n_cells, "). Check the units of `sizing` and ",
              "`surface`.");
  // A unit that is off by a thousand, say: nothing but the seeds would come out.
  DELOS_CHECK(n_cells >= 1.0 || settings.generator != Generator::frontal, ErrorKind::input,
              "the spacing asks for ", n_cells, " cells on a body of radius ",
              settings.surface.scale_m() / 1000.0,
              " km, less than one. Check the units of `sizing` and `surface`.");
  if (scope.with_dual) check_partitions(settings.output.partitions, n_cells);
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
           {"centroidal_rounds", static_cast<std::int64_t>(report.centroidal_rounds)},
           {"polish_rounds", static_cast<std::int64_t>(report.polish_rounds)},
           {"n_flips", report.n_flips},
           {"n_removed", report.n_removed},
           {"n_inserted", report.n_inserted},
           {"n_below_target", report.n_below_target}}};
}

/// Places in degrees, the first few of many.
std::string places(const Settings& settings, const std::vector<Vec3>& points) {
  constexpr std::size_t kMost = 20;
  std::string out;
  for (std::size_t i = 0; i < std::min(points.size(), kMost); ++i) {
    const LonLat at = settings.surface.lon_lat(points[i], settings.latitude);
    out += text(out.empty() ? "" : "; ", at.lon_rad * kDegPerRad, ", ", at.lat_rad * kDegPerRad);
  }
  return points.size() > kMost ? out + "; ..." : out;
}

/// What the lines became, and what of the certificate is missed beside them.
ReportSection lines_section(Context& context, const Settings& settings, const SpacingField& spacing,
                            const Mesh& mesh, const RefineReport& refined) {
  const KeptLines kept = measure_lines(context.exec, spacing, mesh);
  DELOS_CHECK(kept.n_edges_kept == kept.n_edges, ErrorKind::internal, "the grid kept ",
              kept.n_edges_kept, " of ", kept.n_edges, " edges of the given lines.");
  std::vector<Vec3> missed, sharp;
  std::int64_t n_obtuse = 0, n_short = 0;
  for (const KeptLines::Missed& triangle : kept.missed) {
    missed.push_back(settings.surface.project(triangle.place));
    n_obtuse += triangle.is_obtuse ? 1 : 0;
    n_short += triangle.is_short ? 1 : 0;
  }
  for (const RefineReport::SharpCorner& corner : refined.sharp_corners) {
    sharp.push_back(corner.place);
  }
  if (!missed.empty()) {
    context.monitor.log(
        LogLevel::warning,
        text(missed.size(), " triangles beside the lines of `constraints` miss the ",
             "certificate, at lon, lat: ", places(settings, missed)));
  }
  return {"constraints",
          {{"n_points", refined.n_given_points},
           {"n_crossings", refined.n_crossings},
           {"n_vertices", kept.n_vertices},
           {"n_edges", kept.n_edges},
           {"n_angles_below_60_deg", static_cast<std::int64_t>(sharp.size())},
           {"places_below_60_deg", places(settings, sharp)},
           {"n_missed", static_cast<std::int64_t>(missed.size())},
           {"n_obtuse", n_obtuse},
           {"n_short", n_short},
           {"places_missed", places(settings, missed)}}};
}

Mesh triangulate(Context& context, const Settings& settings, const SpacingField& spacing,
                 std::vector<ReportSection>& sections) {
  if (settings.generator != Generator::frontal) {
    const Phase phase(context.monitor, "refine",
                      baseline_vertices(settings.generator, settings.subdivisions));
    Mesh mesh =
        build_baseline(context, settings.generator, settings.surface, settings.subdivisions);
    context.monitor.advance(mesh.n_vertices());
    spacing.evaluate(context.exec, mesh.vertices);
    if (settings.relax.centroidal_rounds > 0) {
      sections.push_back(
          relax_section(relax(context, settings.surface, spacing, settings.relax, mesh)));
    }
    return mesh;
  }
  RefineReport refined;
  Mesh mesh = refine(context, settings.surface, spacing, settings.refine, refined);
  sections.push_back(refine_section(refined));
  context.monitor.check_cancelled();
  sections.push_back(
      relax_section(relax(context, settings.surface, spacing, settings.relax, mesh)));
  if (!settings.constraints.empty()) {
    sections.push_back(lines_section(context, settings, spacing, mesh, refined));
  }
  return mesh;
}

/// What lies between the points at which the front looks up the spacing, it can't see.
void check_count(const Settings& settings, const Mesh& mesh, double expected) {
  constexpr double kLeastShare = 0.8;  // smooth spacings come within 3 %
  constexpr double kFew = 50.0;        // cells: where so few are wanted a share says nothing
  if (settings.generator != Generator::frontal) return;
  DELOS_CHECK(mesh.n_vertices() >= kLeastShare * expected - kFew, ErrorKind::input, "the grid has ",
              mesh.n_vertices(), " cells where the spacing asks for about ", std::round(expected),
              ": patches of fine spacing lie between coarser cells and were not seen. Limit the "
              "gradient (sizing.gradient_limit, 0.1 to 0.3 are usual), or smooth the spacing.");
}

void describe_inputs(const Settings& settings, const Inputs& inputs, Report& report) {
  for (const InputRecord& file : inputs.files) report.inputs.push_back({file.path, file.sha256});
  ReportSection section{"config", {{"text", settings.text}}};
  if (!inputs.bathymetry.empty()) section.values.emplace_back("bathymetry", inputs.bathymetry);
  for (const std::string& name : inputs.left_out) section.values.emplace_back("left_out", name);
  report.sections.push_back(std::move(section));
}

/// Where domain and layers come from: the inputs, or what was made of them before.
struct DomainSource {
  const Inputs* inputs = nullptr;
  std::vector<Index> cells;
  std::vector<std::int32_t> rings;
  std::vector<double> layer_heights;
};

void build_layers(Context& context, Product& product, const DomainSource& source) {
  const Settings& settings = product.settings;
  if (!settings.layers) return;
  product.layers =
      source.inputs != nullptr
          ? make_layers(context, settings,
                        {*product.grid, *source.inputs->elevation_m, settings.domain.has_value()},
                        product.report)
          : restored_layers(*settings.layers, source.layer_heights);
}

void build_partitions(Context& context, Product& product) {
  product.partitions = make_partitions(context, *product.grid, product.settings.output.partitions,
                                       cell_weights(product.layers));
  for (const GridPartition& partition : product.partitions) {
    product.report.partitions.push_back(report_entry(partition));
  }
}

/// To the region, the sea, or the sea of the region.
DomainIds cull(Context& context, const Inputs& inputs, Product& product) {
  const Settings& settings = product.settings;
  Grid& grid = *product.grid;
  if (settings.region) {
    const bool is_aligned = settings.constraints.empty();  // else the lines are others
    mark_region(context, {settings, inputs, is_aligned ? &product.mesh.fixed : nullptr}, grid);
  }
  DomainIds ids = settings.domain ? cull_to_domain(context, settings, inputs, grid, product.report)
                                  : cull_to_region(context, grid);
  if (settings.region) {
    tell_of_region(context, settings, grid, product.mesh.n_vertices(), product.report);
  }
  return ids;
}

void build_dual(Context& context, Product& product, const DomainSource& source) {
  const Ellipsoid& surface = product.settings.surface;
  {
    const Phase phase(context.monitor, "dual", product.mesh.n_vertices());
    product.grid = build_grid(context, surface, product.settings.latitude, product.mesh);
    product.grid->edge_spacing_m = spacing_at_edges(
        context.exec, {surface, product.spacing, product.mesh.vertices},
        product.grid->cells_on_edge, [&](const Vec3&) { return surface.scale_m(); });
  }
  if (product.settings.domain || product.settings.region) {
    product.domain = source.inputs != nullptr ? cull(context, *source.inputs, product)
                                              : cull_to_cells(context, source.cells, *product.grid);
    if (source.inputs == nullptr) {
      product.grid->cell_ring.assign(source.rings.begin(), source.rings.end());
    }
  }
}

/// A culled grid is what the user gets, so it is what is measured.
void measure_part(Context& context, Product& product) {
  const Phase phase(context.monitor, "quality", product.grid->n_cells());
  product.report.quality = measure_culled(context, *product.grid);
  product.report.n_cells_made = product.mesh.n_vertices();
}

/// After the other sections, since it is made anew at a restart.
void add_digest(Context& context, Product& product) {
  const Phase phase(context.monitor, "digest", product.grid->n_cells());
  product.report.sections.push_back({"dual", {{"digest", digest(context.exec, *product.grid)}}});
}

FileNotes file_notes(const Product& product, const std::string& command) {
  FileNotes notes;
  notes.digest = product.report.digest;
  for (const ReportInput& file : product.report.inputs) {
    notes.inputs.push_back({file.path, file.sha256});
  }
  notes.command = command;
  notes.certificate = certificate(product.report.quality);
  notes.report_text = report_text(product.report);
  notes.report_json = report_json(product.report);
  return notes;
}

/// Where the report of a grid that is not written went, as a sentence.
std::string rejected_report(const Product& product, const std::string& directory) {
  const OutputSettings& output = product.settings.output;
  if (directory.empty() || !output.report) return " No grid was written.";
  try {
    const std::string path = write_rejected_report(output, file_notes(product, ""), directory);
    return " No grid was written; its report is " + path + ".";
  } catch (const Error& error) {
    // What the user must know first is what the grid misses.
    return text(" No grid was written, nor its report: ", error.what());
  }
}

void judge(Context& context, Product& product, const std::string& directory) {
  Report& report = product.report;
  report.missed = missed_requirements(product.settings.require.bounds, report.quality);
  if (report.missed.empty()) return;
  const std::string missed = missed_message("the grid", product.settings, report.missed);
  if (product.settings.require.keep) {
    context.monitor.log(LogLevel::warning, missed);
    return;
  }
  report.phases = context.monitor.phases();
  throw Error(ErrorKind::quality, missed + rejected_report(product, directory));
}

/// Those of the configuration; without any, the region's outline.
std::vector<GivenLine> lines_to_keep(const Context& context, const Settings& settings,
                                     const Inputs& inputs, const SpacingField& spacing) {
  const bool is_free = settings.generator == Generator::frontal && settings.constraints.empty();
  if (!settings.region || !settings.region->align || !is_free) return inputs.lines;
  Outline outline = outline_of(settings.surface, settings.latitude, *inputs.region, spacing);
  if (!outline.refusal.empty()) {
    context.monitor.log(LogLevel::warning,
                        text("the grid can't follow the outline of the region: ", outline.refusal,
                             ". Its rings follow the cells with their centres in it."));
  }
  return std::move(outline.rings);
}

Product begin(const Context& context, const Settings& settings) {
  Product product;
  product.settings = settings;
  product.report.title = settings.title.empty() ? settings.output.name : settings.title;
  product.report.version = library_version();
  product.report.surface = settings.surface;
  product.report.n_threads = context.exec.n_threads();
  return product;
}

/// What follows from mesh and spacing.
void finish(Context& context, Product& product, const GenerateScope& scope,
            const DomainSource& source) {
  Report& report = product.report;
  report.digest = digest(product.mesh);
  const Settings& settings = product.settings;
  const bool is_part = settings.domain || settings.region;
  if (!is_part) {
    const Phase phase(context.monitor, "quality", product.mesh.n_vertices());
    report.quality = measure_quality(context, settings.surface, product.spacing, product.mesh,
                                     settings.latitude);
    judge(context, product, scope.directory);
  }
  if (scope.with_dual || is_part || settings.layers) {
    build_dual(context, product, source);
    if (is_part) {
      measure_part(context, product);
      judge(context, product, scope.directory);
    }
    build_layers(context, product, source);
    add_digest(context, product);
    if (scope.with_dual) build_partitions(context, product);
  }
  report.phases = context.monitor.phases();
}

}  // namespace

OutputContent output_content(const Product& product, const std::string& command) {
  return {product.settings,
          product.mesh,
          product.grid ? &*product.grid : nullptr,
          product.domain ? &*product.domain : nullptr,
          product.spacing_table_m ? &*product.spacing_table_m : nullptr,
          product.spacing,
          file_notes(product, command),
          {},
          product.partitions,
          product.layers ? &*product.layers : nullptr};
}

Sized size(Context& context, const Settings& settings, const SpacingRecipe& recipe) {
  if (is_constant(recipe) && !settings.output.spacing) {
    const Phase phase(context.monitor, "spacing", 0);
    return {build_spacing(context, settings.surface, recipe), std::nullopt};
  }
  check_table(recipe.resolution_rad > 0.0 ? recipe.resolution_rad
                                          : default_resolution_rad(settings.surface, recipe),
              available_memory_bytes());
  LatLonField table_m = build_spacing_table(context, settings.surface, recipe);
  Sized out{is_constant(recipe)
                ? build_spacing(context, settings.surface, recipe)
                : SpacingField::table(context.exec, settings.surface, recipe.latitude, table_m),
            std::nullopt};
  if (settings.output.spacing) out.table_m = std::move(table_m);
  return out;
}

Product generate(Context& context, const Settings& settings, const GenerateScope& scope) {
  if (!scope.directory.empty()) check_output_folder(scope.directory, 0.0);
  const Inputs inputs = read_inputs(context, settings);
  return generate(context, settings, inputs, size(context, settings, inputs.recipe), scope);
}

Product generate(Context& context, const Settings& given, const Inputs& inputs, Sized sized,
                 const GenerateScope& scope) {
  Product product = begin(context, given);
  product.settings.refine.lines = lines_to_keep(context, given, inputs, sized.field);
  const Settings& settings = product.settings;
  Report& report = product.report;
  describe_inputs(settings, inputs, report);
  product.elevation_m = inputs.elevation_m;
  report.expected_vertices = expected_vertices(context.exec, settings.surface, sized.field);
  check_cost(context, settings, report.expected_vertices, scope);

  if (scope.make_mesh) {
    product.mesh = scope.make_mesh(context, sized, report.sections);
    report.expected_vertices = expected_vertices(context.exec, settings.surface, sized.field);
  } else {
    product.mesh = triangulate(context, settings, sized.field, report.sections);
    check_count(settings, product.mesh, report.expected_vertices);
    if (settings.domain && settings.domain->fits_coast) {
      fit_mesh_to_coast(context, settings, inputs, product.mesh, report);
      sized.field.evaluate(context.exec, product.mesh.vertices);
    }
  }
  order_mesh(context, settings, product.mesh, report);
  product.spacing_table_m = std::move(sized.table_m);
  product.spacing = std::move(sized.field);
  finish(context, product, scope, {&inputs, {}, {}, {}});
  return product;
}

Product resume(Context& context, const Settings& settings, SavedProduct saved) {
  Product product = begin(context, settings);
  add_report_notes(saved.report_notes, product.report);
  product.report.expected_vertices =
      expected_vertices(context.exec, settings.surface, saved.spacing);
  product.mesh = std::move(saved.mesh);
  product.spacing_table_m = std::move(saved.spacing_table_m);
  product.spacing = std::move(saved.spacing);
  finish(context, product, {},
         {nullptr, std::move(saved.domain_cells), std::move(saved.rings),
          std::move(saved.layer_heights)});
  return product;
}

}  // namespace delos
