// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/settings_remesh.hpp"

#include <algorithm>

#include "io/names.hpp"
#include "lifecycle/settings_reader.hpp"
#include "lifecycle/settings_sizing.hpp"
#include "time/iso8601.hpp"

namespace delos {
namespace {

TimeInterval read_interval(MapReader& keys, const std::string& key) {
  const std::string given = keys.string(key, nullptr, "P1M");
  TimeInterval interval;
  try {
    interval = parse_interval(given);
  } catch (const Error& error) {
    keys.fail(key, error.what());
  }
  if (!interval.is_positive()) keys.fail(key, given, " does not lead forward, e.g. P1M or P10D.");
  return interval;
}

StatisticsOptions read_statistics(MapReader keys) {
  constexpr Window kWindows[] = {Window::since_remesh, Window::exponential, Window::fixed};
  StatisticsOptions out;
  out.window =
      kWindows[keys.choice("window", {"since_remesh", "exponential", "fixed"}, "since_remesh")];
  if (out.window == Window::since_remesh) {
    if (keys.has("length")) {
      keys.fail("length", "belongs to the windows exponential and fixed. Remove it.");
    }
    return out;
  }
  out.length_s = keys.quantity("length", Dimension::time, Bounds::positive());
  return out;
}

std::optional<UpstreamOptions> read_upstream(MapReader& keys) {
  if (!keys.has("upstream")) return std::nullopt;
  MapReader reach = keys.map("upstream", {"length", "time"});
  if (reach.has("length") == reach.has("time")) {
    keys.fail("upstream",
              "either a length or a time is needed, e.g. {length: 500 km} or "
              "{time: 20 d}.");
  }
  UpstreamOptions out;
  if (reach.has("length")) {
    out.length_m = reach.quantity("length", Dimension::length, Bounds::positive());
  } else {
    out.time_s = reach.quantity("time", Dimension::time, Bounds::positive());
  }
  return out;
}

void read_law(MapReader& keys, const std::string& type, double radius_m, SolutionSource& out) {
  if (type == "wanted_spacing") {
    out.field = SolutionField::spacing;
    out.law =
        WantedSpacing{keys.optional_quantity("missing", Dimension::length, Bounds::positive())};
    return;
  }
  out.upstream = read_upstream(keys);
  if (type == "eke") {
    constexpr SolutionField kFields[] = {SolutionField::velocity, SolutionField::normal_velocity,
                                         SolutionField::energy};
    out.field = kFields[keys.choice("from", {"velocity", "normal_velocity", "energy"}, "velocity")];
    out.law = read_eddy_law(keys, EddyQuantity::kinetic_energy, radius_m);
  } else if (type == "ssh_variability") {
    out.field = SolutionField::height;
    out.law = read_eddy_law(keys, EddyQuantity::height_variance, radius_m);
  } else {
    out.field = type == "indicator" ? SolutionField::indicator : SolutionField::vorticity_gradient;
    out.law = read_eddy_law(keys, EddyQuantity::amplitude, radius_m);
  }
}

/// The keys of each type; `visit(type, keys)`.
template <class Visit>
void visit_types(Visit&& visit) {
#define DELOS_LAW_KEYS                                                                         \
  "type", "name", "form", "quiet", "energetic", "threshold", "spacing_below", "spacing_above", \
      "clamp", "smooth", "upstream"
  visit("eke", MapReader::Keys{DELOS_LAW_KEYS, "from", "fill_speed"});
  visit("ssh_variability", MapReader::Keys{DELOS_LAW_KEYS, "fill_height"});
  visit("vorticity_gradient", MapReader::Keys{DELOS_LAW_KEYS, "fill"});
  visit("indicator", MapReader::Keys{DELOS_LAW_KEYS, "fill"});
  visit("wanted_spacing", MapReader::Keys{"type", "name", "missing"});
#undef DELOS_LAW_KEYS
}

SolutionSource read_solution_source(const ConfigNode& node, const std::string& path,
                                    ConfigNode& effective, double radius_m) {
  const ConfigNode* const type = node.find("type");
  DELOS_CHECK(type != nullptr && type->kind == ConfigNode::Kind::scalar, ErrorKind::config,
              node.where, " ", path, ": a source is a map with a `type`, e.g. {type: eke}.");
  SolutionSource out;
  std::vector<std::string> names;
  visit_types([&](const char* name, MapReader::Keys known) {
    names.emplace_back(name);
    if (type->scalar != name) return;
    MapReader keys(node, path, effective, known);
    keys.string("type");
    out.name = text(node.where, " ", path, " (", keys.string("name", name), ")");
    read_law(keys, type->scalar, radius_m, out);
  });
  if (!out.name.empty()) return out;
  const std::string near = nearest_name(type->scalar, names);
  throw Error(ErrorKind::config,
              text(type->where, " ", path, ".type: '", type->scalar, "' is no source of a remesh. ",
                   near.empty() ? "" : "Did you mean '" + near + "'? ",
                   "There are: ", join_names(names), "."));
}

FixedRegion read_disc(MapReader& keys, double radius_m) {
  const std::vector<double> centre =
      keys.quantities("centre", Dimension::angle, Bounds::between(-360.0, 360.0), {2, 2});
  if (centre[1] < -90.0 || centre[1] > 90.0) {
    keys.fail("centre", "is [longitude, latitude]; ", centre[1], " deg is no latitude.");
  }
  return FixedDisc{centre[0], centre[1], read_arc(keys, "radius", radius_m)};
}

FixedRegion read_box(MapReader& keys) {
  const auto angle = [&](const char* key, double limit) {
    return keys.quantity(key, Dimension::angle, Bounds::between(-limit, limit));
  };
  const FixedBox box{angle("west", 360.0), angle("east", 360.0), angle("south", 90.0),
                     angle("north", 90.0)};
  if (box.north_deg <= box.south_deg) {
    keys.fail("north", box.north_deg, " deg must be north of `south`, ", box.south_deg, " deg.");
  }
  return box;
}

FixedFile read_polygon(MapReader& keys) {
  FixedFile out;
  out.file = keys.string("file", nullptr, "regions.geojson");
  out.where = keys.locate("file");
  out.feature = keys.string("feature", "");
  return out;
}

void read_region(const ConfigNode& node, const std::string& path, ConfigNode& effective,
                 double radius_m, RemeshSettings& out) {
  const ConfigNode* const type = node.find("type");
  const std::string given = type != nullptr ? type->scalar : "";
  if (given == "box") {
    MapReader keys(node, path, effective, {"type", "west", "east", "south", "north"});
    keys.string("type");
    out.fixed.push_back(read_box(keys));
  } else if (given == "polygon") {
    MapReader keys(node, path, effective, {"type", "file", "feature"});
    keys.string("type");
    out.fixed_files.push_back(read_polygon(keys));
  } else {
    MapReader keys(node, path, effective, {"type", "centre", "radius"});
    keys.choice("type", {"disc", "box", "polygon"});
    out.fixed.push_back(read_disc(keys, radius_m));
  }
}

void read_policy(MapReader& keys, PolicyOptions& out) {
  const auto share = [&](const char* key, const char* fallback) {
    return keys.quantity(key, Dimension::none, Bounds::between(0.0, 1.0), fallback);
  };
  // Nearer to 1 the unevenness that every grid has would count as mismatch.
  out.tau = keys.quantity("tau", Dimension::none, Bounds::between(1.05, 10.0), "1.2");
  out.threshold = share("threshold", "0.1");
  out.hysteresis = share("hysteresis", "0.5");
  if (keys.has("minimum_interval")) out.minimum_interval = read_interval(keys, "minimum_interval");
}

}  // namespace

std::optional<RemeshSettings> read_remesh(MapReader& root, double radius_m) {
  if (!root.has("remesh")) return std::nullopt;
  MapReader keys =
      root.map("remesh", {"interval", "minimum_interval", "statistics", "sources", "with_static",
                          "tau", "threshold", "hysteresis", "cells", "fixed"});
  RemeshSettings out;
  out.interval = read_interval(keys, "interval");
  read_policy(keys, out.policy);
  out.statistics = read_statistics(keys.map("statistics", {"window", "length"}));
  keys.each("sources", [&](const ConfigNode& node, const std::string& path, ConfigNode& effective) {
    out.sources.push_back(read_solution_source(node, path, effective, radius_m));
  });
  if (out.sources.empty()) {
    keys.fail("sources", "at least one source is needed, e.g. [{type: eke}].");
  }
  out.with_static = keys.boolean("with_static", true);
  if (keys.has("cells")) out.cells = keys.integer("cells", 12, 2'000'000'000);
  keys.each("fixed", [&](const ConfigNode& node, const std::string& path, ConfigNode& effective) {
    read_region(node, path, effective, radius_m, out);
  });
  return out;
}

}  // namespace delos
