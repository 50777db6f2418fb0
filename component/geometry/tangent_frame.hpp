// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Coordinates in a tangent plane, where the directions of its axes do not matter.
#include <Eigen/Geometry>

#include "core/types.hpp"

namespace delos {

/// Two unit vectors that make a right-handed triple with the unit vector `up`; without a singular
/// place, unlike EastNorth.
struct TangentFrame {
  explicit TangentFrame(const Vec3& up) {
    int smallest = 0;
    up.cwiseAbs().minCoeff(&smallest);
    right = Vec3(Vec3::Unit(smallest)).cross(up).normalized();
    ahead = up.cross(right);
  }
  Vec3 right, ahead;
};

}  // namespace delos
