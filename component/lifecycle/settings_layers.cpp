// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/settings_layers.hpp"

#include <functional>

#include "core/error.hpp"

namespace delos {
namespace {

constexpr std::int64_t kMostLevels = 10'000;

/// What a function of the engine refuses is refused at its key.
template <class Make>
auto at_key(const MapReader& keys, std::string_view key, Make&& make) {
  try {
    return make();
  } catch (const Error& error) {
    keys.fail(key, error.what());
  }
}

void refuse(const MapReader& keys, std::initializer_list<const char*> names, const char* where) {
  for (const char* const name : names) {
    if (keys.has(name)) keys.fail(name, "goes with ", where, ". Remove one of the two.");
  }
}

/// A default as the user would write it.
std::string metres(double value) { return text(value, " m"); }

domain::Stretching read_stretching(MapReader& keys, domain::Stretching shape) {
  const auto length = [&](const char* key, double fallback) {
    return keys.quantity(key, Dimension::length, Bounds::positive(), metres(fallback).c_str());
  };
  shape.depth_m = length("depth", shape.depth_m);
  shape.top_m = length("top", shape.top_m);
  shape.bottom_m = length("bottom", shape.bottom_m);
  return shape;
}

domain::Levels read_levels(MapReader keys) {
  enum Shape { ocean_60, ocean_80, stretched, uniform, listed };
  const auto shape = static_cast<Shape>(
      keys.choice("shape", {"ocean_60", "ocean_80", "stretched", "uniform", "listed"}, "ocean_60"));
  if (shape != listed) refuse(keys, {"interfaces"}, "shape: listed");
  if (shape == uniform || shape == listed) refuse(keys, {"top", "bottom"}, "stretched shapes");
  if (shape == ocean_60 || shape == ocean_80 || shape == listed) {
    refuse(keys, {"n"}, "shape: stretched or uniform");
  }
  if (shape == listed) {
    refuse(keys, {"depth"}, "other shapes, since the last interface is the depth");
    const auto interface_m = keys.quantities("interfaces", Dimension::length,
                                             Bounds::not_negative(), {1, kMostLevels + 1});
    return at_key(keys, "interfaces", [&] { return domain::listed_levels(interface_m); });
  }
  domain::Stretching wanted = shape == ocean_80 ? domain::ocean_80() : domain::ocean_60();
  if (shape == stretched || shape == uniform) wanted.n_levels = keys.integer("n", 1, kMostLevels);
  if (shape == uniform) {
    const double depth_m = keys.quantity("depth", Dimension::length, Bounds::positive());
    return at_key(keys, "depth", [&] { return domain::uniform_levels(wanted.n_levels, depth_m); });
  }
  wanted = read_stretching(keys, wanted);
  return at_key(keys, "depth", [&] { return domain::stretched_levels(wanted); });
}

void read_z_levels(MapReader& keys, LayerSettings& out) {
  out.levels =
      read_levels(keys.map("levels", {"shape", "n", "depth", "top", "bottom", "interfaces"}));
  out.least_wet = keys.quantity("wet_fraction", Dimension::none, Bounds::between(0.0, 1.0), "0.5");
  domain::BathymetryOptions& bathymetry = out.bathymetry;
  bathymetry.min_depth_m =
      keys.quantity("minimum_depth", Dimension::length, Bounds::not_negative(), "10 m");
  bathymetry.max_depth_m = out.levels.depth_m();
  if (bathymetry.min_depth_m > bathymetry.max_depth_m) {
    keys.fail("minimum_depth", bathymetry.min_depth_m, " m: the lowest interface is at ",
              bathymetry.max_depth_m, " m already.");
  }
  // At 1 any two depths will do; at 0 only a flat floor.
  constexpr double kLeastRFactor = 0.01;
  if (keys.has("r_factor")) {
    bathymetry.max_r_factor =
        keys.quantity("r_factor", Dimension::none, Bounds::between(kLeastRFactor, 1.0));
  }
  domain::StackOptions& stack = out.stack;
  stack.min_levels = keys.integer("minimum_levels", 1, kMostLevels, "3");
  if (stack.min_levels > out.levels.n_levels()) {
    keys.fail("minimum_levels", stack.min_levels, ": there are ", out.levels.n_levels(),
              " levels only.");
  }
  stack.has_partial_bottom = keys.boolean("partial_bottom", true);
  if (stack.has_partial_bottom) {
    stack.min_fraction =
        keys.quantity("minimum_fraction", Dimension::none, Bounds::between(0.0, 1.0), "0.1");
  } else {
    refuse(keys, {"minimum_fraction"}, "partial_bottom: true");
  }
}

void read_terrain(MapReader& keys, LayerSettings& out) {
  domain::TerrainOptions& terrain = out.terrain;
  terrain.n_levels = keys.integer("n", 1, kMostLevels, "55");
  terrain.top_m = keys.quantity("top", Dimension::length, Bounds::positive(), "30 km");
  terrain.stretching =
      keys.quantity("stretching", Dimension::none, Bounds::between(1.0, 10.0), "1.5");
  terrain.level_above_m = keys.quantity("level_above", Dimension::length, Bounds::positive(),
                                        metres(terrain.top_m).c_str());
  if (terrain.level_above_m > terrain.top_m) {
    keys.fail("level_above", terrain.level_above_m, " m: must not be above the top, ",
              terrain.top_m, " m.");
  }
  constexpr std::int64_t kMostRounds = 10'000;
  terrain.smoothing_rounds = keys.integer("smoothing_rounds", 0, kMostRounds, "2");
}

}  // namespace

std::optional<LayerSettings> read_layers(MapReader& root) {
  if (!root.has("layers")) return std::nullopt;
  MapReader keys =
      root.map("layers", {"kind", "levels", "wet_fraction", "minimum_depth", "minimum_levels",
                          "partial_bottom", "minimum_fraction", "r_factor", "n", "top",
                          "stretching", "level_above", "smoothing_rounds"});
  LayerSettings out;
  out.kind = static_cast<LayerKind>(keys.choice("kind", {"z_level", "terrain_following"}));
  if (out.kind == LayerKind::z_level) {
    refuse(keys, {"n", "top", "stretching", "level_above", "smoothing_rounds"},
           "kind: terrain_following (`levels` has the levels of kind: z_level)");
    read_z_levels(keys, out);
  } else {
    refuse(keys,
           {"levels", "wet_fraction", "minimum_depth", "minimum_levels", "partial_bottom",
            "minimum_fraction", "r_factor"},
           "kind: z_level");
    read_terrain(keys, out);
  }
  return out;
}

}  // namespace delos
