// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The section `remesh`: when a running model's grid is made anew, and from what.
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "adapt/fixed.hpp"
#include "adapt/policy.hpp"
#include "adapt/statistics.hpp"
#include "adapt/upstream.hpp"
#include "sizing/solution.hpp"
#include "time/interval.hpp"

namespace delos {

class MapReader;

/// What a source of spacing knows of the running model.
enum class SolutionField {
  velocity,            ///< east and north in cells or on a lat-lon grid; its variance
  normal_velocity,     ///< components along the edges' normals; the variance of the cells' vectors
  energy,              ///< a ready eddy kinetic energy; its mean
  height,              ///< sea surface height; its variance
  vorticity_gradient,  ///< |grad zeta| from velocity in cells; its mean
  indicator,           ///< an amplitude of the host's own; its mean
  spacing              ///< what the host itself wants, metres; its mean
};

/// The host's spacing, taken as it is.
struct WantedSpacing {
  std::optional<double> missing_m;  ///< where it is missing; without it the nearest
};

struct SolutionSource {
  std::string name;  ///< for messages: "file:line remesh.sources.0 (eke)"
  SolutionField field = SolutionField::velocity;
  std::variant<EddySource, WantedSpacing> law;  ///< without its raster
  /// The mean flow along which the signal is spread upstream.
  std::optional<UpstreamOptions> upstream;
};

/// A fixed region in a file, which inputs.hpp reads.
struct FixedFile {
  std::string file;
  std::string where;    ///< "file:line key.path" of the key, for messages
  std::string feature;  ///< feature to take; empty: all
};

struct RemeshSettings {
  TimeInterval interval;  ///< of the alarm
  PolicyOptions policy;
  StatisticsOptions statistics;
  std::vector<SolutionSource> sources;
  bool with_static = true;         ///< the sources of `sizing` go on beside these
  std::int64_t cells = 0;          ///< budget of the grids to come; 0: that of `sizing`
  std::vector<FixedRegion> fixed;  ///< discs and boxes
  std::vector<FixedFile> fixed_files;
};

/// Nothing without the section. Error(config) as all settings.
std::optional<RemeshSettings> read_remesh(MapReader& root, double radius_m);

}  // namespace delos
