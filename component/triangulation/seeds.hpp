// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Regular point sets: the baselines of Engwirda 2015, Figure 1, and spread points for tests and
// benchmarks. Elementary functions of delos only, so that the bits are the same everywhere.
// All of them are for a sphere; on an ellipsoid each point is moved along its radius.
#include <cstdint>
#include <vector>

#include "geometry/ellipsoid.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// 10 n^2 + 2 points. With n = m 2^k, m odd, every face of the icosahedron is cut into m^2 flat
/// triangles, projected, and those are bisected k times: a power of two gives the bisected
/// icosahedron. Point 0 is the north pole, point 11 the south pole. Error(config) unless
/// 1 <= n <= 7000.
std::vector<Vec3> icosahedral_points(std::int64_t n, const Ellipsoid& surface = {});

/// 6 n^2 + 2 points: the vertices of the equiangular cubed sphere with n x n cells a face.
/// Error(config) unless 1 <= n <= 9000.
std::vector<Vec3> cubed_sphere_points(std::int64_t n, const Ellipsoid& surface = {});

/// n points on a generative spiral (Swinbank & Purser 2006, doi:10.1256/qj.05.227).
/// Error(config) unless 4 <= n <= 5 * 10^8.
std::vector<Vec3> fibonacci_points(std::int64_t n, const Ellipsoid& surface = {});

}  // namespace delos
