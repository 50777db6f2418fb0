// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/settings_sizing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "io/names.hpp"

namespace delos {
namespace {

struct SourceReader {
  MapReader& keys;
  SourceSettings& out;
  double radius_m;
};

double spacing(MapReader& keys, const std::string& key, const char* fallback = nullptr) {
  return keys.quantity(key, Dimension::length, Bounds::positive(), fallback);
}

std::optional<std::size_t> optional_index(MapReader& keys, const std::string& key) {
  if (!keys.has(key)) return std::nullopt;
  return static_cast<std::size_t>(keys.integer(key, 0, 1'000'000'000));
}

FileRequest file_request(MapReader& keys, const std::string& file_key) {
  FileRequest request;
  request.file = keys.string(file_key, nullptr, "h.nc");
  request.where = keys.locate(file_key);
  return request;
}

/// `file`, `variable`, `time`, `level`, `units`.
FileRequest field_request(MapReader& keys, const std::string& units) {
  FileRequest request = file_request(keys, "file");
  request.raster.variable = keys.string("variable", "");
  request.raster.time_index = optional_index(keys, "time");
  request.raster.level_index = optional_index(keys, "level");
  request.raster.units = units;
  request.raster.file_units = keys.string("units", "");
  return request;
}

RegionEdge region_edge(const SourceReader& in) {
  RegionEdge edge;
  edge.spacing_m = spacing(in.keys, "spacing");
  edge.outside_m = spacing(in.keys, "outside");
  edge.width_rad = read_arc(in.keys, "width", in.radius_m, "0 deg");
  constexpr Transition kTransitions[] = {Transition::linear, Transition::smooth,
                                         Transition::gaussian};
  edge.transition =
      kTransitions[in.keys.choice("transition", {"linear", "smooth", "gaussian"}, "smooth")];
  return edge;
}

void read_constant(const SourceReader& in) {
  in.out.source.source = ConstantSource{spacing(in.keys, "spacing")};
}

void read_latitude_profile(const SourceReader& in) {
  constexpr std::size_t kMaxPoints = 100'000;
  LatitudeProfileSource source;
  source.lat_deg = in.keys.quantities("latitude", Dimension::angle, Bounds::between(-90.0, 90.0),
                                      {2, kMaxPoints});
  const std::size_t n = source.lat_deg.size();
  source.spacing_m = in.keys.quantities("spacing", Dimension::length, Bounds::positive(), {n, n});
  for (std::size_t i = 1; i < n; ++i) {
    if (source.lat_deg[i] <= source.lat_deg[i - 1]) {
      in.keys.fail("latitude", source.lat_deg[i], " deg follows ", source.lat_deg[i - 1],
                   " deg: latitudes must ascend.");
    }
  }
  source.cubic = in.keys.choice("interpolation", {"linear", "cubic"}, "linear") == 1;
  in.out.source.source = source;
}

void read_raster_source(const SourceReader& in) {
  in.out.field = field_request(in.keys, "m");
  RasterSource source;
  source.missing_m = in.keys.optional_quantity("missing", Dimension::length, Bounds::positive());
  in.out.source.source = source;
}

void read_disc(const SourceReader& in) {
  const std::vector<double> centre =
      in.keys.quantities("centre", Dimension::angle, Bounds::between(-360.0, 360.0), {2, 2});
  if (centre[1] < -90.0 || centre[1] > 90.0) {
    in.keys.fail("centre", "is [longitude, latitude]; ", centre[1], " deg is no latitude.");
  }
  DiscSource source;
  source.lon_deg = centre[0];
  source.lat_deg = centre[1];
  source.radius_rad = read_arc(in.keys, "radius", in.radius_m);
  source.edge = region_edge(in);
  in.out.source.source = source;
}

void read_box(const SourceReader& in) {
  BoxSource source;
  const auto angle = [&](const char* key, double limit) {
    return in.keys.quantity(key, Dimension::angle, Bounds::between(-limit, limit));
  };
  source.west_deg = angle("west", 360.0);
  source.east_deg = angle("east", 360.0);
  source.south_deg = angle("south", 90.0);
  source.north_deg = angle("north", 90.0);
  if (source.north_deg <= source.south_deg) {
    in.keys.fail("north", source.north_deg, " deg must be north of `south`, ", source.south_deg,
                 " deg.");
  }
  source.edge = region_edge(in);
  in.out.source.source = source;
}

void read_polygon(const SourceReader& in) {
  in.out.polygons = file_request(in.keys, "file");
  in.out.polygon_name = in.keys.string("feature", "");
  PolygonSource source;
  source.edge = region_edge(in);
  in.out.source.source = source;
}

void read_slope(const SourceReader& in) {
  SlopeSource source;
  source.cells = in.keys.quantity("cells", Dimension::none, Bounds::positive(), "20");
  source.smooth_rad = read_arc(in.keys, "smooth", in.radius_m, "0 km");
  source.min_depth_m = in.keys.quantity("min_depth", Dimension::length, Bounds::positive(), "10 m");
  source.max_m = spacing(in.keys, "max", "1000 km");
  in.out.source.source = source;
}

void read_tidal(const SourceReader& in) {
  TidalSource source;
  source.period_s = in.keys.quantity("period", Dimension::time, Bounds::positive(), "12.42 h");
  source.cells = in.keys.quantity("cells", Dimension::none, Bounds::positive(), "100");
  source.min_depth_m = in.keys.quantity("min_depth", Dimension::length, Bounds::positive(), "10 m");
  in.out.source.source = source;
}

void read_coast(const SourceReader& in) {
  CoastSource source;
  source.spacing_m = spacing(in.keys, "spacing");
  source.rate = in.keys.quantity("rate", Dimension::none, Bounds::positive(), "0.1");
  source.max_m = spacing(in.keys, "max", "60 km");
  if (source.max_m < source.spacing_m) {
    in.keys.fail("max", source.max_m / 1000.0, " km is below `spacing`, ",
                 source.spacing_m / 1000.0, " km.");
  }
  if (in.keys.has("file")) {
    in.out.polygons = file_request(in.keys, "file");
    in.out.polygon_name = in.keys.string("feature", "");
  }
  in.out.source.source = source;
}

void read_rossby(const SourceReader& in) {
  RossbySource source;
  if (in.keys.has("radius_file") == in.keys.has("climatology")) {
    in.keys.fail("radius_file",
                 "give either radius_file (a field of the radius) or climatology (temperature and "
                 "salinity, from which the radius is computed).");
  }
  if (in.keys.has("radius_file")) {
    in.out.field = file_request(in.keys, "radius_file");
    in.out.field.raster.variable = in.keys.string("radius_variable", "");
    in.out.field.raster.units = "m";
  } else {
    in.out.temperature = file_request(in.keys, "climatology");
    in.out.salinity = in.out.temperature;
    in.out.temperature.raster.variable = in.keys.string("temperature", "TEMP");
    in.out.salinity.raster.variable = in.keys.string("salinity", "SALT");
    in.out.temperature.raster.time_index = optional_index(in.keys, "time");
    in.out.salinity.raster.time_index = in.out.temperature.raster.time_index;
  }
  if (in.keys.has("cells") && in.keys.has("factor")) {
    in.keys.fail("cells", "is 1 / factor; give one of the two.");
  }
  source.factor = in.keys.has("cells")
                      ? 1.0 / in.keys.quantity("cells", Dimension::none, Bounds::positive())
                      : in.keys.quantity("factor", Dimension::none, Bounds::positive(), "2");
  source.min_radius_m =
      in.keys.quantity("min_radius", Dimension::length, Bounds::positive(), "1 km");
  in.out.source.source = source;
}

/// The amplitude is a speed (EKE), a height (variance of sea surface height), or of the user's
/// unit.
double threshold_amplitude(MapReader& keys, Dimension amplitude) {
  const ConfigNode* const node = keys.find("threshold");
  const bool is_energy = amplitude == Dimension::speed && node != nullptr &&
                         parse_quantity(node->scalar, Dimension::energy).error.empty();
  const double value =
      keys.quantity("threshold", is_energy ? Dimension::energy : amplitude, Bounds::positive());
  return is_energy ? std::sqrt(2.0 * value) : value;
}

EddyLinear read_linear(MapReader& keys, Dimension amplitude) {
  // What has a unit has values for an ocean; other amplitudes must be given.
  const bool is_speed = amplitude == Dimension::speed;
  if (amplitude == Dimension::none) {
    for (const char* const key : {"quiet", "energetic"}) {
      if (!keys.has(key)) keys.fail(key, "give [amplitude, spacing], e.g. [1e-12, 60 km].");
    }
  }
  EddyLinear form;
  std::tie(form.quiet_amplitude, form.quiet_spacing_m) =
      keys.pair("quiet", amplitude, Dimension::length, {is_speed ? "0.05 m/s" : "0.02 m", "60 km"});
  std::tie(form.energetic_amplitude, form.energetic_spacing_m) = keys.pair(
      "energetic", amplitude, Dimension::length, {is_speed ? "0.45 m/s" : "0.3 m", "10 km"});
  if (form.energetic_amplitude <= form.quiet_amplitude) {
    keys.fail("energetic", "its amplitude must be above that of `quiet`.");
  }
  return form;
}

void read_eddy_form(MapReader& keys, Dimension amplitude, EddySource& source) {
  if (keys.choice("form", {"linear", "threshold"}, "linear") == 0) {
    source.form = read_linear(keys, amplitude);
    return;
  }
  EddyThreshold form;
  form.amplitude = threshold_amplitude(keys, amplitude);
  form.spacing_below_m = spacing(keys, "spacing_below");
  form.spacing_above_m = spacing(keys, "spacing_above");
  source.form = form;
}

void read_eke(const SourceReader& in) {
  in.out.field = field_request(in.keys, "m2 s-2");
  in.out.source.source = read_eddy_law(in.keys, EddyQuantity::kinetic_energy, in.radius_m);
}

void read_ssh_variability(const SourceReader& in) {
  in.out.field = field_request(in.keys, "m2");
  in.out.source.source = read_eddy_law(in.keys, EddyQuantity::height_variance, in.radius_m);
}

struct SourceType {
  const char* name;
  MapReader::Keys keys;
  void (*read)(const SourceReader&);
};

#define DELOS_COMMON_KEYS "type", "name", "optional"

/// Lists stay alive only as long as their initialisation, hence a visitor and no table.
template <class Visit>
void visit_source_types(Visit&& visit) {
  visit({"constant", {DELOS_COMMON_KEYS, "spacing"}, read_constant});
  visit({"latitude_profile",
         {DELOS_COMMON_KEYS, "latitude", "spacing", "interpolation"},
         read_latitude_profile});
  visit({"raster",
         {DELOS_COMMON_KEYS, "file", "variable", "units", "time", "level", "missing"},
         read_raster_source});
  visit({"disc",
         {DELOS_COMMON_KEYS, "centre", "radius", "spacing", "outside", "width", "transition"},
         read_disc});
  visit({"box",
         {DELOS_COMMON_KEYS, "west", "east", "south", "north", "spacing", "outside", "width",
          "transition"},
         read_box});
  visit({"polygon",
         {DELOS_COMMON_KEYS, "file", "feature", "spacing", "outside", "width", "transition"},
         read_polygon});
  visit({"slope", {DELOS_COMMON_KEYS, "cells", "smooth", "min_depth", "max"}, read_slope});
  visit({"tidal", {DELOS_COMMON_KEYS, "period", "cells", "min_depth"}, read_tidal});
  visit({"coast", {DELOS_COMMON_KEYS, "spacing", "rate", "max", "file", "feature"}, read_coast});
  visit({"rossby",
         {DELOS_COMMON_KEYS, "radius_file", "radius_variable", "climatology", "temperature",
          "salinity", "time", "factor", "cells", "min_radius"},
         read_rossby});
  visit({"eke",
         {DELOS_COMMON_KEYS, "file", "variable", "units", "time", "level", "form", "quiet",
          "energetic", "threshold", "spacing_below", "spacing_above", "fill_speed", "clamp",
          "smooth"},
         read_eke});
  visit({"ssh_variability",
         {DELOS_COMMON_KEYS, "file", "variable", "units", "time", "level", "form", "quiet",
          "energetic", "threshold", "spacing_below", "spacing_above", "fill_height", "clamp",
          "smooth"},
         read_ssh_variability});
}
#undef DELOS_COMMON_KEYS

std::string source_type(const ConfigNode& node, const std::string& path) {
  const ConfigNode* const type = node.find("type");
  DELOS_CHECK(type != nullptr && type->kind == ConfigNode::Kind::scalar, ErrorKind::config,
              node.where, " ", path,
              ": a source is a map with a `type`, e.g. {type: constant, spacing: 60 km}.");
  std::vector<std::string> names;
  visit_source_types([&](const SourceType& known) { names.emplace_back(known.name); });
  if (std::find(names.begin(), names.end(), type->scalar) == names.end()) {
    const std::string near = nearest_name(type->scalar, names);
    throw Error(ErrorKind::config,
                text(type->where, " ", path, ".type: '", type->scalar, "' is no source. ",
                     near.empty() ? "" : "Did you mean '" + near + "'? ",
                     "There are: ", join_names(names), "."));
  }
  return type->scalar;
}

SourceSettings read_source(const ConfigNode& node, const std::string& path, ConfigNode& effective,
                           double radius_m) {
  SourceSettings out;
  const std::string type = source_type(node, path);
  visit_source_types([&](const SourceType& known) {
    if (type != known.name) return;
    MapReader keys(node, path, effective, known.keys);
    keys.string("type");
    const std::string name = keys.string("name", type.c_str());
    out.source.name = text(node.where, " ", path, " (", name, ")");
    out.optional = keys.boolean("optional", false);
    known.read({keys, out, radius_m});
  });
  return out;
}

CombineOptions read_combine(MapReader& sizing, std::size_t n_sources) {
  CombineOptions out;
  const ConfigNode* const node = sizing.find("combine");
  if (node != nullptr && node->kind == ConfigNode::Kind::map) {
    MapReader keys = sizing.map("combine", {"blend"});
    out.rule = CombineRule::blend;
    constexpr double kMaxWeight = 1e6;  // only their ratios count; sums of larger ones overflow
    out.weights = keys.quantities("blend", Dimension::none, Bounds::between(0.0, kMaxWeight),
                                  {n_sources, n_sources});
    double sum = 0.0;
    for (const double weight : out.weights) sum += weight;
    if (sum <= 0.0) keys.fail("blend", "at least one weight must be > 0.");
  } else {
    if (node != nullptr && node->kind == ConfigNode::Kind::scalar && node->scalar != "min" &&
        node->scalar != "max") {
      sizing.fail("combine", "'", node->scalar, "' is not known. Valid here: min, max, or ",
                  "{blend: [0.5, 0.5]} with a weight for each source.");
    }
    out.rule =
        sizing.choice("combine", {"min", "max"}, "min") == 0 ? CombineRule::min : CombineRule::max;
  }
  return out;
}

ClampOptions read_clamp(MapReader keys) {
  ClampOptions out;
  out.min_m = spacing(keys, "min", "1 m");
  out.max_m = spacing(keys, "max", "20000 km");
  if (out.max_m < out.min_m) {
    keys.fail("max", out.max_m / 1000.0, " km is below `min`, ", out.min_m / 1000.0, " km.");
  }
  return out;
}

BathymetrySettings read_bathymetry(MapReader keys) {
  BathymetrySettings out;
  out.field.file = keys.string("file", "auto");
  out.field.where = keys.locate("file");
  out.field.raster.variable = keys.string("variable", "");
  out.field.raster.time_index = optional_index(keys, "time");
  out.field.raster.units = "m";
  out.field.raster.file_units = keys.string("units", "");
  out.sea_is_negative = keys.choice("sea", {"negative", "positive"}, "negative") == 0;
  return out;
}

bool uses_bathymetry(const SourceSettings& settings) {
  const auto& source = settings.source.source;
  return std::holds_alternative<SlopeSource>(source) ||
         std::holds_alternative<TidalSource>(source) ||
         (std::holds_alternative<CoastSource>(source) && settings.polygons.file.empty());
}

}  // namespace

EddySource read_eddy_law(MapReader& keys, EddyQuantity quantity, double radius_m) {
  EddySource source;
  source.quantity = quantity;
  const auto fill = [&](const char* key, Dimension dimension, const char* fallback) {
    return keys.quantity(key, dimension, Bounds::not_negative(), fallback);
  };
  switch (quantity) {
    case EddyQuantity::kinetic_energy:
      read_eddy_form(keys, Dimension::speed, source);
      source.fill_amplitude = fill("fill_speed", Dimension::speed, "0.03 m/s");
      source.max_energy =
          keys.quantity("clamp", Dimension::energy, Bounds::positive(), "0.5 m2/s2");
      break;
    case EddyQuantity::height_variance: {
      read_eddy_form(keys, Dimension::length, source);
      source.fill_amplitude = fill("fill_height", Dimension::length, "0.01 m");
      const double max_m = keys.quantity("clamp", Dimension::length, Bounds::positive(), "0.7 m");
      source.max_energy = max_m * max_m;
      break;
    }
    case EddyQuantity::amplitude:
      read_eddy_form(keys, Dimension::none, source);
      source.fill_amplitude = fill("fill", Dimension::none, "0");
      source.max_energy = keys.optional_quantity("clamp", Dimension::none, Bounds::positive())
                              .value_or(std::numeric_limits<double>::max());
      break;
  }
  source.smooth_rad = read_arc(keys, "smooth", radius_m, "0 deg");
  return source;
}

double read_arc(MapReader& reader, const std::string& key, double radius_m, const char* fallback) {
  const ConfigNode* const node = reader.find(key);
  const std::string given = node != nullptr ? node->scalar : fallback != nullptr ? fallback : "";
  if (parse_quantity(given, Dimension::length).error.empty()) {
    return reader.quantity(key, Dimension::length, Bounds::not_negative(), fallback) / radius_m;
  }
  if (!given.empty() && !parse_quantity(given, Dimension::angle).error.empty()) {
    reader.fail(key, "'", given,
                "' is no distance along the surface. Give it in km or m, or as an ",
                "angle in deg, e.g. '500 km' or '5 deg'.");
  }
  return reader.quantity(key, Dimension::angle, Bounds::between(0.0, 180.0), fallback) * kRadPerDeg;
}

SizingSettings read_sizing(MapReader& root, double radius_m, LatitudeKind latitude) {
  SizingSettings out;
  MapReader sizing = root.map("sizing", {"resolution", "sources", "combine", "smooth", "clamp",
                                         "land", "gradient_limit", "cells"});
  out.recipe.latitude = latitude;
  sizing.each("sources",
              [&](const ConfigNode& node, const std::string& path, ConfigNode& effective) {
                out.sources.push_back(read_source(node, path, effective, radius_m));
                out.needs_bathymetry = out.needs_bathymetry || uses_bathymetry(out.sources.back());
              });
  if (out.sources.empty()) {
    sizing.fail("sources",
                "at least one source of spacing is needed, e.g. "
                "[{type: constant, spacing: 60 km}].");
  }
  out.recipe.combine = read_combine(sizing, out.sources.size());
  if (sizing.has("resolution")) {
    out.recipe.resolution_rad = read_arc(sizing, "resolution", radius_m);
    if (!(out.recipe.resolution_rad > 0.0)) sizing.fail("resolution", "must be > 0.");
  }
  out.recipe.smooth_rad = read_arc(sizing, "smooth", radius_m, "0 deg");
  if (sizing.has("clamp")) out.recipe.clamp = read_clamp(sizing.map("clamp", {"min", "max"}));
  if (sizing.has("land")) {
    MapReader land = sizing.map("land", {"spacing"});
    out.recipe.land_spacing_m = spacing(land, "spacing");
    out.needs_bathymetry = true;
  }
  if (const auto limit =
          sizing.optional_quantity("gradient_limit", Dimension::none, Bounds::positive())) {
    out.recipe.gradient_limit = *limit;
  }
  if (sizing.has("cells")) {
    out.recipe.cells = sizing.integer("cells", 12, 2'000'000'000);
  }
  if (root.has("bathymetry") || root.has("layers") || out.needs_bathymetry) {
    add_bathymetry(root, out);
  }
  return out;
}

void add_bathymetry(MapReader& root, SizingSettings& out) {
  if (!out.bathymetry.field.file.empty()) return;
  out.bathymetry =
      read_bathymetry(root.map("bathymetry", {"file", "variable", "time", "units", "sea"}));
}

}  // namespace delos
