// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The few types that every layer shares.
// Suffixes of names give units: _m metres, _m2, _rad, _deg, _s. A length without a suffix is in
// units of the largest radius of the ellipsoid ("scaled"), which is how every layer computes.
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

namespace delos {

/// Id of a vertex, triangle, cell or edge; base 0, -1 = none.
using Index = std::int32_t;
inline constexpr Index kNone = -1;

/// Where element i of a standard container stands: their sizes are unsigned, our ids are not.
constexpr std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

using Vec3 = Eigen::Vector3d;

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kRadPerDeg = kPi / 180.0;
inline constexpr double kDegPerRad = 180.0 / kPi;

}  // namespace delos
