// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>

#include "core/progress.hpp"
#include "core/types.hpp"

namespace delos::benchmark {

/// Phase "cgal": CGAL's spherical Delaunay triangulation of the same points on one core, in the
/// order given. No phase when the program was built without CGAL.
void run_yardstick(Monitor& monitor, std::span<const Vec3> points);

}  // namespace delos::benchmark
