// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a C-grid model needs to know before it trusts a grid, the words for it, and whether a
// grid bears out what was once certified.
#include <optional>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "metrics/quality.hpp"

namespace delos {

/// What every edge should reach, as a share of the wanted spacing: below it a model's time step
/// suffers more than the spacing that was asked for explains.
inline constexpr double kRelativeEdgeBound = 0.65;

struct Certificate {
  double well_centred = 0.0;  ///< fraction of triangles that are acute
  std::int64_t n_obtuse = 0;  ///< the others
  Extreme angle_max_deg;      ///< a triangle
  Extreme dual_ratio_min;     ///< an edge, as the next two
  Extreme stagger_max;
  std::optional<Extreme> relative_edge_min;  ///< none: the wanted spacing is not known

  /// Every triangle is acute, so every dual edge crosses its edge.
  bool is_well_centred() const { return n_obtuse == 0; }
  bool keeps_spacing() const {
    return relative_edge_min && relative_edge_min->value >= kRelativeEdgeBound;
  }
};

/// Error(internal) when there are no triangles or a number is not finite.
Certificate certificate(const Quality& quality);

/// "the edge of cells 12 and 57 (from 1), lon -12.345678, lat 4.5 deg"; "triangle 7 (from 1), ...".
/// Ids count from 1, as in every file.
std::string describe(const Extreme& extreme);

/// The verdict, two lines of at most 68 columns: well centred or not, spacing kept or not.
std::vector<std::string> certificate_text(const Certificate& certificate);

/// How much a measure of a grid may change, relative, when its coordinates are rounded into a file
/// and read back.
double rounding_tolerance(const Ellipsoid& surface, const Quality& quality);

/// One sentence for everything in `recorded` that the mesh, whose quality was measured, does not
/// bear out: a count or an extreme that differs by more than rounding, an element that is not
/// there, has another value, or lies elsewhere.
std::vector<std::string> certificate_defects(Context& context, const CertifiedMesh& subject,
                                             const Quality& quality, const Certificate& recorded);

}  // namespace delos
