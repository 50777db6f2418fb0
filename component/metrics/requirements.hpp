// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a user may ask of a finished grid, and what of that a grid misses.
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "metrics/quality.hpp"

namespace delos {

/// Bounds on measures of Quality; none is asked for by default.
struct Requirements {
  bool well_centred = false;
  std::optional<double> relative_edge_min, relative_edge_max, dual_ratio_min, stagger_max;
  std::optional<double> area_length_min, angle_min_deg, angle_max_deg, radius_edge_max;
  std::optional<double> grading_max, degree_min, degree_max;
  std::optional<double> degree_6_min;  ///< fraction of cells with six neighbours
};

/// One bound on an extreme: which, of what, and the values that make sense for it.
struct RequirementRule {
  const char* key;  ///< in a configuration
  std::optional<double> Requirements::*wanted;
  Extreme Quality::*reached;
  bool is_least;           ///< reached >= wanted is asked for, else reached <= wanted
  const char* unit;        ///< "" or " deg"
  double lowest, highest;  ///< of `wanted`
  bool needs_spacing = false;
};

/// All but well_centred and degree_6_min, in the order in which they are told.
std::span<const RequirementRule> requirement_rules();

/// A sentence for each requirement that the grid misses: its key, the value reached and the wanted
/// one, the worst element's id and place; empty when all are met. A requirement of the spacing is
/// missed where the spacing is not known.
std::vector<std::string> missed_requirements(const Requirements& wanted, const Quality& quality);

}  // namespace delos
