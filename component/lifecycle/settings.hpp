// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a configuration asks for, checked and in SI units. No file is opened here: fields that
// files hold are named as requests, which inputs.hpp answers.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "geometry/ellipsoid.hpp"
#include "io/geojson.hpp"
#include "lifecycle/file_kind.hpp"
#include "lifecycle/file_request.hpp"
#include "lifecycle/partitions.hpp"
#include "lifecycle/settings_domain.hpp"
#include "lifecycle/settings_layers.hpp"
#include "lifecycle/settings_region.hpp"
#include "lifecycle/settings_remesh.hpp"
#include "lifecycle/settings_tree.hpp"
#include "metrics/requirements.hpp"
#include "refine/refine.hpp"
#include "relax/relax.hpp"
#include "sizing/sources.hpp"

namespace delos {

enum class Generator { frontal, icosahedral, cubed_sphere };

/// A source without its data, and the data it needs. Which of the requests are used follows from
/// the kind of source.
struct SourceSettings {
  SpacingSource source;
  bool optional = false;  ///< left out, with a line in the log, when a file of it is missing
  FileRequest field;      ///< raster, rossby (radius), eke, ssh_variability
  FileRequest temperature, salinity;  ///< rossby computed from a climatology
  FileRequest polygons;               ///< polygon, coast
  std::string polygon_name;           ///< feature to take; empty: all
};

struct BathymetrySettings {
  FileRequest field;            ///< file "auto": ETOPO5 of ferret-datasets, else the embedded one
  bool sea_is_negative = true;  ///< else the values are depths, positive down
};

struct SizingSettings {
  SpacingRecipe recipe;  ///< all but `sources` and `elevation_m`
  std::vector<SourceSettings> sources;
  BathymetrySettings bathymetry;
  bool needs_bathymetry = false;
};

/// Points and lines that become vertices and edges of the grid.
struct ConstraintSettings {
  std::vector<FileRequest> files;   ///< GeoJSON
  std::vector<LineFeature> shapes;  ///< written out in the configuration
  bool empty() const { return files.empty() && shapes.empty(); }
};

struct OutputSettings {
  std::string directory;
  std::string name;  ///< files are called <name>.<kind>.nc
  bool mpas = false, ugrid_triangles = false, ugrid_cells = false;
  std::vector<FileKind> more;  ///< other kinds of grid files
  bool graph = false, report = false, spacing = false;
  PartitionWishes partitions;
  CellOrderSettings order;            ///< of a grid of the whole surface
  std::vector<std::string> pictures;  ///< of globe, map, histograms
  LonLat view{0.0, 0.0};              ///< centre of the globe picture
  bool has_view = false;              ///< it was asked for
  double view_radius_deg = 0.0;       ///< > 0: globe and map show this disc around it close up
  bool unit_sphere = false;           ///< MPAS on the unit sphere
  bool compress = false;              ///< netCDF-4 with deflate where a reader may meet it

  /// Whether any output needs the dual.
  bool needs_dual() const {
    return mpas || ugrid_cells || graph || !partitions.n_parts.empty() || !pictures.empty() ||
           std::any_of(more.begin(), more.end(), holds_cells);
  }
};

/// What the finished grid must meet. Nothing is required by default.
struct RequireSettings {
  Requirements bounds;
  bool keep = false;  ///< write a grid that misses them all the same, with a warning
};

struct Settings {
  std::string title;
  std::string folder;                  ///< of the configuration; file names are relative to it
  std::vector<std::string> data_path;  ///< where else to look
  std::string shape;                   ///< sphere, wgs84, ellipsoid
  Ellipsoid surface;
  LatitudeKind latitude = LatitudeKind::geodetic;
  Generator generator = Generator::frontal;
  std::int64_t subdivisions = 0;  ///< of the baseline generators
  SizingSettings sizing;
  ConstraintSettings constraints;
  RefineOptions refine;  ///< all but `lines`
  RelaxOptions relax;
  OutputSettings output;
  RequireSettings require;
  std::optional<DomainSettings> domain;  ///< without it the grid covers the whole surface
  std::optional<RegionSettings> region;  ///< without it the grid covers the whole surface
  std::optional<LayerSettings> layers;   ///< without it the grid has no vertical
  std::optional<RemeshSettings> remesh;  ///< without it the grid stays
  int threads = 0;
  /// The effective configuration (defaults and overrides included) as YAML, without `threads` and
  /// the output's folder: what the grid depends on.
  std::string text;
};

/// Error(config) "file:line key.path: ..." for anything wrong. `folder` is what relative file names
/// are relative to.
Settings read_settings(const ConfigNode& root, const std::string& folder);

}  // namespace delos
