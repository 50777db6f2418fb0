// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The recipe: from settings to a finished grid with its report.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "dual/grid.hpp"
#include "lifecycle/domain.hpp"
#include "lifecycle/inputs.hpp"
#include "lifecycle/layers.hpp"
#include "lifecycle/outputs.hpp"
#include "lifecycle/settings.hpp"
#include "metrics/report.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// One finished grid with all that is known about it.
struct Product {
  Settings settings;
  Mesh mesh;
  std::optional<Grid> grid;                    ///< the dual, when it was asked for
  std::optional<DomainIds> domain;             ///< when `grid` is a part of the surface
  std::optional<Layers> layers;                ///< of the grid's cells, when asked for
  SpacingField spacing;                        ///< what the grid was asked to follow
  std::optional<LatLonField> spacing_table_m;  ///< when the settings write it
  std::shared_ptr<const Raster> elevation_m;   ///< when the recipe used it
  std::vector<GridPartition> partitions;       ///< that the settings ask for, of the dual
  Report report;
};

/// A wanted spacing; its table only when the settings write it.
struct Sized {
  SpacingField field;
  std::optional<LatLonField> table_m;
};

/// Makes a mesh for the spacing in another way than from nothing; may change the spacing that the
/// grid is to follow, and tells of itself in the report.
using MakeMesh =
    std::function<Mesh(Context& context, Sized& sized, std::vector<ReportSection>& sections)>;

struct GenerateScope {
  bool with_dual = true;
  /// Where files will go: checked before the long computation. Empty: no files.
  std::string directory;
  /// In the place of refine and relax; empty: these.
  MakeMesh make_mesh = {};
};

/// Phases: read, spacing, refine, relax, polish, quality, dual and, with settings.domain or
/// settings.region, domain (then there always is a dual); quality is that of the whole
/// triangulation. The grid depends on the settings and the input files only, to the last bit.
/// Error(resource) with the estimated count and memory before anything large is allocated;
/// Error(quality) with every requirement that is missed, the value reached and the worst element's
/// id and place, unless `require.keep` is on: then the log has it as a warning. On that error no
/// grid is written, but, when scope.directory is given and settings.output.report is on, its report
/// (write_rejected_report).
Product generate(Context& context, const Settings& settings, const GenerateScope& scope);

/// Phase "spacing". Errors as build_spacing.
Sized size(Context& context, const Settings& settings, const SpacingRecipe& recipe);

/// The second half of generate(): the grid of a spacing that the recipe of `inputs` gave.
Product generate(Context& context, const Settings& settings, const Inputs& inputs, Sized sized,
                 const GenerateScope& scope);

/// What a restart file keeps of a product: all that takes long to make, or can't be made again.
struct SavedProduct {
  Mesh mesh;
  SpacingField spacing;
  std::optional<LatLonField> spacing_table_m;
  std::string report_notes;
  std::vector<Index> domain_cells;    ///< DomainIds::cells; empty: the grid covers the surface
  std::vector<std::int32_t> rings;    ///< Grid::cell_ring
  std::vector<double> layer_heights;  ///< saved_heights() of the layers, when there are any
};

/// The product that was saved, to the last bit of its arrays and its report, of which only threads
/// and phases are this call's: phases quality and dual. No input is read.
Product resume(Context& context, const Settings& settings, SavedProduct saved);

/// What goes into the product's files; refers to the product. `command` is for their history.
OutputContent output_content(const Product& product, const std::string& command);

}  // namespace delos
