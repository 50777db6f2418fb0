// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The `layers` section.
#include <optional>

#include "domain/bathymetry.hpp"
#include "domain/levels.hpp"
#include "domain/stack.hpp"
#include "domain/terrain.hpp"
#include "lifecycle/settings_reader.hpp"

namespace delos {

enum class LayerKind {
  z_level,           ///< of an ocean, with partial bottom cells
  terrain_following  ///< of an atmosphere
};

/// The options of its kind; the others are not used.
struct LayerSettings {
  LayerKind kind = LayerKind::z_level;
  domain::Levels levels;
  domain::BathymetryOptions bathymetry;
  domain::StackOptions stack;
  double least_wet = 0.5;  ///< share of a sea cell that is wet, where no domain says what is sea
  domain::TerrainOptions terrain;

  std::int64_t n_levels() const {
    return kind == LayerKind::z_level ? levels.n_levels() : terrain.n_levels;
  }
};

/// Nothing without the section.
std::optional<LayerSettings> read_layers(MapReader& root);

}  // namespace delos
