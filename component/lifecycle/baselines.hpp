// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The grids that others use (Engwirda 2015, figure 1), for comparison: a bisected icosahedron and
// an equiangular cubed sphere.
#include "core/progress.hpp"
#include "lifecycle/settings.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

/// 10 n^2 + 2 (icosahedral) or 6 n^2 + 2 (cubed sphere) vertices for n subdivisions of an edge.
std::int64_t baseline_vertices(Generator generator, std::int64_t subdivisions);

/// The spacing at which that many vertices would cover the surface with equilateral triangles.
double baseline_spacing_m(Generator generator, const Ellipsoid& surface, std::int64_t subdivisions);

/// The subdivisions, at least 1, whose spacing is nearest to the wanted one. Error(resource) when
/// the vertices pass 32-bit ids.
std::int64_t baseline_subdivisions(Generator generator, const Ellipsoid& surface, double spacing_m);

/// The Delaunay triangulation of the baseline's points. The same bits for any number of threads.
Mesh build_baseline(Context& context, Generator generator, const Ellipsoid& surface,
                    std::int64_t subdivisions);

}  // namespace delos
