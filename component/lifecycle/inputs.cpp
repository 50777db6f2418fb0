// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/inputs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "core/error.hpp"
#include "io/data_files.hpp"
#include "io/embedded_bathymetry.hpp"
#include "io/geojson.hpp"
#include "io/provenance.hpp"
#include "io/rasters.hpp"

namespace delos {
namespace {

constexpr char kAutomaticBathymetry[] = "etopo5.cdf";  // of Debian's ferret-datasets

/// `data_path` of the configuration, then of the environment.
std::vector<std::string> search_path(const Settings& settings) {
  std::vector<std::string> folders = settings.data_path;
  const char* const environment = std::getenv("DELOS_DATA_PATH");
  std::string rest = environment == nullptr ? "" : environment;
  while (!rest.empty()) {
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    if (colon > 0) folders.push_back(rest.substr(0, colon));
    rest.erase(0, colon + 1);
  }
  return folders;
}

class InputReader {
 public:
  InputReader(Context& context, const Settings& settings, Inputs& out)
      : context_(context), settings_(settings), search_path_(search_path(settings)), out_(out) {}

  /// False when the source is optional and a file of it is missing.
  bool add_source(const SourceSettings& source);
  void add_bathymetry(const BathymetrySettings& bathymetry);
  void add_domain(const DomainSettings& domain);
  void add_region(const RegionSettings& region);
  void add_fixed(const RemeshSettings& remesh);
  void add_lines(const FileRequest& request);

 private:
  bool has_file(const FileRequest& request) const {
    return has_data_file(request.file, settings_.folder, search_path_);
  }
  bool is_complete(const SourceSettings& source);
  std::string path_of(const FileRequest& request);
  std::shared_ptr<const Raster> raster(const FileRequest& request);
  std::shared_ptr<const RasterStack> stack(const FileRequest& request);
  std::shared_ptr<const PolygonSet> polygons(const FileRequest& request,
                                             const std::string& feature);
  std::vector<LonLatLine> lines(const LinesRequest& request);
  void fill(const SourceSettings& settings, SpacingSource& source);

  Context& context_;
  const Settings& settings_;
  std::vector<std::string> search_path_;
  Inputs& out_;
};

/// Says which key named the file when reading it fails.
template <class Read>
auto with_key(const std::string& where, Read&& read) {
  try {
    return read();
  } catch (const Error& error) {
    throw Error(error.kind(), text(where, ": ", error.what()));
  }
}

std::string InputReader::path_of(const FileRequest& request) {
  std::string path = with_key(
      request.where, [&] { return find_data_file(request.file, settings_.folder, search_path_); });
  const bool is_known = std::any_of(out_.files.begin(), out_.files.end(),
                                    [&](const InputRecord& file) { return file.path == path; });
  if (!is_known) {
    context_.monitor.log(LogLevel::info, text("reading ", path));
    const InputFile file = with_key(request.where, [&] { return describe_input(path); });
    out_.files.push_back({file.path, file.sha256});
  }
  context_.monitor.check_cancelled();
  return path;
}

std::shared_ptr<const Raster> InputReader::raster(const FileRequest& request) {
  const std::string path = path_of(request);
  context_.monitor.advance(1);
  return with_key(request.where, [&] {
    return std::make_shared<const Raster>(read_raster(context_.exec, path, request.raster));
  });
}

std::shared_ptr<const RasterStack> InputReader::stack(const FileRequest& request) {
  const std::string path = path_of(request);
  context_.monitor.advance(1);
  return with_key(request.where, [&] {
    return std::make_shared<const RasterStack>(
        read_raster_stack(context_.exec, path, request.raster));
  });
}

std::shared_ptr<const PolygonSet> InputReader::polygons(const FileRequest& request,
                                                        const std::string& feature) {
  if (request.file.empty()) return nullptr;
  const std::string path = path_of(request);
  context_.monitor.advance(1);
  return with_key(request.where,
                  [&] { return std::make_shared<const PolygonSet>(read_polygons(path, feature)); });
}

std::vector<LonLatLine> InputReader::lines(const LinesRequest& request) {
  if (request.file.file.empty()) return {};
  const std::string path = path_of(request.file);
  context_.monitor.advance(1);
  return with_key(request.file.where,
                  [&] { return read_lines(path, request.select, request.except); });
}

void InputReader::add_domain(const DomainSettings& domain) {
  out_.land = polygons(domain.land, domain.land_feature);
  out_.passages = lines(domain.passages);
  out_.blockages = lines(domain.blockages);
}

void InputReader::add_region(const RegionSettings& region) {
  out_.region =
      region.shape ? *region.shape : RegionShape(polygons(region.polygons, region.feature));
  check_region(*out_.region);
  // Baselines have one spacing everywhere.
  if (settings_.generator != Generator::frontal) return;
  out_.recipe.region = out_.region;
  out_.recipe.outside.n_rings = region.rings.total();
  out_.recipe.outside.rate = region.growth;
}

void InputReader::fill(const SourceSettings& settings, SpacingSource& target) {
  if (auto* const source = std::get_if<RasterSource>(&target.source)) {
    source->raster = raster(settings.field);
  } else if (auto* const source = std::get_if<PolygonSource>(&target.source)) {
    source->polygons = polygons(settings.polygons, settings.polygon_name);
  } else if (auto* const source = std::get_if<CoastSource>(&target.source)) {
    source->land = polygons(settings.polygons, settings.polygon_name);
  } else if (auto* const source = std::get_if<EddySource>(&target.source)) {
    source->field = raster(settings.field);
  } else if (auto* const source = std::get_if<RossbySource>(&target.source)) {
    if (!settings.field.file.empty()) {
      source->radius_m = raster(settings.field);
    } else {
      source->temperature_degc = stack(settings.temperature);
      source->salinity_psu = stack(settings.salinity);
    }
  }
}

bool InputReader::is_complete(const SourceSettings& source) {
  for (const FileRequest* request :
       {&source.field, &source.temperature, &source.salinity, &source.polygons}) {
    if (request->file.empty() || has_file(*request)) continue;
    context_.monitor.log(
        LogLevel::warning,
        text(source.source.name, " is left out: there is no file '", request->file, "'."));
    return false;
  }
  return true;
}

bool InputReader::add_source(const SourceSettings& settings) {
  if (settings.optional && !is_complete(settings)) {
    out_.left_out.push_back(settings.source.name);
    return false;
  }
  SpacingSource source = settings.source;
  fill(settings, source);
  out_.recipe.sources.push_back(std::move(source));
  return true;
}

void InputReader::add_bathymetry(const BathymetrySettings& bathymetry) {
  FileRequest request = bathymetry.field;
  const bool is_automatic = request.file == "auto";
  if (is_automatic) request.file = kAutomaticBathymetry;
  std::shared_ptr<const Raster> elevation;
  if (is_automatic && !has_file(request)) {
    elevation = std::make_shared<const Raster>(embedded_bathymetry());
    out_.bathymetry = "embedded ETOPO5 at 0.5 degree";
  } else {
    elevation = raster(request);
    out_.bathymetry = elevation->source;
  }
  if (!bathymetry.sea_is_negative) {
    auto turned = std::make_shared<Raster>(*elevation);
    for (double& value : turned->values) value = 0.0 - value;
    elevation = turned;
  }
  context_.monitor.log(LogLevel::info, text("bathymetry: ", out_.bathymetry));
  out_.elevation_m = std::move(elevation);
}

void InputReader::add_fixed(const RemeshSettings& remesh) {
  out_.fixed = remesh.fixed;
  for (const FixedFile& named : remesh.fixed_files) {
    const std::string path = path_of({named.file, named.where, {}});
    context_.monitor.advance(1);
    with_key(named.where, [&] {
      auto polygons = std::make_shared<const PolygonSet>(read_polygons(path, named.feature));
      DELOS_CHECK(!polygons->rings.empty(), ErrorKind::input, path,
                  " holds no polygon: check the file and the feature's name.");
      out_.fixed.emplace_back(FixedPolygons{std::move(polygons)});
    });
  }
}

/// The same place has the same bits, however its longitude was written.
Vec3 position(const Settings& settings, const std::array<double, 2>& lon_lat_deg) {
  const auto [lon, lat] = lon_lat_deg;
  const bool is_pole = std::abs(lat) == 90.0;
  const double turned = is_pole ? 0.0 : lon - 360.0 * std::ceil((lon - 180.0) / 360.0);
  return settings.surface.point({turned * kRadPerDeg, lat * kRadPerDeg}, settings.latitude);
}

GivenLine given_line(const Settings& settings, const LineFeature& feature) {
  constexpr GivenLine::Kind kKinds[] = {GivenLine::Kind::points, GivenLine::Kind::line,
                                        GivenLine::Kind::ring};
  GivenLine out{feature.name, kKinds[static_cast<std::size_t>(feature.kind)], {}};
  for (const auto& place : feature.lon_lat_deg) out.points.push_back(position(settings, place));
  return out;
}

void InputReader::add_lines(const FileRequest& request) {
  const std::string path = path_of(request);
  context_.monitor.advance(1);
  const auto features = with_key(request.where, [&] { return read_line_features(path); });
  for (const LineFeature& feature : features) out_.lines.push_back(given_line(settings_, feature));
}

}  // namespace

Inputs read_inputs(Context& context, const Settings& settings) {
  Inputs out;
  const SizingSettings& sizing = settings.sizing;
  out.recipe = sizing.recipe;
  InputReader reader(context, settings, out);
  const Phase phase(context.monitor, "read", 0);
  std::vector<double>& weights = out.recipe.combine.weights;
  for (std::size_t i = 0; i < sizing.sources.size(); ++i) {
    const bool is_used = reader.add_source(sizing.sources[i]);
    if (is_used || weights.empty()) continue;
    weights.erase(weights.begin() + static_cast<std::ptrdiff_t>(out.recipe.sources.size()));
  }
  DELOS_CHECK(!out.recipe.sources.empty(), ErrorKind::input,
              "sizing.sources: every source is optional and lacks its file. Add one that needs no "
              "file, e.g. {type: constant, spacing: 60 km}.");
  const bool is_sea_masked = settings.domain && settings.domain->needs_bathymetry();
  if (sizing.needs_bathymetry || is_sea_masked || settings.layers) {
    reader.add_bathymetry(sizing.bathymetry);
  }
  if (sizing.needs_bathymetry) out.recipe.elevation_m = out.elevation_m;
  if (settings.domain) reader.add_domain(*settings.domain);
  if (settings.region) reader.add_region(*settings.region);
  if (settings.remesh) reader.add_fixed(*settings.remesh);
  for (const FileRequest& file : settings.constraints.files) reader.add_lines(file);
  for (const LineFeature& shape : settings.constraints.shapes) {
    out.lines.push_back(given_line(settings, shape));
  }
  return out;
}

}  // namespace delos
