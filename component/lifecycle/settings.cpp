// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/settings.hpp"

#include <algorithm>
#include <charconv>

#include "io/data_files.hpp"
#include "lifecycle/baselines.hpp"
#include "lifecycle/require.hpp"
#include "lifecycle/settings_reader.hpp"
#include "lifecycle/settings_sizing.hpp"

namespace delos {
namespace {

constexpr char kDefaultRadius[] = "6371.22 km";  // of published MPAS meshes

Vec3 read_lengths(MapReader& keys, const std::string& key, Bounds bounds) {
  const std::vector<double> values = keys.quantities(key, Dimension::length, bounds, {3, 3});
  return {values[0], values[1], values[2]};
}

void refuse(const MapReader& keys, const std::string& key, const std::string& shape) {
  if (keys.has(key)) keys.fail(key, "does not go with shape: ", shape, ". Remove one of the two.");
}

void read_surface(MapReader keys, Settings& out) {
  constexpr LatitudeKind kLatitudes[] = {LatitudeKind::geodetic, LatitudeKind::geocentric,
                                         LatitudeKind::parametric};
  const std::size_t shape = keys.choice("shape", {"sphere", "wgs84", "ellipsoid"}, "sphere");
  const Vec3 centre_m =
      keys.has("centre") ? read_lengths(keys, "centre", Bounds::any()) : Vec3(0.0, 0.0, 0.0);
  if (shape == 0) {
    out.shape = "sphere";
    refuse(keys, "radii", out.shape);
    const double radius_m =
        keys.quantity("radius", Dimension::length, Bounds::positive(), kDefaultRadius);
    out.surface = Ellipsoid(Vec3(radius_m, radius_m, radius_m), centre_m);
  } else if (shape == 1) {
    out.shape = "wgs84";
    refuse(keys, "radii", out.shape);
    refuse(keys, "radius", out.shape);
    const Ellipsoid wgs84 = Ellipsoid::wgs84();
    out.surface = Ellipsoid(wgs84.scale_m() * wgs84.radii(), centre_m);
  } else {
    out.shape = "ellipsoid";
    refuse(keys, "radius", out.shape);
    const Vec3 radii_m = read_lengths(keys, "radii", Bounds::positive());
    // Flatter bodies have no triangulation that is well centred at usual spacings.
    constexpr double kMaxAspect = 10.0;
    if (radii_m.maxCoeff() > kMaxAspect * radii_m.minCoeff()) {
      keys.fail("radii", "the largest is more than ", kMaxAspect, " times the smallest.");
    }
    out.surface = Ellipsoid(radii_m, centre_m);
  }
  // Positions are sums with the centre, which keep ten digits of the radius so.
  constexpr double kMaxOffset = 1e6;
  if (centre_m.cwiseAbs().maxCoeff() > kMaxOffset * out.surface.scale_m()) {
    keys.fail("centre", "lies more than ", kMaxOffset, " radii off: positions would lose their ",
              "digits. Check the units.");
  }
  out.latitude =
      kLatitudes[keys.choice("latitude", {"geodetic", "geocentric", "parametric"}, "geodetic")];
}

int read_rounds(MapReader& keys, const char* key, int fallback) {
  constexpr int kMaxRounds = 100'000;
  return static_cast<int>(keys.integer(key, 0, kMaxRounds, text(fallback).c_str()));
}

/// Baselines have one spacing everywhere, from `subdivisions` or `spacing`.
void read_baseline(MapReader& root, const char* generator, Settings& out) {
  for (const char* const key : {"sizing", "bathymetry", "constraints", "refine", "remesh"}) {
    const bool is_for_cells =
        key == std::string_view("bathymetry") && (root.has("domain") || root.has("layers"));
    if (root.has(key) && !is_for_cells) {
      root.fail(key, "is not used by generator: ", generator,
                ", which takes `subdivisions` or `spacing`, and relax.centroidal_rounds.");
    }
  }
  if (root.has("subdivisions") == root.has("spacing")) {
    root.fail("subdivisions", "give either subdivisions (e.g. 64) or spacing (e.g. 120 km) for ",
              "generator: ", generator, ".");
  }
  constexpr std::int64_t kMaxSubdivisions = 7000;  // 10 n^2 + 2 stays within 32-bit ids
  if (root.has("subdivisions")) {
    out.subdivisions = root.integer("subdivisions", 1, kMaxSubdivisions);
  } else {
    const double spacing_m = root.quantity("spacing", Dimension::length, Bounds::positive());
    out.subdivisions = baseline_subdivisions(out.generator, out.surface, spacing_m);
  }
  // Their points are what they are, but for the move to the centroids.
  out.relax.spring_rounds = out.relax.polish_rounds = 0;
  if (root.has("relax")) {
    MapReader relax = root.map("relax", {"centroidal_rounds"});
    out.relax.centroidal_rounds = read_rounds(relax, "centroidal_rounds", 0);
  }
  SourceSettings source;
  source.source.source =
      ConstantSource{baseline_spacing_m(out.generator, out.surface, out.subdivisions)};
  source.source.name = text("generator: ", generator);
  out.sizing.recipe.latitude = out.latitude;
  out.sizing.sources = {source};
}

/// A default as text that reads back to the same bits.
std::string exact(double value) {
  char out[32];
  const auto [end, status] = std::to_chars(out, out + sizeof(out), value);
  DELOS_ASSERT(status == std::errc());
  return {out, end};
}

RefineOptions read_refine(MapReader keys) {
  RefineOptions out;
  const auto number = [&](const char* key, Bounds bounds, double fallback) {
    return keys.quantity(key, Dimension::none, bounds, exact(fallback).c_str());
  };
  // Below 1 (30 degrees) refinement is not known to end; see the refine layer.
  out.radius_edge = number("radius_edge", Bounds::between(1.0, 10.0), out.radius_edge);
  out.size_ratio =
      number("size_ratio", {.low = 1.0, .high = 4.0, .low_is_open = true}, out.size_ratio);
  out.tile_vertices = number("tile_vertices", Bounds::between(500.0, 1e7), out.tile_vertices);
  return out;
}

LineFeature read_shape(MapReader keys) {
  constexpr LineFeature::Kind kKinds[] = {LineFeature::Kind::points, LineFeature::Kind::line,
                                          LineFeature::Kind::ring};
  LineFeature out;
  out.kind = kKinds[keys.choice("type", {"points", "line", "ring"})];
  const std::string name = keys.string("name", "");
  out.name = keys.locate("points") + (name.empty() ? "" : " (" + name + ")");
  constexpr std::size_t kMaxNumbers = 2'000'000;
  const std::size_t least = 2 * (static_cast<std::size_t>(out.kind) + 1);
  const std::vector<double> degrees = keys.quantities(
      "points", Dimension::angle, Bounds::between(-720.0, 720.0), {least, kMaxNumbers});
  if (degrees.size() % 2 != 0) {
    keys.fail("points", "has ", degrees.size(), " numbers; it is longitude, latitude in turn.");
  }
  for (std::size_t i = 0; i < degrees.size(); i += 2) {
    if (std::abs(degrees[i + 1]) > 90.0) {
      keys.fail("points", degrees[i + 1], " deg is no latitude; give longitude, latitude in turn.");
    }
    out.lon_lat_deg.push_back({degrees[i], degrees[i + 1]});
  }
  return out;
}

ConstraintSettings read_constraints(MapReader keys) {
  ConstraintSettings out;
  for (const std::string& file : keys.strings("files", {}, {})) {
    out.files.push_back({file, keys.locate("files"), {}});
  }
  keys.each("shapes", [&](const ConfigNode& node, const std::string& path, ConfigNode& effective) {
    out.shapes.push_back(read_shape(MapReader(node, path, effective, {"type", "name", "points"})));
  });
  if (out.empty()) keys.fail("files", "name GeoJSON files here, or give `shapes`.");
  return out;
}

RelaxOptions read_relax(MapReader keys) {
  RelaxOptions out;
  const auto rounds = [&](const char* key, int fallback) {
    return read_rounds(keys, key, fallback);
  };
  out.spring_rounds = rounds("spring_rounds", out.spring_rounds);
  out.centroidal_rounds = rounds("centroidal_rounds", out.centroidal_rounds);
  out.polish_rounds = rounds("polish_rounds", out.polish_rounds);
  // At 1 only equilateral triangles would do.
  out.target_quality = keys.quantity("target_quality", Dimension::none, Bounds::between(0.5, 0.99),
                                     exact(out.target_quality).c_str());
  out.repair = keys.boolean("repair", out.repair);
  return out;
}

LonLat read_view(MapReader& keys) {
  // The Atlantic with both its coasts.
  if (!keys.has("view")) return {-30.0 * kRadPerDeg, 25.0 * kRadPerDeg};
  const auto degrees =
      keys.quantities("view", Dimension::angle, Bounds::between(-360.0, 360.0), {2, 2});
  if (degrees[1] < -90.0 || degrees[1] > 90.0) {
    keys.fail("view", "is [longitude, latitude]; ", degrees[1], " deg is no latitude.");
  }
  return {degrees[0] * kRadPerDeg, degrees[1] * kRadPerDeg};
}

PartitionWishes read_partitions(MapReader& keys) {
  constexpr std::size_t kMostFiles = 64;  // a slip of the pen, rather than a wish
  PartitionWishes out;
  if (keys.has("partitions")) {
    const auto numbers =
        keys.quantities("partitions", Dimension::none, Bounds::between(2.0, 1e8), {0, kMostFiles});
    for (const double number : numbers) {
      const auto n_parts = static_cast<std::int64_t>(number);
      if (static_cast<double>(n_parts) != number) {
        keys.fail("partitions", number, ": parts are counted in whole numbers, e.g. [16, 64].");
      }
      if (std::find(out.n_parts.begin(), out.n_parts.end(), n_parts) != out.n_parts.end()) {
        keys.fail("partitions", "has ", n_parts, " twice. Remove one.");
      }
      out.n_parts.push_back(n_parts);
    }
  }
  if (out.n_parts.empty()) {
    if (keys.has("partition_method")) {
      keys.fail("partition_method", "says how to make `partitions`, of which there are none. Give ",
                "their numbers, e.g. partitions: [16, 64].");
    }
    return out;
  }
  constexpr PartitionMethod kMethods[] = {PartitionMethod::automatic, PartitionMethod::kway,
                                          PartitionMethod::curve};
  out.method =
      kMethods[keys.choice("partition_method", {"automatic", "kway", "curve"}, "automatic")];
  return out;
}

/// Endings such as ".ugrid_triangles.nc" follow, and a part of a name may have 255 bytes.
void check_file_name(const MapReader& keys, const std::string& name) {
  constexpr std::size_t kMaxBytes = 200;
  const bool has_control = std::any_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 0x20 || c == 0x7f;  // line ends, bells
  });
  if (name.empty() || has_control || name.find('/') != std::string::npos) {
    keys.fail("name", "'", name, "' is no file name; the folder goes to `directory`.");
  }
  if (name.size() > kMaxBytes) {
    keys.fail("name", "has ", name.size(), " bytes; files' names take at most ", kMaxBytes, ".");
  }
}

OutputSettings read_output(MapReader keys) {
  OutputSettings out;
  out.directory = keys.string("directory", "out");
  out.name = keys.string("name", "grid");
  check_file_name(keys, out.name);
  const auto formats = keys.strings(
      "formats",
      {"mpas", "ugrid_triangles", "ugrid_cells", "scrip", "esmf", "vtu", "gmsh", "jigsaw", "fesom"},
      {"mpas", "ugrid_triangles", "ugrid_cells"});
  const auto wanted = [&](const char* format) {
    return std::find(formats.begin(), formats.end(), format) != formats.end();
  };
  out.mpas = wanted("mpas");
  out.ugrid_triangles = wanted("ugrid_triangles");
  out.ugrid_cells = wanted("ugrid_cells");
  for (const std::string& format : formats) {
    const auto names = file_kind_names();
    const auto kind =
        static_cast<FileKind>(std::find(names.begin(), names.end(), format) - names.begin());
    if (kind > FileKind::ugrid_cells) out.more.push_back(kind);
  }
  out.graph = keys.boolean("graph", true);
  out.partitions = read_partitions(keys);
  out.order = read_cell_order(keys, "order_parts", domain::CellOrder::kept);
  out.report = keys.boolean("report", true);
  out.spacing = keys.boolean("spacing", false);
  out.pictures = keys.strings("pictures", {"globe", "map", "histograms"}, {});
  out.view = read_view(keys);
  out.has_view = keys.has("view");
  // Beyond 75 degrees the whole globe says more.
  out.view_radius_deg =
      keys.optional_quantity("view_radius", Dimension::angle, Bounds::between(0.01, 75.0))
          .value_or(0.0);
  if (out.view_radius_deg > 0.0 && !out.has_view) {
    keys.fail("view_radius",
              "is the radius of a disc around `view`, which is not given. Add "
              "output.view: [longitude, latitude].");
  }
  out.unit_sphere = keys.boolean("unit_sphere", false);
  out.compress = keys.boolean("compress", false);
  return out;
}

/// What the grid does not depend on leaves no trace in its files, so that they stay the same.
std::string grid_text(ConfigNode effective) {
  std::erase_if(effective.entries, [](const auto& entry) { return entry.first == "threads"; });
  for (auto& [key, node] : effective.entries) {
    if (key != "output") continue;
    std::erase_if(node.entries, [](const auto& entry) { return entry.first == "directory"; });
  }
  return to_yaml(effective);
}

/// What only the frontal generator knows: its sizing, constraints, relaxation and remesh.
void read_frontal_keys(MapReader& root, Settings& out) {
  for (const char* const key : {"subdivisions", "spacing"}) {
    if (root.has(key)) {
      root.fail(key, "belongs to the generators icosahedral and cubed_sphere. For a uniform ",
                "grid write sizing: {sources: [{type: constant, spacing: 60 km}]}.");
    }
  }
  out.sizing = read_sizing(root, out.surface.scale_m(), out.latitude);
  if (root.has("constraints")) {
    out.constraints = read_constraints(root.map("constraints", {"files", "shapes"}));
  }
  out.refine = read_refine(root.map("refine", {"radius_edge", "size_ratio", "tile_vertices"}));
  out.relax = read_relax(root.map("relax", {"spring_rounds", "centroidal_rounds", "polish_rounds",
                                            "target_quality", "repair"}));
  out.remesh = read_remesh(root, out.surface.scale_m());
  const bool has_fixed =
      out.remesh && !(out.remesh->fixed.empty() && out.remesh->fixed_files.empty());
  if (has_fixed && !out.constraints.empty()) {
    root.fail("remesh", "with constraints a remesh makes everything anew, so it can't leave ",
              "regions as they are. Remove remesh.fixed or constraints.");
  }
  if (out.remesh && out.sizing.recipe.combine.rule == CombineRule::blend) {
    root.fail("remesh", "its sources can't be blended: set sizing.combine to min or max.");
  }
}

/// The part of the sphere that the grid is cut to: an ocean, or a region.
void read_cut(MapReader& root, Settings& out) {
  out.domain = read_domain(root);
  if (out.domain && out.domain->fits_coast && out.remesh) {
    root.fail("domain",
              "fit_coast moves cells, and a remesh leaves those as they are that need no ",
              "change: remove domain.fit_coast or `remesh`.");
  }
  out.region = read_region(root, out.surface.scale_m());
  if (out.region && out.remesh) {
    root.fail("region",
              "a regional grid can't be made anew while a model runs: remove `region` or ",
              "`remesh`.");
  }
}

/// Where the order of the cells is settled by something else.
void check_order(MapReader& root, const Settings& settings) {
  if (settings.output.order.kind == domain::CellOrder::kept) return;
  const auto refuse = [&](const char* reason) {
    root.fail("output", "order is that of the cells of the whole surface: ", reason,
              " Remove output.order.");
  };
  if (settings.domain) refuse("for a domain set domain.order.");
  if (settings.region) refuse("cells of a region stand along a Hilbert curve.");
  if (settings.remesh) refuse("a remesh keeps the numbers of most cells.");
  if (!settings.constraints.empty()) refuse("points of `constraints` come first.");
}

}  // namespace

Settings read_settings(const ConfigNode& root_node, const std::string& folder) {
  Settings out;
  out.folder = folder;
  ConfigNode effective;
  MapReader root(root_node, "", effective,
                 {"title", "surface", "generator", "subdivisions", "spacing", "sizing",
                  "bathymetry", "constraints", "refine", "relax", "domain", "region", "layers",
                  "output", "require", "remesh", "threads", "data_path"});
  out.title = root.string("title", "");
  read_surface(root.map("surface", {"shape", "radius", "radii", "centre", "latitude"}), out);
  constexpr Generator kGenerators[] = {Generator::frontal, Generator::icosahedral,
                                       Generator::cubed_sphere};
  out.generator =
      kGenerators[root.choice("generator", {"frontal", "icosahedral", "cubed_sphere"}, "frontal")];
  if (out.generator == Generator::frontal) {
    read_frontal_keys(root, out);
  } else {
    read_baseline(root, out.generator == Generator::icosahedral ? "icosahedral" : "cubed_sphere",
                  out);
  }
  read_cut(root, out);
  if (out.domain && out.domain->needs_bathymetry()) add_bathymetry(root, out.sizing);
  out.layers = read_layers(root);
  if (out.layers) add_bathymetry(root, out.sizing);
  out.output = read_output(
      root.map("output", {"directory", "name", "formats", "graph", "partitions", "partition_method",
                          "order", "order_parts", "report", "spacing", "pictures", "view",
                          "view_radius", "unit_sphere", "compress"}));
  check_order(root, out);
  out.require = read_require(root);
  constexpr std::int64_t kMaxThreads = 4096;
  out.threads = static_cast<int>(root.integer("threads", 0, kMaxThreads, "0"));
  out.data_path = root.strings("data_path", {}, {kDefaultDataFolder});
  out.text = grid_text(std::move(effective));
  return out;
}

}  // namespace delos
