// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <span>

#include "core/types.hpp"

namespace delos::benchmark {

/// Seconds that CGAL's spherical Delaunay triangulation takes for the same points on one core, in
/// the order given; nothing when the program was built without CGAL.
std::optional<double> yardstick_s(std::span<const Vec3> points);

}  // namespace delos::benchmark
