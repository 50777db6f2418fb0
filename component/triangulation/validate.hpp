// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Every broken invariant of a triangulation.
#include <string>
#include <vector>

#include "geometry/ellipsoid.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

enum class DefectKind {
  bad_id,        ///< a corner or neighbour id out of range, or a corner twice in a triangle
  asymmetric,    ///< a neighbour that does not point back across the same side
  orientation,   ///< a triangle that is not counter-clockwise seen from outside
  euler,         ///< not n_triangles = 2 n_vertices - 4
  disconnected,  ///< triangles that can't be reached from triangle 0
  unreferenced,  ///< a vertex of no triangle
  pinched,       ///< a vertex whose triangles are not one fan
  duplicate,     ///< two vertices at one position
  off_surface,   ///< a vertex farther from the surface than the tolerance
  not_delaunay   ///< an illegal side (is_illegal in flip.hpp)
};

/// Name of the kind in lower case, e.g. "off_surface".
const char* to_string(DefectKind kind);

struct Defect {
  DefectKind kind;
  Index id;          ///< triangle or vertex, by the kind
  Index other;       ///< neighbour or second vertex, kNone where there is none
  std::string text;  ///< the same in words
};

struct ValidateOptions {
  double surface_tolerance = 1e-12;  ///< scaled distance to the surface
  bool delaunay = true;              ///< look at every side
  std::size_t max_defects = 1000;    ///< the search ends when so many are found
};

/// Empty for a sound mesh. Geometry is looked at only where the ids allow it. O(n log n).
std::vector<Defect> validate(const Mesh& mesh, const Ellipsoid& surface,
                             const ValidateOptions& options = {});

/// The texts of the first few defects, one a line; for messages.
std::string summary(const std::vector<Defect>& defects);

}  // namespace delos
