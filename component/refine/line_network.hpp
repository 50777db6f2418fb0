// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Given lines as a plane graph: nodes joined by great-circle arcs that meet at nodes only.
#include <cstdint>
#include <vector>

#include "geometry/ellipsoid.hpp"
#include "refine/given_line.hpp"
#include "sizing/spacing.hpp"

namespace delos {

/// No two vertices of the lines may be nearer than this times the spacing: every grid is certified
/// for edges of that length.
inline constexpr double kNearestGiven = 0.65;

struct LineNetwork {
  struct Node {
    Vec3 position;
    Index line;             ///< the first that has it: its place among the given ones
    bool is_sharp = false;  ///< two arcs meet here at less than 60 degrees
  };
  struct Arc {
    std::array<Index, 2> node;  ///< the lower id first
    Index line;
  };
  /// Where arcs meet at less than 60 degrees, so that a triangle has to have that angle.
  struct SharpCorner {
    Index node;
    double angle_deg;
  };

  std::vector<Node> nodes;  ///< given points to the last bit, then crossings
  std::vector<Arc> arcs;
  std::vector<std::string> names;  ///< of the lines
  std::vector<SharpCorner> sharp_corners;
  std::int64_t n_given = 0;      ///< different points that were given
  std::int64_t n_crossings = 0;  ///< nodes put where lines cross
};

/// Points at one place become one node; where arcs cross both get a node; an arc that runs within a
/// twentieth of the spacing past a point goes through it. Error(input), naming the lines and the
/// place: a crossing nearer to a point of either line than kNearestGiven times the spacing, an arc
/// above 170 degrees, arcs that meet at less than 10 degrees.
LineNetwork make_network(const Ellipsoid& surface, const SpacingField& spacing,
                         const std::vector<GivenLine>& lines);

/// "lon 12.5, lat -3 deg", geodetic.
std::string place_text(const Ellipsoid& surface, const Vec3& p);

}  // namespace delos
