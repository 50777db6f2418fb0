// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the user wants to find again as vertices and edges of the grid.
#include <string>
#include <vector>

#include "core/types.hpp"

namespace delos {

/// Single points, a line along great circles from point to point, or one that closes.
struct GivenLine {
  enum class Kind { points, line, ring };
  std::string name;  ///< for messages, e.g. "coast.geojson: feature 3 'Iceland'"
  Kind kind = Kind::line;
  std::vector<Vec3> points;  ///< on the surface; the first of a ring is not repeated
};

}  // namespace delos
